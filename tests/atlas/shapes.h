#pragma once
// Small surfaces whose charts are known.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace prt::test {

/// The skin of unit cubes: rows[y][x] == '#' is filled, one layer deep. Every hole in the letter makes a
/// handle.
inline TriMesh skinOf(const std::vector<std::string>& rows) {
  TriMesh mesh;
  std::map<std::tuple<int, int, int>, std::uint32_t> number;
  const auto filled = [&](int x, int y, int z) {
    return z == 0 && y >= 0 && y < int(rows.size()) && x >= 0 && x < int(rows[std::size_t(y)].size()) &&
           rows[std::size_t(y)][std::size_t(x)] == '#';
  };
  const auto vertex = [&](int x, int y, int z) {
    const auto [place, isNew] = number.try_emplace({x, y, z}, std::uint32_t(mesh.positions.size()));
    if (isNew) mesh.positions.push_back({float(x), float(y), float(z)});
    return place->second;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int y = 0; y < int(rows.size()); ++y)
    for (int x = 0; x < int(rows[std::size_t(y)].size()); ++x) {
      if (!filled(x, y, 0)) continue;
      const auto v = [&](int i, int j, int k) { return vertex(x + i, y + j, k); };
      quad(v(0, 0, 1), v(1, 0, 1), v(1, 1, 1), v(0, 1, 1));
      quad(v(0, 0, 0), v(0, 1, 0), v(1, 1, 0), v(1, 0, 0));
      if (!filled(x + 1, y, 0)) quad(v(1, 0, 0), v(1, 1, 0), v(1, 1, 1), v(1, 0, 1));
      if (!filled(x - 1, y, 0)) quad(v(0, 0, 0), v(0, 0, 1), v(0, 1, 1), v(0, 1, 0));
      if (!filled(x, y + 1, 0)) quad(v(0, 1, 0), v(0, 1, 1), v(1, 1, 1), v(1, 1, 0));
      if (!filled(x, y - 1, 0)) quad(v(0, 0, 0), v(1, 0, 0), v(1, 0, 1), v(0, 0, 1));
    }
  mesh.normals.assign(mesh.positions.size(), Vec3(0, 0, 1));
  return mesh;
}

/// A genus-2 surface.
inline TriMesh doubleTorus() {
  return skinOf({"#####", "#.#.#", "#####"});
}

/// Side of a cylinder about Y, open at both ends, no caps.
inline TriMesh tube(int segments, int rings, float radius = 1, float height = 2, float topRadius = -1) {
  TriMesh mesh;
  if (topRadius < 0) topRadius = radius;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * kPi * i / segments, t = double(j) / rings;
      const double r = radius + (topRadius - radius) * t;
      mesh.positions.push_back({float(r * std::cos(angle)), float(height * t), float(-r * std::sin(angle))});
    }
  const auto v = [&](int i, int j) { return std::uint32_t(j * segments + i % segments); };
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < segments; ++i) {
      mesh.triangles.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
      mesh.triangles.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
    }
  mesh.normals.assign(mesh.positions.size(), Vec3(0, 1, 0));
  return mesh;
}

/// A flat disk of radius 1 facing +Y.
inline TriMesh flatDisk(int segments, int rings) {
  TriMesh mesh;
  mesh.positions.push_back({0, 0, 0});
  for (int j = 1; j <= rings; ++j)
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * kPi * i / segments, r = double(j) / rings;
      mesh.positions.push_back({float(r * std::cos(angle)), 0, float(-r * std::sin(angle))});
    }
  const auto v = [&](int i, int j) { return std::uint32_t(1 + (j - 1) * segments + i % segments); };
  for (int i = 0; i < segments; ++i) mesh.triangles.push_back({0, v(i, 1), v(i + 1, 1)});
  for (int j = 1; j < rings; ++j)
    for (int i = 0; i < segments; ++i) {
      mesh.triangles.push_back({v(i, j), v(i, j + 1), v(i + 1, j + 1)});
      mesh.triangles.push_back({v(i, j), v(i + 1, j + 1), v(i + 1, j)});
    }
  mesh.normals.assign(mesh.positions.size(), Vec3(0, 1, 0));
  return mesh;
}

/// A flat strip facing +Y that winds about itself, `turns` times, with a gap of a tenth of its width: deep,
/// and nearly touching itself wherever it is laid flat.
inline TriMesh spiral(double turns, int cells, int across = 2) {
  TriMesh mesh;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= across; ++j) {
      const double angle = 2 * kPi * turns * i / cells;
      const double r = 1 + 1.1 * angle / (2 * kPi) + double(j) / across;
      mesh.positions.push_back({float(r * std::cos(angle)), 0, float(-r * std::sin(angle))});
    }
  const auto v = [&](int i, int j) { return std::uint32_t(i * (across + 1) + j); };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({v(i, j), v(i, j + 1), v(i + 1, j + 1)});
      mesh.triangles.push_back({v(i, j), v(i + 1, j + 1), v(i + 1, j)});
    }
  mesh.normals.assign(mesh.positions.size(), Vec3(0, 1, 0));
  return mesh;
}

/// The part of a unit sphere above `lowest` (height of its rim).
inline TriMesh sphereCap(int segments, int rings, double lowest = 0) {
  TriMesh mesh = flatDisk(segments, rings);
  const double opening = std::acos(lowest);
  for (Vec3& p : mesh.positions) {
    const double r = std::hypot(double(p.x), double(p.z)), angle = r * opening;
    const double scale = r > 0 ? std::sin(angle) / r : 0;
    p = {float(p.x * scale), float(std::cos(angle)), float(p.z * scale)};
  }
  mesh.normals = mesh.positions;
  return mesh;
}

}  // namespace prt::test
