#include "libprt/atlas/auto_cut.h"

#include "libprt/atlas/cluster_complex.h"
#include "libprt/atlas/straighten.h"
#include "libprt/atlas/untangle.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "tests/atlas/shapes.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <set>

namespace prt {
namespace {

FlatCharts cut(const TriMesh& mesh, double stretch = 1.10) {
  Job job;
  const Surface surface(mesh, job);
  AutoCutOptions options;
  options.stretch = stretch;
  return autoCut(surface, seamCosts(surface, {}, job), options, job);
}

/// What holds of all charts that anybody gets: disks, one-to-one, below the bound.
void expectGood(const TriMesh& mesh, const FlatCharts& charts, double bound = 1.10) {
  Job job;
  const Surface surface(mesh, job);
  for (std::size_t c = 0; c < charts.charts.charts.size(); ++c) {
    const Chart& chart = charts.charts.charts[c];
    ASSERT_EQ(chart.fault(), ChartFault::None);
    EXPECT_TRUE(isInjective(FlatChart(surface, chart, "chart"), charts.uv[c]));
  }
  EXPECT_LE(charts.total().l2(), bound);
}

TEST(Clusters, AreDisksAndCoverEverything) {
  Job job;
  for (const TriMesh& mesh : {makeVase({}), makeBird({}), makeBox({.cells = 6}), test::doubleTorus()}) {
    const Surface surface(mesh, job);
    const Clusters clusters = makeClusters(surface, bendAngles(surface, job), 40, job);
    EXPECT_GE(clusters.count, 35u);
    Seams seams(surface);
    for (std::uint32_t half = 0; half < 3 * surface.triangleCount(); ++half) {
      ASSERT_LT(clusters.clusterOf[half / 3], clusters.count);
      const std::uint32_t twin = surface.twin[half];
      if (twin != kNowhere && clusters.clusterOf[half / 3] != clusters.clusterOf[twin / 3])
        seams.set(surface.edge[half]);
    }
    const Charts charts = makeCharts(surface, seams, job);
    EXPECT_EQ(charts.charts.size(), clusters.count);
    for (const Chart& chart : charts.charts) EXPECT_EQ(chart.fault(), ChartFault::None);
  }
}

TEST(ClusterComplex, HasTheTopologyOfTheSurface) {
  Job job;
  for (const TriMesh& mesh :
       {makeTorus({}), makeBird({}), makePlane({.columns = 40, .rows = 40}), test::tube(40, 20)}) {
    const Surface surface(mesh, job);
    const Clusters clusters = makeClusters(surface, bendAngles(surface, job), 60, job);
    const ClusterComplex complex = makeClusterComplex(surface, clusters, seamCosts(surface, {}, job), job);
    const auto euler = [](const Surface& s) {
      return int(s.vertexCount()) - int(s.edgeCount()) + int(s.triangleCount());
    };
    EXPECT_EQ(euler(complex.coarse), euler(surface));
    EXPECT_LT(complex.coarse.triangleCount(), surface.triangleCount());
    const Charts whole = makeCharts(complex.coarse, Seams(complex.coarse), job);
    EXPECT_EQ(whole.charts.size(), 1u);
    EXPECT_EQ(whole.charts[0].loops.size(), makeCharts(surface, Seams(surface), job).charts[0].loops.size());
    double length = 0, area = 0;
    for (const RimArc& arc : complex.arcs) {
      EXPECT_GE(arc.edges.size(), arc.pieces.size());
      length += arc.length;
    }
    for (double a : complex.area) area += a;
    EXPECT_GT(length, 0);
    EXPECT_NEAR(area, surface.totalArea(), 1e-6 * area);
  }
}

TEST(Straighten, AZigzagBecomesAStraightCut) {
  Job job;
  const Surface plane(makePlane({.columns = 8, .rows = 8}), job);
  Seams seams(plane);
  // Down the middle column, with a detour.
  cutPath(plane, std::vector<std::uint32_t>{4, 13, 14, 23, 32, 31, 40, 49, 58, 67, 76}, seams);
  const double before = seamLength(plane, seams);
  straightenSeams(plane, seamCosts(plane, {}, job), seams, job);
  EXPECT_LT(seamLength(plane, seams), before);
  EXPECT_NEAR(seamLength(plane, seams), 1.0, 1e-6);
  EXPECT_EQ(makeCharts(plane, seams, job).charts.size(), 2u);
}

TEST(Straighten, NeverLosesAChart) {
  Job job;
  const Surface surface(makeBird({}), job);
  const Clusters clusters = makeClusters(surface, bendAngles(surface, job), 30, job);
  Seams seams(surface);
  for (std::uint32_t half = 0; half < 3 * surface.triangleCount(); ++half)
    if (surface.twin[half] != kNowhere &&
        clusters.clusterOf[half / 3] != clusters.clusterOf[surface.twin[half] / 3])
      seams.set(surface.edge[half]);
  const double before = seamLength(surface, seams);
  straightenSeams(surface, seamCosts(surface, {}, job), seams, job);
  const Charts charts = makeCharts(surface, seams, job);
  EXPECT_EQ(charts.charts.size(), clusters.count);
  for (const Chart& chart : charts.charts) EXPECT_EQ(chart.fault(), ChartFault::None);
  EXPECT_LT(seamLength(surface, seams), before);
}

TEST(Untangle, TurnsBackWhatAFlippedVertexTurnedOver) {
  Job job;
  const Surface plane(makePlane({.columns = 10, .rows = 10}), job);
  const FlatChart chart(plane, makeCharts(plane, Seams(plane), job).charts[0], "chart");
  std::vector<DVec2> uv;
  for (const DVec3& p : chart.positions) uv.push_back({p.x, -p.z});
  std::swap(uv[60], uv[61]);
  ASSERT_FALSE(flippedTriangles(chart, uv).empty());
  EXPECT_TRUE(untangle(chart, uv, job));
  EXPECT_TRUE(isInjective(chart, uv));
}

TEST(Untangle, PartsABoundaryThatCrossesItselfALittle) {
  Job job;
  // A slit disk whose two lips overlap.
  const Surface plane(makePlane({.columns = 10, .rows = 10}), job);
  Seams slit(plane);
  cutPath(plane, std::vector<std::uint32_t>{55, 56, 57, 58, 59, 60}, slit);
  const FlatChart chart(plane, makeCharts(plane, slit, job).charts[0], "chart");
  std::vector<DVec2> uv;
  for (const DVec3& p : chart.positions) uv.push_back({p.x, -p.z});  // the lips lie on each other
  ASSERT_FALSE(isInjective(chart, uv));
  EXPECT_TRUE(untangle(chart, uv, job));
  EXPECT_TRUE(isInjective(chart, uv));
}

TEST(AutoCut, APlaneIsOneChartAndABoxFewWithoutStretch) {
  const TriMesh plane = makePlane({.columns = 30, .rows = 30}), box = makeBox({.cells = 8});
  EXPECT_EQ(cut(plane).charts.charts.size(), 1u);
  const FlatCharts six = cut(box);
  EXPECT_LE(six.charts.charts.size(), 6u);
  expectGood(box, six);
  // Six faces are charts by themselves, or fewer that hang together in edges.
  const FlatCharts coarse = cut(makeBox({}));
  EXPECT_LE(coarse.charts.charts.size(), 6u);
  EXPECT_NEAR(coarse.total().l2(), 1, 1e-6);
}

TEST(AutoCut, BuiltInShapesAreFewDisksBelowTheBound) {
  for (const auto& [name, most] : std::initializer_list<std::pair<const char*, std::size_t>>{
           {"bird", 14}, {"vase", 16}, {"torus", 6}, {"rock", 32}, {"sphere", 10}}) {
    const TriMesh mesh = makeBuiltinMesh(name, 1, 1);
    const FlatCharts charts = cut(mesh);
    expectGood(mesh, charts);
    EXPECT_LE(charts.charts.charts.size(), most) << name;
  }
}

TEST(AutoCut, ASmallerBoundOnTheStretchMeansMoreSeam) {
  Job job;
  const TriMesh bird = makeBird({});
  const Surface surface(bird, job);
  const FlatCharts loose = cut(bird, 1.10), tight = cut(bird, 1.002);
  expectGood(bird, tight, 1.002);
  EXPECT_GT(seamLength(surface, tight.seams), seamLength(surface, loose.seams));
  EXPECT_THROW(cut(bird, 1.0), ValueError);
}

TEST(AutoCut, CutsThroughClustersWhereTheyStretchTooMuch) {
  // Eight patches of a sphere cannot have so little stretch, however they are joined.
  Job job;
  const TriMesh ball = makeIcosphere({.subdivisions = 3});
  const Surface surface(ball, job);
  AutoCutOptions options;
  options.clusters = 8;
  options.stretch = 1.0005;
  const FlatCharts charts = autoCut(surface, seamCosts(surface, {}, job), options, job);
  expectGood(ball, charts, 1.0005);
  EXPECT_GT(charts.charts.charts.size(), 8u);
}

TEST(AutoCut, ABoundThatIsMissedNamesTheChart) {
  FlatCharts charts;
  charts.stretch = {{1.0, 1.0, 1.0, 1.0}, {0.5 * 1.44, 0.5, 0.5, 2.0}, {1.02, 1.0, 1.0, 1.1}};
  EXPECT_TRUE(boundMissed(charts, 1.10).empty());
  const std::string line = boundMissed(charts, 1.03);
  EXPECT_NE(line.find("chart 2, which has 1.200"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(AutoCut, DoesNotDependOnTheNumberOfThreads) {
  const TriMesh vase = makeVase({});
  setThreadCount(1);
  const FlatCharts one = cut(vase);
  setThreadCount(4);
  const FlatCharts four = cut(vase);
  setThreadCount(0);
  EXPECT_TRUE(one.seams == four.seams);
  EXPECT_EQ(one.uv, four.uv);
}

TEST(AutoCut, StopsWhenCancelled) {
  Job* running = nullptr;
  Job job([&](const Progress& p) {
    if (p.phase == "merging charts" && p.done > 5 && running) running->cancel();
  });
  running = &job;
  const Surface surface(makeBird({}), job);
  const std::vector<float> costs = seamCosts(surface, {}, job);
  EXPECT_THROW(autoCut(surface, costs, {}, job), Cancelled);
}

TEST(FlattenCharts, NamesTheFirstChartThatIsNoDisk) {
  Job job;
  const Surface torus(makeTorus({}), job);
  try {
    flattenCharts(torus, Seams(torus), {}, job);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_EQ(error.where(), "chart 1");
  }
}

TEST(AutoCut, RealMeshesStayBelowTheBound) {
  PRT_NEEDS_SHARED_DATA();
  Job job;
  for (const auto& [file, most] :
       std::initializer_list<std::pair<const char*, std::size_t>>{{"meshes/spot.obj", 9},
                                                                  {"meshes/bunny_3k.off", 17},
                                                                  {"meshes/blobby.off", 40},
                                                                  {"meshes/armadillo.off", 84}}) {
    const TriMesh mesh = loadMesh(test::sharedData(file), {}, job);
    const FlatCharts charts = cut(mesh);
    expectGood(mesh, charts);
    EXPECT_LE(charts.charts.charts.size(), most) << file;
  }
}

}  // namespace
}  // namespace prt
