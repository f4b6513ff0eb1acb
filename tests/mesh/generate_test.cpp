#include "libprt/mesh/generate.h"

#include "libprt/core/error.h"
#include "libprt/mesh/edges.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

struct Counts {
  std::size_t edges = 0, boundary = 0, nonManifold = 0;
  long euler = 0;
};

Counts countsOf(const TriMesh& mesh) {
  Job job;
  const MeshEdges edges(mesh.triangles, job);
  Counts counts{.edges = edges.size()};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    counts.boundary += edges[i].faceCount() == 1;
    counts.nonManifold += edges[i].faceCount() > 2;
  }
  counts.euler = long(mesh.vertexCount()) - long(edges.size()) + long(mesh.triangleCount());
  return counts;
}

double volumeOf(const TriMesh& mesh) {
  double sum = 0;
  for (const UVec3& t : mesh.triangles)
    sum += dot(DVec3(mesh.positions[t.x]), cross(DVec3(mesh.positions[t.y]), DVec3(mesh.positions[t.z]))) / 6;
  return sum;
}

double areaOf(const TriMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) sum += 0.5 * length(mesh.areaNormal(f));
  return sum;
}

class BuiltinMesh : public testing::TestWithParam<std::string> {};

TEST_P(BuiltinMesh, HasUnitNormalsThatAgreeWithItsTriangles) {
  const TriMesh mesh = makeBuiltinMesh(GetParam());
  ASSERT_EQ(mesh.normals.size(), mesh.vertexCount());
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(length(n), 1, 1e-5);
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    const Vec3 normal = mesh.areaNormal(f);
    ASSERT_GT(length(normal), 0);
    for (int i = 0; i < 3; ++i)
      ASSERT_GT(dot(normal, mesh.normals[mesh.triangles[f][i]]), 0) << "triangle " << f;
  }
}

TEST_P(BuiltinMesh, UsesEveryVertexAndNoEdgeTooOften) {
  const TriMesh mesh = makeBuiltinMesh(GetParam());
  EXPECT_EQ(countsOf(mesh).nonManifold, 0u);
  std::vector<bool> used(mesh.vertexCount(), false);
  for (const UVec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) used.at(t[i]) = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST_P(BuiltinMesh, UnfoldsItsUvsWithoutOverlapOrFlip) {
  const TriMesh mesh = makeBuiltinMesh(GetParam());
  if (mesh.uv.empty()) {
    EXPECT_TRUE(mesh.uvTriangles.empty());
    return;
  }
  ASSERT_EQ(mesh.uvTriangles.size(), mesh.triangleCount());
  double area = 0;
  for (const UVec3& t : mesh.uvTriangles) {
    const Vec2 a = mesh.uv.at(t.x), b = mesh.uv.at(t.y), c = mesh.uv.at(t.z);
    const double twice = double(b.x - a.x) * (c.y - a.y) - double(c.x - a.x) * (b.y - a.y);
    ASSERT_GT(twice, 0);
    area += 0.5 * twice;
  }
  EXPECT_LE(area, 1 + 1e-5);
  for (const Vec2& uv : mesh.uv)
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(uv[i] >= 0 && uv[i] <= 1);
}

TEST_P(BuiltinMesh, IsTheSameEveryTime) {
  const TriMesh one = makeBuiltinMesh(GetParam()), two = makeBuiltinMesh(GetParam());
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.triangles, two.triangles);
}

TEST_P(BuiltinMesh, DetailScalesTheResolution) {
  const std::size_t usual = makeBuiltinMesh(GetParam()).vertexCount();
  const double coarse = double(makeBuiltinMesh(GetParam(), 0.5f).vertexCount()) / double(usual);
  const double fine = double(makeBuiltinMesh(GetParam(), 2).vertexCount()) / double(usual);
  EXPECT_GT(fine, 1.5);
  EXPECT_LT(fine, 5);
  EXPECT_LT(coarse, GetParam() == "box" ? 1.1 : 0.6);  // a box has one cell a side already
  EXPECT_THROW(makeBuiltinMesh(GetParam(), 0), ValueError);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinMesh, testing::ValuesIn(builtinMeshNames()),
                         [](const auto& shape) { return shape.param; });

TEST(Generate, SolidsAreClosedAndWoundOutwards) {
  for (const char* name : {"bird", "icosphere", "rock", "sphere", "torus", "vase"}) {
    const TriMesh mesh = makeBuiltinMesh(name);
    EXPECT_EQ(countsOf(mesh).boundary, 0u) << name;
    EXPECT_EQ(countsOf(mesh).euler, std::string(name) == "torus" ? 0 : 2) << name;
    EXPECT_GT(volumeOf(mesh), 0) << name;
  }
}

TEST(Generate, StandingShapesStandOnTheGround) {
  for (const char* name : {"bird", "rock", "vase", "ground"})
    EXPECT_EQ(makeBuiltinMesh(name).bounds().low.y, 0) << name;
}

TEST(Generate, SizesMatchClosedForms) {
  EXPECT_NEAR(volumeOf(makeIcosphere({.radius = 2, .subdivisions = 5})), 4 * kPi / 3 * 8, 0.05);
  EXPECT_EQ(makeIcosphere({.radius = 1, .subdivisions = 3}).vertexCount(), 642u);
  EXPECT_NEAR(volumeOf(makeSphere({.radius = 1, .segments = 256, .rings = 128})), 4 * kPi / 3, 2e-3);
  EXPECT_NEAR(volumeOf(makeTorus({.majorRadius = 1, .minorRadius = 0.4f, .segments = 400, .sides = 200})),
              2 * kPi * kPi * 0.16, 1e-3);
  EXPECT_NEAR(volumeOf(makeBox({.size = {1, 2, 3}, .cells = 4})), 6, 1e-5);
  EXPECT_NEAR(areaOf(makePlane({.width = 2, .depth = 3, .columns = 5, .rows = 7, .grading = 0.5f})), 6, 1e-5);
}

TEST(Generate, BoxHasThreeVerticesPerCorner) {
  const TriMesh box = makeBox();
  EXPECT_EQ(box.vertexCount(), 24u);
  EXPECT_EQ(box.triangleCount(), 12u);
}

TEST(Generate, GradedPlaneHasItsSmallestCellsInTheMiddle) {
  const TriMesh plane = makePlane({.width = 2, .depth = 2, .columns = 40, .rows = 40, .grading = 0.8f});
  const float middle = plane.positions[21].x - plane.positions[20].x;
  const float border = plane.positions[40].x - plane.positions[39].x;
  EXPECT_NEAR(middle, 0.2 * 0.05, 1e-4);
  EXPECT_GT(border, 8 * middle);
}

TEST(Generate, BirdIsNearUniform) {
  const TriMesh bird = makeBird();
  double worst = 1, sum = 0;
  for (std::size_t f = 0; f < bird.triangleCount(); ++f) {
    const UVec3& t = bird.triangles[f];
    const auto square = [](const Vec3& v) { return double(dot(v, v)); };
    const double edges = square(bird.positions[t.x] - bird.positions[t.y]) +
                         square(bird.positions[t.y] - bird.positions[t.z]) +
                         square(bird.positions[t.z] - bird.positions[t.x]);
    const double quality = 2 * std::sqrt(3.0) * length(bird.areaNormal(f)) / edges;  // 1 = equilateral
    worst = std::min(worst, quality);
    sum += quality;
  }
  EXPECT_GT(worst, 0.4);
  EXPECT_GT(sum / double(bird.triangleCount()), 0.95);
  EXPECT_NEAR(double(bird.vertexCount()), 10000, 1000);
  EXPECT_NEAR(bird.bounds().high.x - bird.bounds().low.x, 1, 1e-5);
}

TEST(Generate, BirdStaysManifoldAtOtherResolutions) {
  for (int cells : {64, 80, 120, 160}) {
    const TriMesh bird = makeBird({.cellsAlong = cells, .relaxations = 4});
    EXPECT_EQ(countsOf(bird).nonManifold, 0u) << cells;
    EXPECT_EQ(countsOf(bird).euler, 2) << cells;
  }
}

TEST(Generate, VaseWallHasTheThicknessAskedFor) {
  // Solid volume of the wall is about area/2 * thickness.
  for (float thickness : {0.01f, 0.03f}) {
    const TriMesh vase = makeVase({.thickness = thickness});
    const double ratio = volumeOf(vase) / (0.5 * areaOf(vase) * thickness);
    EXPECT_GT(ratio, 0.9);
    EXPECT_LT(ratio, 2.6) << "the floor is thicker than the wall";
  }
}

TEST(Generate, RockSeedsDiffer) {
  EXPECT_NE(makeRock({.seed = 1}).positions, makeRock({.seed = 2}).positions);
}

TEST(Generate, RefusesOptionsOutOfRange) {
  EXPECT_THROW(makeIcosphere({.subdivisions = 10}), ValueError);
  EXPECT_THROW(makeIcosphere({.radius = 0}), ValueError);
  EXPECT_THROW(makeSphere({.segments = 2}), ValueError);
  EXPECT_THROW(makePlane({.width = std::numeric_limits<float>::quiet_NaN()}), ValueError);
  EXPECT_THROW(makePlane({.columns = 100000}), ValueError);
  EXPECT_THROW(makeBox({.size = {1, -1, 1}}), ValueError);
  EXPECT_THROW(makeTorus({.minorRadius = 2}), ValueError);
  EXPECT_THROW(makeVase({.rings = 3}), ValueError);
  EXPECT_THROW(makeBird({.cellsAlong = 1 << 20}), ValueError);
  EXPECT_THROW(makeRock({.octaves = 0}), ValueError);
  EXPECT_THROW(makeBuiltinMesh("teapot"), ValueError);
}

}  // namespace
}  // namespace prt
