#include "libprt/atlas/flatten.h"

#include "libprt/atlas/arap.h"
#include "libprt/atlas/orientation.h"
#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/generate.h"
#include "tests/atlas/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>

namespace prt {
namespace {

/// The chart of a whole mesh, cut as suggested where it is no disk.
FlatChart chartOf(const TriMesh& mesh) {
  Job job;
  const Surface surface(mesh, job);
  Seams seams(surface);
  const Charts charts = makeDisks(surface, seams, seamCosts(surface, {}, job), job);
  return FlatChart(surface, charts.charts.at(0), "chart 1");
}

double flatL2(const FlatChart& chart, const FlattenOptions& options = {}) {
  Job job;
  const std::vector<DVec2> uv = flatten(chart, options, job);
  EXPECT_TRUE(isInjective(chart, uv) || options.boundary == ChartBoundary::Polygon);
  EXPECT_TRUE(flippedTriangles(chart, uv).empty());
  return stretchOf(chart.positions, uv, chart.triangles).l2();
}

TEST(SparseCholesky, SolvesWhatADenseSolverSolves) {
  Job job;
  constexpr std::size_t kNodes = 40;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t i = 0; i < kNodes; ++i)
    for (std::uint32_t j = i + 1; j < kNodes; ++j)
      if (hashUniform(1, i * kNodes + j) < 0.12f) edges.push_back(i % 2 ? std::pair(i, j) : std::pair(j, i));
  SparseCholesky<2> solver(kNodes, edges, job);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * kNodes, 2 * kNodes);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::array<double, 4> block;
    for (std::size_t k = 0; k < 4; ++k) block[k] = hashUniform(2, e, std::uint32_t(k)) - 0.5;
    solver.addEdge(e, block);
    const auto i = 2 * Eigen::Index(edges[e].first), j = 2 * Eigen::Index(edges[e].second);
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) dense(i + r, j + c) = dense(j + c, i + r) = block[std::size_t(2 * r + c)];
  }
  for (std::uint32_t v = 0; v < kNodes; ++v) {
    solver.addDiagonal(v, {9, 1, 1, 8});
    dense.block<2, 2>(2 * v, 2 * v) << 9, 1, 1, 8;
  }
  ASSERT_TRUE(solver.factorise(job));
  std::vector<std::array<double, 2>> x(kNodes);
  Eigen::VectorXd right(2 * kNodes);
  for (std::size_t v = 0; v < kNodes; ++v)
    for (std::size_t k = 0; k < 2; ++k)
      x[v][k] = right[Eigen::Index(2 * v + k)] = hashUniform(3, v, std::uint32_t(k));
  solver.solve(x);
  const Eigen::VectorXd plain = dense.ldlt().solve(right);
  for (std::size_t v = 0; v < kNodes; ++v)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(x[v][k], plain[Eigen::Index(2 * v + k)], 1e-12);
  solver.addDiagonal(3, {-100, 0, 0, 0});
  EXPECT_FALSE(solver.factorise(job));
}

TEST(Stretch, IsThatOfTheSingularValues) {
  const std::array<DVec3, 3> q{DVec3(0, 0, 0), DVec3(6, 0, 0), DVec3(0, 2, 0)};
  const std::array<DVec2, 3> p{DVec2(0, 0), DVec2(2, 0), DVec2(0, 2)};
  const TriangleStretch s = triangleStretch(q, p);  // 3 and 1
  EXPECT_NEAR(s.l2, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(s.lInf, 3, 1e-12);
  EXPECT_TRUE(std::isinf(triangleStretch(q, {p[0], p[2], p[1]}).l2));
}

TEST(Stretch, IsTheSameAtAnyScaleAndOneForAnIsometry) {
  const FlatChart disk = chartOf(test::flatDisk(24, 6));
  for (const double scale : {1.0, 0.01, 300.0}) {
    std::vector<DVec2> uv;
    for (const DVec3& p : disk.positions) uv.push_back(scale * DVec2(p.x, -p.z));
    const StretchSum sum = stretchOf(disk.positions, uv, disk.triangles);
    EXPECT_NEAR(sum.l2(), 1, 1e-12);
    EXPECT_NEAR(sum.lInf(), 1, 1e-9);
    EXPECT_NEAR(sum.scaled(7).l2(), 1, 1e-12);
  }
}

TEST(Flatten, AFlatDiskStaysAsItIs) {
  EXPECT_NEAR(flatL2(chartOf(test::flatDisk(32, 8))), 1.0, 1e-6);
}

TEST(Flatten, ACylinderAndAConeUnrollWithoutStretch) {
  EXPECT_NEAR(flatL2(chartOf(test::tube(32, 12))), 1.0, 1e-4);
  EXPECT_NEAR(flatL2(chartOf(test::tube(32, 12, 1, 2, 0.2f))), 1.0, 1e-4);
}

TEST(Flatten, AHemisphereHasItsKnownStretchWhateverTheMesh) {
  // The best map of a hemisphere is above 1; refinement must not change it.
  const double coarse = flatL2(chartOf(test::sphereCap(32, 10))),
               fine = flatL2(chartOf(test::sphereCap(64, 20)));
  EXPECT_GT(coarse, 1.02);
  EXPECT_LT(coarse, 1.10);
  EXPECT_NEAR(coarse, fine, 0.005);
}

TEST(Flatten, ADeepCapIsUnfoldedWithoutFlips) {
  EXPECT_LT(flatL2(chartOf(test::sphereCap(48, 30, -0.95))), 1.7);
}

TEST(Flatten, DeepChartsOpenUpAndStripsSlideAlongThemselves) {
  // In Tutte's map the far end of a long strip is a millionth of its size.
  EXPECT_NEAR(flatL2(chartOf(makePlane({.width = 1, .depth = 40, .columns = 4, .rows = 160}))), 1.0, 1e-3);
  EXPECT_NEAR(flatL2(chartOf(test::spiral(2.5, 240))), 1.0, 1e-2);
}

TEST(Flatten, ASlitSphereAndACutTorusStayInjective) {
  EXPECT_LT(flatL2(chartOf(makeIcosphere({.subdivisions = 3}))), 2.5);
  EXPECT_LT(flatL2(chartOf(makeTorus({.segments = 48, .sides = 20}))), 1.4);
}

TEST(Flatten, OnAPolygonTheBoundaryStaysOnItsSides) {
  Job job;
  const FlatChart cap = chartOf(test::sphereCap(32, 10));
  FlattenOptions options;
  options.boundary = ChartBoundary::Polygon;
  options.cornerCount = 4;
  Flattening flattening(cap, options, job);
  while (flattening.step(job)) {
  }
  flattening.finish(job);
  ASSERT_EQ(flattening.corners().size(), 4u);
  EXPECT_TRUE(flippedTriangles(cap, flattening.uv()).empty());
  for (std::size_t side = 0; side < 4; ++side) {
    const std::uint32_t from = flattening.corners()[side],
                        to = side < 3 ? flattening.corners()[side + 1] : 32;
    const DVec2 a = flattening.uv()[cap.rim[from]], b = flattening.uv()[cap.rim[to % 32]];
    for (std::uint32_t i = from; i < to; ++i)
      EXPECT_NEAR(signedArea2(a, b, flattening.uv()[cap.rim[i]]), 0, 1e-9);
  }
  // Starting from Tutte's map the stretch only fell.
  Flattening start(cap, options, job);
  EXPECT_LT(flattening.stretch().l2(), start.stretch().l2());
}

TEST(Flatten, SidesWithDividingEdgesAreBowed) {
  Job job;
  // A strip two triangles wide has ears along its border.
  const FlatChart strip = chartOf(makePlane({.columns = 8, .rows = 1}));
  FlattenOptions options;
  options.boundary = ChartBoundary::Polygon;
  options.corners = {0, 3, 12};
  Flattening flattening(strip, options, job);
  EXPECT_TRUE(flippedTriangles(strip, flattening.uv()).empty());
  const std::vector<bool>& bowed = flattening.polygon().bowed;
  EXPECT_TRUE(std::find(bowed.begin(), bowed.end(), true) != bowed.end());
}

TEST(Flatten, ADraggedCornerKeepsTheMapInjective) {
  Job job;
  const FlatChart cap = chartOf(test::sphereCap(48, 12));
  FlattenOptions options;
  options.boundary = ChartBoundary::Polygon;
  options.cornerCount = 5;
  Flattening flattening(cap, options, job);
  while (flattening.step(job)) {
  }
  std::vector<std::uint32_t> corners = flattening.corners();
  for (int i = 0; i < 6; ++i) {
    corners[1] += 1;
    flattening.setCorners(corners, job);
    EXPECT_TRUE(flippedTriangles(cap, flattening.uv()).empty());
    flattening.step(job);
    EXPECT_TRUE(flippedTriangles(cap, flattening.uv()).empty());
  }
  EXPECT_EQ(flattening.corners(), corners);
}

TEST(Flatten, SliversKeepTheirOrientation) {
  // Rows of needles: heights down to a hundred-thousandth of their length.
  TriMesh mesh = makePlane({.width = 1, .depth = 1, .columns = 12, .rows = 12});
  for (Vec3& p : mesh.positions) {
    const float row = std::round((p.z + 0.5f) * 12);
    p.z = row < 6 ? row * 1e-5f : 6e-5f + (row - 6) / 6;
  }
  EXPECT_NEAR(flatL2(chartOf(mesh)), 1.0, 0.05);
}

TEST(Flatten, NamesTheChartThatIsNoDiskOrTooDeep) {
  Job job;
  const Surface torus(makeTorus({}), job);
  const Charts charts = makeCharts(torus, Seams(torus), job);
  try {
    FlatChart(torus, charts.charts[0], "chart 7");
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_EQ(error.where(), "chart 7");
    EXPECT_NE(error.problem().find("1 handle"), std::string::npos);
  }
}

TEST(Flatten, ShowsEveryStep) {
  Job job;
  const FlatChart cap = chartOf(test::sphereCap(24, 8));
  int shown = 0;
  flatten(cap, {}, job, nullptr, [&](const std::vector<DVec2>& uv) {
    EXPECT_TRUE(isInjective(cap, uv));
    ++shown;
  });
  EXPECT_GT(shown, 2);
}

TEST(Flatten, StopsWhenCancelled) {
  const FlatChart cap = chartOf(test::sphereCap(64, 32));
  Job job;
  int shown = 0;
  EXPECT_THROW(flatten(cap, {}, job, nullptr,
                       [&](const std::vector<DVec2>&) {
                         if (++shown == 2) job.cancel();
                       }),
               Cancelled);
  EXPECT_EQ(shown, 2);
}

TEST(Arap, UnrollsACylinderFromTuttesMap) {
  Job job;
  const FlatChart side = chartOf(test::tube(24, 8));
  std::vector<DVec2> uv = bijectiveMap(side, boundaryOnCircle(side), "chart", job);
  uv = asRigidAsPossible(side, uv, 200, job);
  EXPECT_NEAR(stretchOf(side.positions, uv, side.triangles).l2(), 1, 0.02);
}

}  // namespace
}  // namespace prt
