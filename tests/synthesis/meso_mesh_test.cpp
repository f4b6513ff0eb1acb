#include "libprt/synthesis/meso_mesh.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "tests/synthesis/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace prt {
namespace {

using namespace test;

MesoMesh mesoOf(const Ready& r, std::size_t vertices, int relaxations = 2) {
  Job job;
  return makeMesoMesh(r.mesh, r.sheets, {.vertices = vertices, .coarsest = 30, .relaxations = relaxations},
                      job);
}

PointRings finestRings(const Ready& r, const MesoMesh& meso) {
  Job job;
  return mesoRings(meso, r.sheets, meso.levels() - 1, job);
}

struct Named {
  const char* name;
  TriMesh mesh;
};

std::vector<Named> shapes() {
  std::vector<Named> all;
  all.push_back({"torus", makeTorus({.segments = 40, .sides = 16})});
  all.push_back({"bird", makeBuiltinMesh("bird", 0.5f)});
  all.push_back({"box", makeBox({.cells = 1})});  // triangles as large as the sides
  all.push_back({"tube of slivers", sliverTube(300)});
  all.push_back({"globe, pinched at the poles", makeSphere({.segments = 200, .rings = 30})});
  all.push_back({"dense icosphere", makeIcosphere({.subdivisions = 6})});  // finer than the meso mesh
  return all;
}

TEST(MesoMesh, HasTheVerticesThatWereAskedFor) {
  for (Named& shape : shapes()) {
    const Ready r(std::move(shape.mesh));
    const MesoMesh meso = mesoOf(r, 12000);
    EXPECT_NEAR(double(meso.vertexCount()), 12000, 0.06 * 12000) << shape.name;
    EXPECT_EQ(meso.levelEnd.back(), meso.vertexCount());
  }
}

TEST(MesoMesh, SpacingIsEvenWhateverTheTriangles) {
  for (Named& shape : shapes()) {
    const Ready r(std::move(shape.mesh));
    const MesoMesh meso = mesoOf(r, 12000);
    const MesoSpacing s = mesoSpacing(meso, finestRings(r, meso));
    EXPECT_LT(s.nearestSpread, 0.12) << shape.name;
    EXPECT_LT(s.edgeSpread, 0.22) << shape.name;
    EXPECT_GT(s.nearestLeast, 0.3) << shape.name;
    EXPECT_NEAR(s.edgeMean, 1, 0.08) << shape.name;
    EXPECT_NEAR(s.valence, 6, 0.35) << shape.name;
  }
}

TEST(MesoMesh, CoarserLevelsAreEvenToo) {
  const Ready r(makeBuiltinMesh("bird", 0.5f));
  const MesoMesh meso = mesoOf(r, 20000);
  ASSERT_GE(meso.levels(), 4);
  for (int level = 1; level < meso.levels(); ++level) {
    const double ratio =
        double(meso.levelEnd[std::size_t(level)]) / double(meso.levelEnd[std::size_t(level) - 1]);
    EXPECT_GT(ratio, 2.5) << level;
    EXPECT_LT(ratio, 5.0) << level;
  }
  Job job;
  MesoMesh coarse = meso;
  const PointRings rings = mesoRings(meso, r.sheets, meso.levels() - 2, job);
  coarse.edge = meso.edgeOf(meso.levels() - 2);
  const MesoSpacing s = mesoSpacing(coarse, rings);
  EXPECT_LT(s.nearestSpread, 0.2);
  EXPECT_GT(s.nearestLeast, 0.3);
}

TEST(MesoMesh, VerticesLieOnTheTrianglesThatTheyName) {
  const Ready r(makeBuiltinMesh("rock", 0.5f));
  const MesoMesh meso = mesoOf(r, 5000);
  for (std::size_t i = 0; i < meso.vertexCount(); ++i) {
    const Vec2& w = meso.barycentric[i];
    ASSERT_TRUE(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1 + 1e-6f);
    const Vec3 p = positionAt(r.surface, {meso.triangle[i], w});
    ASSERT_LT(distance(p, meso.positions[i]), 1e-6f);
    ASSERT_NEAR(length(meso.normals[i]), 1, 1e-5f);
  }
}

TEST(MesoMesh, RingsAreSymmetricAndNear) {
  const Ready r(makeBuiltinMesh("bird", 0.5f));
  const MesoMesh meso = mesoOf(r, 6000);
  const PointRings rings = finestRings(r, meso);
  for (std::uint32_t p = 0; p < rings.count(); ++p) {
    const auto ring = rings.of(p);
    EXPECT_EQ(std::set<std::uint32_t>(ring.begin(), ring.end()).size(), ring.size());
    for (const std::uint32_t q : ring) {
      const auto back = rings.of(q);
      ASSERT_NE(std::find(back.begin(), back.end(), p), back.end());
      ASSERT_LT(double(distance(meso.positions[p], meso.positions[q])), 2.3 * meso.edge);
    }
  }
}

TEST(MesoMesh, RingsOfALatticeAreItsSixNeighbours) {
  const Ready r(makePlane({.width = 4, .depth = 4, .columns = 2, .rows = 2}));
  std::vector<Vec3> at, up;
  std::vector<std::uint32_t> triangle;
  const int n = 21;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      at.push_back({0.1f * float(x) + 0.05f * float(y % 2) - 1, 0, 0.1f * 0.8660254f * float(y) - 1});
      up.push_back({0, 1, 0});
      triangle.push_back(0);
    }
  Job job;
  const RingResult result = voronoiRings(r.sheets, {at, up, triangle}, 0.22f, job);
  for (int y = 2; y < n - 2; ++y)
    for (int x = 2; x < n - 2; ++x) {
      const auto p = std::uint32_t(y * n + x);
      EXPECT_EQ(result.rings.of(p).size(), 6u);
      for (const std::uint32_t q : result.rings.of(p)) EXPECT_NEAR(distance(at[p], at[q]), 0.1f, 1e-5f);
      EXPECT_LT(length(result.toCentre[p]), 1e-5f);
      // Counter-clockwise seen from above.
      const auto ring = result.rings.of(p);
      for (std::size_t i = 0; i < ring.size(); ++i)
        EXPECT_GT(cross(at[ring[i]] - at[p], at[ring[(i + 1) % 6]] - at[p]).y, 0);
    }
}

TEST(MesoMesh, SheetsHalfAnEdgeApartAreNotJoined) {
  for (const bool joined : {false, true}) {
    const double area = joined ? 7 : 2;
    const float edge = float(std::sqrt(1.155 * area / 8000));
    const Ready r(twoSheets(0.5f * edge, joined));
    const MesoMesh meso = mesoOf(r, 8000);
    const PointRings rings = finestRings(r, meso);
    const auto sheet = [&](std::uint32_t p) {
      return meso.triangle[p] < 2 ? 0 : meso.triangle[p] < 4 ? 1 : 2;
    };
    std::size_t count[3] = {0, 0, 0};
    for (std::uint32_t p = 0; p < rings.count(); ++p) {
      ++count[sheet(p)];
      const Vec3& at = meso.positions[p];
      // Away from the ramp, which rightly has both for neighbours.
      if (sheet(p) == 2 || at.x < 3 * edge || at.x > 1 - 3 * edge || at.z > 1 - 3 * edge) continue;
      for (const std::uint32_t q : rings.of(p)) ASSERT_EQ(sheet(p), sheet(q));
    }
    // Both are covered alike.
    EXPECT_NEAR(double(count[0]), 8000 / area, 0.08 * 8000 / area);
    EXPECT_NEAR(double(count[1]), 8000 / area, 0.08 * 8000 / area);
  }
}

TEST(MesoMesh, IsTheSameForAnyNumberOfThreads) {
  const Ready r(makeBuiltinMesh("bird", 0.5f));
  std::vector<MesoMesh> made;
  std::vector<PointRings> rings;
  for (const int threads : {1, 2, 3}) {
    const Threads set(threads);
    made.push_back(mesoOf(r, 9000));
    rings.push_back(finestRings(r, made.back()));
  }
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(made[i].positions, made[0].positions);
    EXPECT_EQ(made[i].triangle, made[0].triangle);
    EXPECT_EQ(rings[i].list, rings[0].list);
  }
}

TEST(MesoMesh, OtherSeedsSpreadOtherPoints) {
  const Ready r(makeTorus());
  Job job;
  const MesoMesh a = makeMesoMesh(r.mesh, r.sheets, {.vertices = 2000, .seed = 1}, job),
                 b = makeMesoMesh(r.mesh, r.sheets, {.vertices = 2000, .seed = 2}, job);
  EXPECT_NE(a.positions, b.positions);
}

TEST(MesoMesh, StopsWhenCancelled) {
  const Ready r(makeTorus());
  Job job;
  job.cancel();
  EXPECT_THROW(makeMesoMesh(r.mesh, r.sheets, {.vertices = 200000}, job), Cancelled);
}

TEST(MesoMesh, RefusesASurfaceWithoutArea) {
  TriMesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.normals.assign(3, {0, 1, 0});
  flat.triangles = {{0, 1, 2}};
  const Ready r(flat);
  Job job;
  EXPECT_THROW(makeMesoMesh(r.mesh, r.sheets, {.vertices = 100}, job), GeometryError);
}

}  // namespace
}  // namespace prt
