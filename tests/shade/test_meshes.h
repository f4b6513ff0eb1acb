#pragma once
// Small meshes for the tests of shading.

#include "libprt/mesh/mesh.h"

#include <cmath>
#include <random>

namespace prt::test {

/// A sphere about the origin whose radius waves by `bump`, counter-clockwise from outside.
inline TriMesh blob(int rings, int segments, float radius, float bump = 0) {
  TriMesh mesh;
  const auto add = [&](float theta, float phi) {
    const Vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    mesh.positions.push_back(radius * (1 + bump * std::sin(5 * d.x) * std::cos(4 * d.y + 3 * d.z)) * d);
    mesh.normals.push_back(d);
  };
  add(0, 0);
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < segments; ++s)
      add(kPiF * float(r) / float(rings), 2 * kPiF * float(s) / float(segments));
  add(kPiF, 0);
  const auto vertex = [&](int r, int s) {
    if (r == 0) return 0u;
    if (r == rings) return unsigned(mesh.positions.size() - 1);
    return unsigned(1 + (r - 1) * segments + s % segments);
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      if (r > 0) mesh.triangles.push_back({vertex(r, s), vertex(r, s + 1), vertex(r + 1, s)});
      if (r + 1 < rings) mesh.triangles.push_back({vertex(r, s + 1), vertex(r + 1, s + 1), vertex(r + 1, s)});
    }
  return mesh;
}

/// A square of side 2 about the origin in the plane z = 0, facing +z, cut into n x n quads whose inner
/// corners are shaken.
inline TriMesh shakenSquare(int n, float amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> shake(-amount / float(n), amount / float(n));
  TriMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      Vec3 p(2 * float(x) / float(n) - 1, 2 * float(y) / float(n) - 1, 0);
      if (x > 0 && x < n) p.x += shake(random);
      if (y > 0 && y < n) p.y += shake(random);
      mesh.positions.push_back(p);
      mesh.normals.push_back({0, 0, 1});
    }
  const auto at = [&](int x, int y) { return unsigned(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

}  // namespace prt::test
