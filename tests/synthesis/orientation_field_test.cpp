#include "libprt/synthesis/orientation_field.h"

#include "libprt/core/error.h"
#include "tests/synthesis/shapes.h"

#include <gtest/gtest.h>

#include <map>

namespace prt {
namespace {

using namespace test;

OrientationField fieldOn(const Ready& r, const FieldOptions& options = {}) {
  Job job;
  return makeOrientationField(r.mesh, r.surface, options, job);
}

int indexSum(const OrientationField& field) {
  int sum = 0;
  for (const FieldSingularity& s : field.singularities) sum += s.index;
  return sum;
}

/// Largest turn between the tangents of two triangles at a vertex that they share, modulo the symmetry.
double largestJump(const Ready& r, const OrientationField& field) {
  std::map<std::uint32_t, Vec3> first;
  double worst = 0;
  for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
    const std::uint32_t v = r.mesh.triangles[h / 3][int(h % 3)];
    const Vec3 t = field.frames.tangents[h], n = r.mesh.normals[v];
    const auto [place, isNew] = first.try_emplace(v, t);
    if (isNew) continue;
    const double step = 2 * kPi / field.symmetry;
    worst = std::max(
        worst,
        std::abs(std::remainder(
            std::atan2(double(dot(cross(place->second, t), n)), double(dot(place->second, t))), step)));
  }
  return worst;
}

struct Shape {
  const char* name;
  TriMesh mesh;
  int euler;
};

std::vector<Shape> closedShapes() {
  std::vector<Shape> shapes;
  shapes.push_back({"icosphere", makeIcosphere({.subdivisions = 3}), 2});
  shapes.push_back({"torus", makeTorus({.segments = 48, .sides = 20}), 0});
  shapes.push_back({"bird", makeBuiltinMesh("bird", 0.5f), 2});
  shapes.push_back({"rock", makeBuiltinMesh("rock", 0.5f), 2});
  shapes.push_back({"vase", makeBuiltinMesh("vase", 0.5f), 2});
  shapes.push_back({"box", makeBox({.cells = 6}), 2});
  return shapes;
}

TEST(OrientationField, IndicesAddUpToTheEulerCharacteristic) {
  for (Shape& shape : closedShapes()) {
    const Ready r(std::move(shape.mesh));
    for (const int n : {1, 2, 4}) {
      const OrientationField field = fieldOn(r, {.symmetry = n});
      EXPECT_EQ(indexSum(field), n * shape.euler) << shape.name << " " << n;
    }
  }
}

TEST(OrientationField, ASphereHasAsFewSingularitiesAsItMust) {
  const Ready r(makeIcosphere({.subdivisions = 4}));
  for (const int n : {1, 2, 4}) {
    const OrientationField field = fieldOn(r, {.symmetry = n});
    EXPECT_EQ(field.singularities.size(), std::size_t(2 * n));
    for (const FieldSingularity& s : field.singularities) EXPECT_EQ(s.index, 1);
  }
}

TEST(OrientationField, ATorusHasNone) {
  // (On a thick one the smoothest cross field trades pairs of quarter turns for less bending.)
  const Ready r(makeTorus({.minorRadius = 0.2f}));
  for (const int n : {1, 2, 4}) EXPECT_TRUE(fieldOn(r, {.symmetry = n}).singularities.empty()) << n;
}

TEST(OrientationField, TangentsAreUnitAndFlat) {
  const Ready r(makeBuiltinMesh("bird", 0.5f));
  for (const int n : {1, 2, 4}) {
    const OrientationField field = fieldOn(r, {.symmetry = n});
    for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
      const Vec3& normal = r.mesh.normals[r.mesh.triangles[h / 3][int(h % 3)]];
      ASSERT_NEAR(length(field.frames.tangents[h]), 1, 1e-5f);
      ASSERT_NEAR(dot(field.frames.tangents[h], normal), 0, 1e-5f);
    }
    EXPECT_LT(largestJump(r, field), 1e-3) << n;
  }
}

TEST(OrientationField, OnAPlaneItIsConstantAndTurnsWithItsAngle) {
  const Ready r(makePlane({.columns = 9, .rows = 5}));
  for (const double angle : {0.0, 0.4, -1.2}) {
    const OrientationField field = fieldOn(r, {.angle = angle});
    // On level ground the general course is +X; a positive turn is counter-clockwise seen from above.
    const Vec3 expected(float(std::cos(angle)), 0, float(-std::sin(angle)));
    for (const Vec3& t : field.frames.tangents) ASSERT_LT(distance(t, expected), 1e-4f) << angle;
  }
}

TEST(OrientationField, OnATubeItGoesAround) {
  // A developable surface has a field without any turn at all; eastwards is one.
  const Ready r(sliverTube(40));
  const OrientationField field = fieldOn(r);
  EXPECT_TRUE(field.singularities.empty());
  for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
    const Vec3& n = r.mesh.normals[r.mesh.triangles[h / 3][int(h % 3)]];
    ASSERT_LT(distance(field.frames.tangents[h], cross(Vec3(0, 1, 0), n)), 2e-3f);
  }
}

TEST(OrientationField, FollowsStrokes) {
  const Ready r(makeIcosphere({.subdivisions = 4}));
  FieldStroke north, across;  // up the side that faces +Z; eastwards on the far side
  for (int i = 0; i <= 10; ++i) {
    const double a = -0.4 + 0.08 * i;
    north.points.push_back(Vec3(DVec3(0, std::sin(a), std::cos(a))));
    across.points.push_back(Vec3(DVec3(std::sin(a + kPi), 0, std::cos(a + kPi))));
  }
  const OrientationField field = fieldOn(r, {.strokes = {north, across}, .strokeWidth = 0.03});
  EXPECT_EQ(indexSum(field), 2);
  int checkedNorth = 0, checkedAcross = 0;
  for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
    const Vec3& p = r.mesh.positions[r.mesh.triangles[h / 3][int(h % 3)]];
    const Vec3& t = field.frames.tangents[h];
    if (std::abs(p.x) < 0.04f && std::abs(p.y) < 0.35f && p.z > 0) {
      EXPECT_GT(dot(t, normalize(Vec3(0, p.z, -p.y))), 0.98f);
      ++checkedNorth;
    }
    if (std::abs(p.y) < 0.04f && std::abs(p.x) < 0.35f && p.z < 0) {
      EXPECT_GT(dot(t, normalize(Vec3(p.z, 0, -p.x))), 0.98f);
      ++checkedAcross;
    }
  }
  EXPECT_GT(checkedNorth, 20);
  EXPECT_GT(checkedAcross, 20);
}

TEST(OrientationField, AStrokeThatGoesAroundActsAllTheWay) {
  // Once around the equator and against the general course, all sides at once.
  const Ready r(makeIcosphere({.subdivisions = 4}));
  FieldStroke round;
  for (int i = 0; i <= 48; ++i)
    round.points.push_back(Vec3(DVec3(std::cos(2 * kPi * i / 48), 0, std::sin(2 * kPi * i / 48))));
  const OrientationField field = fieldOn(r, {.strokes = {round}, .strokeWidth = 0.03});
  int checked = 0;
  for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
    const Vec3& p = r.mesh.positions[r.mesh.triangles[h / 3][int(h % 3)]];
    if (std::abs(p.y) > 0.04f) continue;
    EXPECT_GT(dot(field.frames.tangents[h], normalize(Vec3(-p.z, 0, p.x))), 0.98f);
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST(OrientationField, AThinStrokeActsOnACoarseMeshAsFarAsItGoes) {
  // A broken line between rows of vertices, hundreds of times thinner than the mesh is coarse: it sets both
  // ends.
  const Ready r(makePlane({.width = 4, .columns = 48, .rows = 12}));
  const float z = 0.02f;
  const FieldStroke line{{Vec3(-2, 0, z), Vec3(0, 0, z), Vec3(0, 0, -0.5f)}};
  const OrientationField field = fieldOn(r, {.strokes = {line}, .strokeWidth = 1e-4});
  int along = 0, aside = 0;
  for (std::uint32_t h = 0; h < 3 * r.mesh.triangleCount(); ++h) {
    const Vec3& p = r.mesh.positions[r.mesh.triangles[h / 3][int(h % 3)]];
    const Vec3& t = field.frames.tangents[h];
    if (p.x < -1) {
      ++along;
      EXPECT_GT(t.x, 0.9f);
    }
    if (std::abs(p.x) < 0.01f && p.z < -0.2f) {
      ++aside;
      EXPECT_LT(t.z, -0.9f);
    }
  }
  EXPECT_GT(along, 100);
  EXPECT_GT(aside, 10);
}

TEST(OrientationField, PiecesHaveFieldsOfTheirOwn) {
  // Two spheres of different size: the eigenvector of the one is nothing on the other.
  TriMesh both = makeIcosphere({.radius = 1, .subdivisions = 3});
  const TriMesh small = makeIcosphere({.radius = 0.2f, .subdivisions = 2});
  const auto first = unsigned(both.vertexCount());
  for (std::size_t v = 0; v < small.vertexCount(); ++v) {
    both.positions.push_back(small.positions[v] + Vec3(3, 0, 0));
    both.normals.push_back(small.normals[v]);
  }
  for (const UVec3& t : small.triangles) both.triangles.push_back(t + UVec3(first));
  const Ready r(std::move(both));
  const OrientationField field = fieldOn(r);
  int onFirst = 0, onSecond = 0;
  const std::uint32_t split = std::uint32_t(r.mesh.triangleCount() - small.triangleCount());
  for (const FieldSingularity& s : field.singularities) (s.triangle < split ? onFirst : onSecond) += s.index;
  EXPECT_EQ(onFirst, 2);
  EXPECT_EQ(onSecond, 2);
}

TEST(OrientationField, RefusesOtherSymmetries) {
  const Ready r(makePlane());
  EXPECT_THROW(fieldOn(r, {.symmetry = 3}), ValueError);
}

}  // namespace
}  // namespace prt
