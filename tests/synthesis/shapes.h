#pragma once
// Shapes that the tests of synthesis share.

#include "libprt/core/parallel.h"
#include "libprt/mesh/generate.h"
#include "libprt/synthesis/meso_mesh.h"

#include <cmath>

namespace prt::test {

/// A mesh with all that is worked out from it.
struct Ready {
  explicit Ready(TriMesh m) : mesh(std::move(m)), surface(mesh, job), sheets(surface) {}
  Ready(const Ready&) = delete;
  Job job;
  TriMesh mesh;
  Surface surface;
  SurfaceSheets sheets;
};

/// A cylinder without caps, of unit radius and height, as a ring of slivers from rim to rim.
inline TriMesh sliverTube(int segments) {
  TriMesh mesh;
  for (int i = 0; i < segments; ++i)
    for (int k = 0; k < 2; ++k) {
      const double a = 2 * kPi * i / segments;
      const Vec3 n(float(std::sin(a)), 0, float(std::cos(a)));
      mesh.positions.push_back(n + Vec3(0, float(k), 0));
      mesh.normals.push_back(n);
    }
  for (int i = 0; i < segments; ++i) {
    const unsigned a = unsigned(2 * i), b = unsigned(2 * ((i + 1) % segments));
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

/// Two level unit squares facing up, one `gap` above the other (triangles 0, 1 and 2, 3): two pieces, or
/// joined by a ramp of five more squares that winds around their corner, so that all is one piece.
inline TriMesh twoSheets(float gap, bool joined) {
  TriMesh mesh;
  const auto add = [&](float x, float z, float y00, float y10, float y01, float y11) {
    const auto first = unsigned(mesh.positions.size());
    for (const Vec3& p :
         {Vec3(x, y00, z), Vec3(x + 1, y10, z), Vec3(x, y01, z + 1), Vec3(x + 1, y11, z + 1)}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back({0, 1, 0});
    }
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.triangles.push_back({first + 1, first + 2, first + 3});
  };
  add(0, 0, 0, 0, 0, 0);
  add(0, 0, gap, gap, gap, gap);
  if (!joined) return mesh;
  add(1, 0, 0, 0, 0, 0);
  add(1, 1, 0, 0, 0, 0);
  add(0, 1, gap, 0, gap, 0);
  add(-1, 1, gap, gap, gap, gap);
  add(-1, 0, gap, gap, gap, gap);
  return mesh;
}

/// The threads of the loop of a test, put back at its end.
struct Threads {
  explicit Threads(int count) : before(threadCount()) { setThreadCount(count); }
  ~Threads() { setThreadCount(before); }
  int before;
};

}  // namespace prt::test
