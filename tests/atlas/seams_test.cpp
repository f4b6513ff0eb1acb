#include "libprt/atlas/seams.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "tests/atlas/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <numeric>

namespace prt {
namespace {

/// Bellman and Ford: slow and plain.
std::vector<double> plainDistances(const Surface& surface, const std::vector<float>& costs,
                                   std::uint32_t source) {
  std::vector<double> distance(surface.vertexCount(), std::numeric_limits<double>::infinity());
  distance[source] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
      const UVec2 v = surface.ends(e);
      for (const auto& [a, b] : {std::pair(v.x, v.y), std::pair(v.y, v.x)})
        if (distance[a] + costs[e] < distance[b]) distance[b] = distance[a] + costs[e], changed = true;
    }
  }
  return distance;
}

TEST(Surface, CreasesOfABoxAreOneVertexEach) {
  Job job;
  const Surface surface(makeBox({.cells = 2}), job);
  EXPECT_EQ(surface.vertexCount(), 26u);
  EXPECT_EQ(surface.vertexCount() - surface.edgeCount() + surface.triangleCount(), 2u);
  for (std::uint32_t half = 0; half < 3 * surface.triangleCount(); ++half) {
    ASSERT_NE(surface.twin[half], kNowhere);
    EXPECT_EQ(surface.from(half), surface.to(surface.twin[half]));
  }
}

TEST(Surface, RidgesBendDownAndValleysUp) {
  Job job;
  const Surface box(makeBox({}), job);
  const std::vector<float> bends = bendAngles(box, job);
  for (std::uint32_t e = 0; e < box.edgeCount(); ++e)
    EXPECT_TRUE(std::abs(bends[e]) < 1e-6 || std::abs(bends[e] + kPi / 2) < 1e-6) << bends[e];
  const Surface corner(test::skinOf({"#.", "##"}), job);
  const std::vector<float> inner = bendAngles(corner, job);
  EXPECT_EQ(std::count_if(inner.begin(), inner.end(), [](float b) { return b > 1.5; }), 1);
}

TEST(SeamCosts, CreasesAreCheaperAndValleysCheapest) {
  Job job;
  const Surface corner(test::skinOf({"#.", "##"}), job);
  const std::vector<float> bends = bendAngles(corner, job), costs = seamCosts(corner, {}, job);
  for (std::uint32_t e = 0; e < corner.edgeCount(); ++e) {
    const double ratio = costs[e] / corner.length(e);
    EXPECT_NEAR(ratio, bends[e] > 1 ? 0.3 : bends[e] < -1 ? 0.5 : 1.0, 1e-6);
  }
}

TEST(SurfacePaths, AreAsShortAsThePlainOnes) {
  Job job;
  const Surface surface(makeTorus({.segments = 24, .sides = 10}), job);
  const std::vector<float> costs = seamCosts(surface, {}, job);
  SurfacePaths paths(surface, costs);
  paths.startFrom(17);
  const std::vector<double> plain = plainDistances(surface, costs, 17);
  for (std::uint32_t v : {0u, 100u, 239u, 17u}) {
    const std::vector<std::uint32_t> path = paths.pathTo(v, job);
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front(), 17u);
    EXPECT_EQ(path.back(), v);
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += costs[surface.edgeBetween(path[i - 1], path[i])];
    EXPECT_NEAR(sum, plain[v], 1e-6);
    EXPECT_NEAR(paths.distance(v), plain[v], 1e-6);
  }
}

TEST(SurfacePaths, FollowAnEdgeOfABoxWhenCreasesAreCheap) {
  Job job;
  const Surface box(makeBox({.cells = 8}), job);
  const std::vector<float> bends = bendAngles(box, job), costs = seamCosts(box, {}, job);
  // From corner to corner of one face: along two creases, not across the face's diagonal edges.
  std::uint32_t low = 0, high = 0;
  for (std::uint32_t v = 0; v < box.vertexCount(); ++v) {
    if (box.positions[v] == Vec3(-0.5f, -0.5f, 0.5f)) low = v;
    if (box.positions[v] == Vec3(0.5f, 0.5f, 0.5f)) high = v;
  }
  SurfacePaths paths(box, costs);
  paths.startFrom(low);
  const auto path = paths.pathTo(high, job);
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_GT(std::abs(bends[box.edgeBetween(path[i - 1], path[i])]), 1.0f);
}

TEST(SurfacePaths, TellWhenThereIsNoWay) {
  Job job;
  TriMesh two = makePlane({.columns = 1, .rows = 1});
  const std::size_t n = two.positions.size();
  for (std::size_t v = 0; v < n; ++v) two.positions.push_back(two.positions[v] + Vec3(0, 5, 0));
  two.normals.resize(two.positions.size(), Vec3(0, 1, 0));
  for (std::size_t t = 0; t < 2; ++t) two.triangles.push_back(two.triangles[t] + UVec3(std::uint32_t(n)));
  const Surface surface(two, job);
  const std::vector<float> costs = seamCosts(surface, {}, job);
  SurfacePaths paths(surface, costs);
  paths.startFrom(0);
  EXPECT_TRUE(paths.pathTo(std::uint32_t(n), job).empty());
  EXPECT_THROW(SurfacePaths(surface, std::vector<float>(3)), ValueError);
}

TEST(SurfacePaths, StopWhenCancelled) {
  Job job;
  const Surface surface(makeSphere({.segments = 512, .rings = 256}), job);
  const std::vector<float> costs = seamCosts(surface, {}, job);
  SurfacePaths paths(surface, costs);
  paths.startFrom(0);
  job.cancel();
  EXPECT_THROW(paths.reachAll(job), Cancelled);
}

TEST(Seams, AChainEndsAtForksAndAtItsEnds) {
  Job job;
  const Surface plane(makePlane({.columns = 8, .rows = 8}), job);  // vertices row by row, 9 to a row
  Seams seams(plane);
  const std::vector<std::uint32_t> across{9, 10, 11, 12, 13, 14, 15, 16, 17}, down{13, 22, 31, 40};
  cutPath(plane, across, seams);
  cutPath(plane, down, seams);
  EXPECT_EQ(seams.count(), 11u);
  EXPECT_EQ(seamChain(plane, seams, plane.edgeBetween(31, 40)).size(), 3u);
  EXPECT_EQ(seamChain(plane, seams, plane.edgeBetween(10, 11)).size(), 4u);
  EXPECT_TRUE(seamChain(plane, seams, plane.edgeBetween(40, 41)).empty());
  EXPECT_THROW(cutPath(plane, std::vector<std::uint32_t>{0, 40}, seams), ValueError);
}

TEST(Seams, AChainRoundALoopHasEachEdgeOnce) {
  Job job;
  const Surface surface(test::tube(12, 4), job);
  Seams seams(surface);
  std::vector<std::uint32_t> ring(12);
  std::iota(ring.begin(), ring.end(), 24u);
  ring.push_back(24);
  cutPath(surface, ring, seams);
  EXPECT_EQ(seamChain(surface, seams, surface.edgeBetween(30, 31)).size(), 12u);
}

TEST(Seams, TextOfNothingIsEmptyAndBadTextIsRefused) {
  Job job;
  const Surface surface(makeBox({}), job);
  EXPECT_EQ(seamsToText(surface, Seams(surface)), "");
  EXPECT_EQ(seamsFromText(surface, " ; ").count(), 0u);
  EXPECT_THROW(seamsFromText(surface, "0 x"), ValueError);
  EXPECT_THROW(seamsFromText(surface, "0 99999999999999"), ValueError);
  EXPECT_THROW(seamsFromText(surface, "0 4000"), ValueError);
}

RC_GTEST_PROP(SeamsProperty, TextRoundTrips, ()) {
  static Job job;
  static const Surface surface(makeTorus({.segments = 9, .sides = 5}), job);
  Seams seams(surface);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) seams.set(e, *rc::gen::inRange(0, 4) == 0);
  const std::string text = seamsToText(surface, seams);
  RC_ASSERT(seamsFromText(surface, text) == seams);
}

TEST(Seams, LengthLeavesBordersOut) {
  Job job;
  const Surface plane(makePlane({.columns = 4, .rows = 4}), job);
  Seams seams(plane);
  for (std::uint32_t e = 0; e < plane.edgeCount(); ++e) seams.set(e, plane.isBorder(e));
  EXPECT_EQ(seamLength(plane, seams), 0.0);
  cutPath(plane, std::vector<std::uint32_t>{6, 7, 8}, seams);
  EXPECT_NEAR(seamLength(plane, seams), 0.5, 1e-6);
}

}  // namespace
}  // namespace prt
