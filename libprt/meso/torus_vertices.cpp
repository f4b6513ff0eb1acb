#include "libprt/meso/torus_vertices.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace prt {
namespace {

constexpr float kSame = 1e-5f;  // of a period
constexpr float kSameNormal = 0.9999f;

/// Distance on a circle of circumference 1.
float around(float a, float b) {
  const float d = std::abs(a - b);
  return std::abs(d - std::round(d));
}

/// Cells of twice the tolerance; a point's equals lie in its own cell or in a neighbouring one.
struct Cell {
  std::int64_t x, y, z;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    return std::uint64_t(c.x) * 0x9e3779b97f4a7c15u ^ std::uint64_t(c.y) * 0x6a09e667f3bcc909u ^
           std::uint64_t(c.z) * 0x27d4eb2f165667c5u;
  }
};
constexpr std::int64_t kCells = 50'000;  // per period

}  // namespace

std::vector<std::uint32_t> torusPlaces(std::span<const Vec3> positions, Job* job) {
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> firsts;
  firsts.reserve(positions.size());
  std::vector<std::uint32_t> place(positions.size());
  const auto wrap = [](std::int64_t i) { return (i % kCells + kCells) % kCells; };
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (job && v % 4096 == 0) job->checkCancelled();
    const Vec3& p = positions[v];
    // Cells are two tolerances wide, so equals lie in the point's cell or in the next one on its nearer side.
    std::int64_t own[3], side[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double x = double(p[axis]) * double(kCells), low = std::floor(x);
      own[axis] = std::int64_t(low), side[axis] = x - low < 0.5 ? -1 : 1;
    }
    place[v] = v;
    for (int n = 0; n < 8 && place[v] == v; ++n) {
      const Cell cell{wrap(own[0] + (n & 1 ? side[0] : 0)), wrap(own[1] + (n & 2 ? side[1] : 0)),
                      own[2] + (n & 4 ? side[2] : 0)};
      const auto found = firsts.find(cell);
      if (found == firsts.end()) continue;
      for (const std::uint32_t w : found->second) {
        const Vec3& q = positions[w];
        if (around(p.x, q.x) > kSame || around(p.y, q.y) > kSame || std::abs(p.z - q.z) > kSame) continue;
        place[v] = w;
        break;
      }
    }
    if (place[v] == v) firsts[{wrap(own[0]), wrap(own[1]), own[2]}].push_back(v);
  }
  return place;
}

std::vector<std::uint32_t> torusTwins(std::span<const Vec3> normals, std::span<const std::uint32_t> places) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> at;
  std::vector<std::uint32_t> twin(normals.size());
  for (std::uint32_t v = 0; v < normals.size(); ++v) {
    std::vector<std::uint32_t>& kinds = at[places[v]];
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](std::uint32_t w) {
      return dot(normals[v], normals[w]) > kSameNormal;
    });
    twin[v] = same == kinds.end() ? v : *same;
    if (same == kinds.end()) kinds.push_back(v);
  }
  return twin;
}

std::vector<Vec3> torusNormals(const TriMesh& mesh, std::span<const std::uint32_t> places) {
  std::vector<DVec3> sums(mesh.vertexCount(), DVec3(0));
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const DVec3 normal(mesh.areaNormal(t));
    const double size = length(normal);
    if (!(size > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const UVec3& corner = mesh.triangles[t];
      const DVec3 p(mesh.positions[corner[k]]);
      const DVec3 a = DVec3(mesh.positions[corner[(k + 1) % 3]]) - p,
                  b = DVec3(mesh.positions[corner[(k + 2) % 3]]) - p;
      sums[places[corner[k]]] += std::atan2(size, dot(a, b)) * (normal / size);
    }
  }
  std::vector<Vec3> normals(mesh.vertexCount(), Vec3(0, 0, 1));
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (const DVec3& sum = sums[places[v]]; length(sum) > 1e-9) normals[v] = Vec3(normalize(sum));
  return normals;
}

}  // namespace prt
