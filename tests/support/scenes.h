#pragma once
// Small scenes with known answers, for tests of transport and of what draws it. Y is up.

#include "libprt/transport/scene.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace prt::test {

inline Material lambert(const Rgb& albedo) {
  Material material;
  material.albedo = albedo;
  return material;
}

/// One mesh with one material.
inline Scene sceneOf(TriMesh mesh, const Material& material = lambert(Rgb(0.5f))) {
  const SceneObject object{"object", std::make_shared<TriMesh>(std::move(mesh)), Mat4(1.0f), material};
  return flattenScene({&object, 1});
}

/// Appends `extra` to `mesh` as it is.
inline void append(TriMesh& mesh, const TriMesh& extra) {
  const auto first = std::uint32_t(mesh.vertexCount());
  mesh.positions.insert(mesh.positions.end(), extra.positions.begin(), extra.positions.end());
  mesh.normals.insert(mesh.normals.end(), extra.normals.begin(), extra.normals.end());
  for (const UVec3& t : extra.triangles) mesh.triangles.push_back(t + first);
}

/// A flat grid of (nu+1) x (nv+1) vertices: origin + u*i/nu + v*j/nv; front side towards cross(u, v).
inline TriMesh grid(const Vec3& origin, const Vec3& u, const Vec3& v, int nu, int nv) {
  TriMesh mesh;
  const Vec3 n = normalize(cross(u, v));
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      mesh.positions.push_back(origin + u * (float(i) / float(nu)) + v * (float(j) / float(nv)));
      mesh.normals.push_back(n);
    }
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const auto a = std::uint32_t(j * (nu + 1) + i), b = a + 1, c = a + std::uint32_t(nu) + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// The part z <= cap of a unit sphere in latitude rings around +Y (cap = cosine of the opening; 1 = closed),
/// every vertex shared, scaled by `radius` and moved to `centre`. `inward`: normals and fronts inside.
inline TriMesh sphere(int rings, int segments, float radius = 1, Vec3 centre = Vec3(0), float cap = 1,
                      bool inward = false) {
  TriMesh mesh;
  const bool closed = cap >= 1;
  const float top = closed ? 0.0f : std::acos(cap);
  const auto add = [&](const Vec3& d) {
    mesh.positions.push_back(centre + radius * d);
    mesh.normals.push_back(inward ? -d : d);
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back(inward ? UVec3(a, c, b) : UVec3(a, b, c));
  };
  // Rings from the top (or the rim) down, without the bottom pole and without a closed sphere's top pole.
  for (int j = closed ? 1 : 0; j < rings; ++j) {
    const float theta = top + (kPiF - top) * float(j) / float(rings);
    for (int i = 0; i < segments; ++i) {
      const float phi = 2 * kPiF * float(i) / float(segments);
      add({std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
    }
  }
  const int rows = closed ? rings - 1 : rings;
  const auto at = [&](int row, int i) { return std::uint32_t(row * segments + i % segments); };
  for (int row = 0; row + 1 < rows; ++row)
    for (int i = 0; i < segments; ++i) {
      triangle(at(row, i), at(row + 1, i), at(row + 1, i + 1));
      triangle(at(row, i), at(row + 1, i + 1), at(row, i + 1));
    }
  const auto bottom = std::uint32_t(mesh.vertexCount());
  add({0, -1, 0});
  for (int i = 0; i < segments; ++i) triangle(at(rows - 1, i), bottom, at(rows - 1, i + 1));
  if (closed) {
    const auto pole = std::uint32_t(mesh.vertexCount());
    add({0, 1, 0});
    for (int i = 0; i < segments; ++i) triangle(pole, at(0, i), at(0, i + 1));
  }
  return mesh;
}

/// An axis-aligned box with flat sides: 24 vertices at n = 1, creased at every edge.
inline TriMesh box(const Vec3& low, const Vec3& high, int n = 1) {
  const Vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  TriMesh mesh = grid(low, z, y, n, n);     // -x
  append(mesh, grid(low + x, y, z, n, n));  // +x
  append(mesh, grid(low, x, z, n, n));      // -y
  append(mesh, grid(low + y, z, x, n, n));  // +y
  append(mesh, grid(low, y, x, n, n));      // -z
  append(mesh, grid(low + z, x, y, n, n));  // +z
  return mesh;
}

/// Moves every vertex by a function and computes smooth normals again by angle.
inline TriMesh deformed(TriMesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& p : mesh.positions) p = map(p);
  std::vector<DVec3> sum(mesh.vertexCount(), DVec3(0));
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const DVec3 p(mesh.positions[t[k]]), a = normalize(DVec3(mesh.positions[t[(k + 1) % 3]]) - p),
                                           b = normalize(DVec3(mesh.positions[t[(k + 2) % 3]]) - p);
      sum[t[k]] += std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * normalize(cross(a, b));
    }
  for (std::size_t v = 0; v < sum.size(); ++v) mesh.normals[v] = Vec3(normalize(sum[v]));
  return mesh;
}

/// A closed, lumpy, self-shadowing body of about 2 * segments^2 / 2 triangles.
inline TriMesh rock(int segments) {
  return deformed(sphere(segments / 2, segments), [](const Vec3& p) {
    const float r = 1 + 0.25f * std::sin(5 * p.x + 1) * std::sin(6 * p.y) * std::sin(5 * p.z + 2) +
                    0.12f * std::sin(9 * p.x) * std::sin(8 * p.y + 1) * std::sin(7 * p.z);
    return p * r;
  });
}

}  // namespace prt::test
