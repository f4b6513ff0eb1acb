#include "libprt/mesh/normals.h"

#include "libprt/mesh/generate.h"

#include <gtest/gtest.h>

#include <set>

namespace prt {
namespace {

/// Largest error on an icosphere.
float sphereError(int subdivisions) {
  const TriMesh sphere = makeIcosphere({.radius = 3, .subdivisions = subdivisions});
  const auto normals = angleWeightedNormals(sphere.positions, sphere.triangles);
  float worst = 0;
  for (std::size_t v = 0; v < normals.size(); ++v)
    worst = std::max(worst, distance(normals[v], sphere.positions[v] / 3.0f));
  return worst;
}

TEST(Normals, OfASphereConvergeToItsPositions) {
  EXPECT_LT(sphereError(4), 3e-3f);
  EXPECT_LT(sphereError(5), 0.6f * sphereError(4));
  EXPECT_LT(sphereError(6), 0.6f * sphereError(5));
}

TEST(Normals, DoNotDependOnHowFlatPartsAreCut) {
  // The corner of a cube: two sides of one triangle, one side of two.
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<UVec3> one{{0, 3, 1}, {0, 1, 4}, {0, 4, 3}},
      two{{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {0, 4, 3}};
  const Vec3 expected = -normalize(Vec3(1));
  EXPECT_LT(distance(angleWeightedNormals(p, one)[0], expected), 1e-6f);
  EXPECT_LT(distance(angleWeightedNormals(p, two)[0], expected), 1e-6f);
}

TEST(Normals, CancellingTrianglesGetOneOfTheirs) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  const std::vector<UVec3> t{{0, 1, 2}, {0, 2, 1}};
  const auto normals = angleWeightedNormals(p, t);
  EXPECT_EQ(normals[0], Vec3(0, 0, 1));
  EXPECT_EQ(normals[3], Vec3(0, 1, 0)) << "of no triangle";
}

CornerNormals corners(const TriMesh& mesh, std::vector<Vec3> fromFile, double creaseDegrees) {
  Job job;
  return cornerNormals({mesh.positions, mesh.triangles, fromFile, float(radians(creaseDegrees))}, job);
}

/// A cube of eight vertices.
TriMesh sharedCube() {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(Vec3(i & 1, (i >> 1) & 1, i >> 2));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(Normals, CreasesBreakAtTheAngle) {
  const TriMesh cube = sharedCube();
  const CornerNormals smooth = corners(cube, {}, 91), sharp = corners(cube, {}, 89);
  for (std::size_t c = 0; c < 36; ++c) {
    const Vec3 position = cube.positions[cube.triangles[c / 3][int(c % 3)]];
    EXPECT_LT(distance(smooth.normals[c], normalize(position - Vec3(0.5f))), 1e-6f);
    EXPECT_LT(distance(sharp.normals[c], normalize(cube.areaNormal(c / 3))), 1e-6f);
  }
}

TEST(Normals, ACreaseMayEnd) {
  // A roof that flattens out: the ridge breaks where it is steep, and the far end stays whole.
  TriMesh mesh;
  for (int i = 0; i < 3; ++i)
    for (int side = -1; side <= 1; ++side)
      mesh.positions.push_back(Vec3(i, side == 0 ? (2 - i) * 0.5f : 0, -side));
  for (std::uint32_t i = 0; i < 2; ++i)
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t a = 3 * i + side, b = a + 3;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
  const CornerNormals normals = corners(mesh, {}, 40);
  const auto atVertex = [&](std::uint32_t v) {
    std::set<std::array<float, 3>> different;
    for (std::size_t c = 0; c < normals.normals.size(); ++c)
      if (mesh.triangles[c / 3][int(c % 3)] == v)
        different.insert({normals.normals[c].x, normals.normals[c].y, normals.normals[c].z});
    return different.size();
  };
  EXPECT_EQ(atVertex(1), 2u) << "steep end of the ridge";
  EXPECT_EQ(atVertex(7), 1u) << "flat end";
}

TEST(Normals, SaneFileNormalsAreKeptAndNormalised) {
  const TriMesh cube = sharedCube();
  std::vector<Vec3> file;
  for (std::size_t c = 0; c < 36; ++c) file.push_back(2.0f * normalize(cube.areaNormal(c / 3)));
  const CornerNormals kept = corners(cube, file, 180);
  EXPECT_EQ(kept.kept, 36u);
  for (std::size_t c = 0; c < 36; ++c)
    EXPECT_LT(distance(kept.normals[c], normalize(cube.areaNormal(c / 3))), 1e-6f);
}

TEST(Normals, OthersAreComputed) {
  const TriMesh cube = sharedCube();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Vec3 outward = normalize(Vec3(-1));
  for (const Vec3& bad : {Vec3(0), Vec3(nan, 0, 0), Vec3(1e30f, 0, 0), -outward}) {
    std::vector<Vec3> file(36, Vec3(0));
    for (std::size_t c = 0; c < 36; ++c)
      if (cube.triangles[c / 3][int(c % 3)] == 0) file[c] = bad;
    const CornerNormals normals = corners(cube, file, 180);
    EXPECT_EQ(normals.kept, 0u);
    for (std::size_t c = 0; c < 36; ++c) {
      const Vec3 position = cube.positions[cube.triangles[c / 3][int(c % 3)]];
      EXPECT_LT(distance(normals.normals[c], normalize(position - Vec3(0.5f))), 1e-6f);
    }
  }
}

TEST(Normals, AGrazingCornerDoesNotTearItsVertex) {
  // One normal shared by all corners at a vertex is judged by all of them, not by the steepest.
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, -5, 0.5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const Vec3 tilted = normalize(Vec3(0, 1, -0.2f));
  const CornerNormals normals = corners(mesh, std::vector<Vec3>(12, tilted), 180);
  ASSERT_LT(dot(mesh.areaNormal(3), tilted), 0);
  for (std::size_t c = 0; c < 12; ++c)
    if (mesh.triangles[c / 3][int(c % 3)] == 0) {
      EXPECT_LT(distance(normals.normals[c], tilted), 1e-6f);
    }
}

}  // namespace
}  // namespace prt
