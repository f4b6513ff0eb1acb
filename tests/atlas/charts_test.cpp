#include "libprt/atlas/charts.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "tests/atlas/shapes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

namespace prt {
namespace {

/// Everything that must hold of charts whatever the cut.
void expectSound(const Surface& surface, const Charts& charts) {
  std::size_t faces = 0;
  double area = 0;
  for (const Chart& chart : charts.charts) {
    faces += chart.faces.size();
    area += chart.area;
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      for (int i = 0; i < 3; ++i)
        ASSERT_EQ(chart.vertices[chart.triangles[t][i]], surface.triangles[chart.faces[t]][i]);
    EXPECT_GE(chart.handles(), 0);
    EXPECT_EQ((2 - int(chart.loops.size()) - chart.euler) % 2, 0);
  }
  EXPECT_EQ(faces, surface.triangleCount());
  EXPECT_NEAR(area, surface.totalArea(), 1e-9 * area);
}

ChartFault faultOf(const TriMesh& mesh) {
  Job job;
  const Surface surface(mesh, job);
  const Charts charts = makeCharts(surface, Seams(surface), job);
  EXPECT_EQ(charts.charts.size(), 1u);
  return charts.charts.at(0).fault();
}

/// Cuts as suggested; one round must do.
Charts mended(const TriMesh& mesh, std::size_t* cut = nullptr) {
  Job job;
  const Surface surface(mesh, job);
  Seams seams(surface);
  const std::vector<float> costs = seamCosts(surface, {}, job);
  for (const Chart& chart : makeCharts(surface, seams, job).charts)
    for (std::uint32_t e : suggestedCut(surface, chart, costs, job)) seams.set(e);
  if (cut) *cut = seams.count();
  Charts charts = makeCharts(surface, seams, job);
  expectSound(surface, charts);
  return charts;
}

TEST(Charts, NameWhatIsWrong) {
  EXPECT_EQ(faultOf(makePlane({})), ChartFault::None);
  EXPECT_EQ(faultOf(makeSphere({})), ChartFault::Closed);
  EXPECT_EQ(faultOf(test::tube(8, 3)), ChartFault::Boundaries);
  EXPECT_EQ(faultOf(makeTorus({})), ChartFault::Handles);
  EXPECT_EQ(faultOf(test::doubleTorus()), ChartFault::Handles);
}

TEST(Charts, SayItInWords) {
  Job job;
  const auto text = [&](const TriMesh& mesh) {
    const Surface surface(mesh, job);
    return faultText(makeCharts(surface, Seams(surface), job).charts[0]);
  };
  EXPECT_EQ(text(makePlane({})), "a disk");
  EXPECT_EQ(text(test::tube(8, 3)), "2 boundaries instead of 1");
  EXPECT_EQ(text(makeTorus({})), "1 handle");
  EXPECT_EQ(text(test::doubleTorus()), "2 handles");
  EXPECT_EQ(text(makeIcosphere({})), "closed: no boundary to unfold from");
}

TEST(Charts, ABoxCutAlongItsEdgesIsSixSquares) {
  Job job;
  const Surface surface(makeBox({.cells = 3}), job);
  Seams seams(surface);
  const std::vector<float> bends = bendAngles(surface, job);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) seams.set(e, std::abs(bends[e]) > 1);
  const Charts charts = makeCharts(surface, seams, job);
  expectSound(surface, charts);
  ASSERT_EQ(charts.charts.size(), 6u);
  for (const Chart& chart : charts.charts) {
    EXPECT_EQ(chart.fault(), ChartFault::None);
    EXPECT_EQ(chart.loops[0].size(), 12u);
    EXPECT_EQ(chart.vertices.size(), 16u);
  }
}

TEST(Charts, BothSidesOfAnOpenSlitGetVertices) {
  Job job;
  const Surface plane(makePlane({.columns = 8, .rows = 8}), job);
  Seams seams(plane);
  cutPath(plane, std::vector<std::uint32_t>{36, 37, 38, 39}, seams);  // from the border inwards
  const Charts charts = makeCharts(plane, seams, job);
  ASSERT_EQ(charts.charts.size(), 1u);
  EXPECT_EQ(charts.charts[0].fault(), ChartFault::None);
  EXPECT_EQ(charts.charts[0].vertices.size(), 81u + 3);  // the tip of the slit stays one
}

TEST(Charts, ASlitInsideIsASecondBoundaryAndIsJoinedToTheRim) {
  Job job;
  const Surface plane(makePlane({.columns = 8, .rows = 8}), job);
  Seams seams(plane);
  cutPath(plane, std::vector<std::uint32_t>{38, 39, 40}, seams);  // two edges, 2 columns from the border
  const Charts charts = makeCharts(plane, seams, job);
  EXPECT_EQ(charts.charts[0].fault(), ChartFault::Boundaries);
  const auto cut = suggestedCut(plane, charts.charts[0], seamCosts(plane, {}, job), job);
  EXPECT_EQ(cut.size(), 2u);
}

TEST(Charts, TrianglesThatMeetInAVertexOnlyArePartedThere) {
  Job job;
  TriMesh bow;
  bow.positions = {{0, 0, 0}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  bow.normals.assign(5, Vec3(0, 1, 0));
  const Surface surface(bow, job);
  const Charts charts = makeCharts(surface, Seams(surface), job);
  ASSERT_EQ(charts.charts.size(), 2u);
  // The same inside of one chart: a fan that two cuts part but that hangs together elsewhere.
  const Surface plane(makePlane({.columns = 4, .rows = 4}), job);
  Seams seams(plane);
  cutPath(plane, std::vector<std::uint32_t>{10, 11, 12, 13, 14}, seams);  // right across: two charts
  EXPECT_EQ(makeCharts(plane, seams, job).charts.size(), 2u);
  Seams ring(plane);
  cutPath(plane, std::vector<std::uint32_t>{6, 7, 12, 11, 6}, ring);
  const Charts two = makeCharts(plane, ring, job);
  EXPECT_EQ(two.charts.size(), 2u);
  expectSound(plane, two);
}

TEST(Charts, SuggestedCutsMakeDisks) {
  for (const TriMesh& mesh : {makeSphere({}), makeTorus({}), test::doubleTorus(), test::tube(12, 4),
                              test::skinOf({"#######", "#.#.#.#", "#######"}), makeVase({}), makeBird({})}) {
    const Charts charts = mended(mesh);
    ASSERT_EQ(charts.charts.size(), 1u);
    EXPECT_EQ(charts.charts[0].fault(), ChartFault::None) << faultText(charts.charts[0]);
  }
}

TEST(Charts, ATubeIsCutStraightAlongItsSide) {
  std::size_t cut = 0;
  mended(test::tube(12, 5), &cut);
  EXPECT_EQ(cut, 5u);
}

TEST(Charts, ATorusIsCutAlongItsShortestLoops) {
  std::size_t cut = 0;
  mended(makeTorus({.segments = 48, .sides = 16}), &cut);
  EXPECT_LE(cut, 48u + 16 + 2);
}

TEST(Charts, ACutAlongOneEdgeOnlyIsLengthened) {
  Job job;
  const Surface sphere(makeIcosphere({.subdivisions = 2}), job);
  Seams seams(sphere);
  seams.set(0);
  EXPECT_EQ(makeCharts(sphere, seams, job).charts[0].fault(), ChartFault::Closed);
  std::vector<std::uint32_t> added;
  const Charts charts = makeDisks(sphere, seams, seamCosts(sphere, {}, job), job, &added);
  EXPECT_EQ(charts.charts[0].fault(), ChartFault::None);
  EXPECT_GT(charts.charts[0].loops[0].size(), 4u);
  EXPECT_FALSE(added.empty());
}

TEST(Charts, OnePieceAloneIsTheSameAsAmongAll) {
  Job job;
  const Surface surface(makeBox({.cells = 3}), job);
  Seams seams(surface);
  const std::vector<float> bends = bendAngles(surface, job);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) seams.set(e, std::abs(bends[e]) > 1);
  for (const Chart& chart : makeCharts(surface, seams, job).charts) {
    const Chart alone = makeChart(surface, seams, chart.faces);
    EXPECT_EQ(alone.triangles, chart.triangles);
    EXPECT_EQ(alone.loops, chart.loops);
    EXPECT_EQ(alone.euler, chart.euler);
  }
}

RC_GTEST_PROP(ChartsProperty, WhateverIsCutTheMendMakesDisks, ()) {
  static Job job;
  static const Surface surface(test::doubleTorus(), job);
  static const std::vector<float> costs = seamCosts(surface, {}, job);
  Seams seams(surface);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) seams.set(e, *rc::gen::inRange(0, 5) == 0);
  const Charts before = makeCharts(surface, seams, job);
  expectSound(surface, before);
  const Charts after = makeDisks(surface, seams, costs, job);
  expectSound(surface, after);
  RC_ASSERT(after.charts.size() == before.charts.size());
  for (const Chart& chart : after.charts) RC_ASSERT(chart.fault() == ChartFault::None);
}

TEST(Charts, StopWhenCancelled) {
  Job job;
  const Surface surface(makeSphere({.segments = 256, .rings = 128}), job);
  job.cancel();
  EXPECT_THROW(makeCharts(surface, Seams(surface), job), Cancelled);
}

}  // namespace
}  // namespace prt
