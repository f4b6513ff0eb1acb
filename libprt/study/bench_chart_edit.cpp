// What a hand waits for: a chart of 10 000 triangles cut from its rim, and a corner of its polygon dragged,
// through what the studio's chart editor calls.

#include "libprt/atlas/chart_settings.h"
#include "libprt/mesh/generate.h"
#include "libprt/study/bench_list.h"

#include <cmath>

namespace prt {
namespace {

/// A sheet with a hill in it: one chart that is not flat.
TriMesh hill() {
  TriMesh mesh = makePlane({.columns = 71, .rows = 70});
  for (Vec3& p : mesh.positions) p.y = 0.3f * std::exp(-12 * (p.x * p.x + p.z * p.z));
  return mesh;
}

/// Milliseconds until something is seen, and until it is at rest.
struct Waits {
  double first = 0, settled = 0;
};

/// One seam from the middle of a side to the hilltop: the way, the chart with it, its boundary and a first
/// step.
Waits cutOnce(const Surface& surface, const std::vector<float>& costs, Job& job) {
  std::unique_ptr<FlatChart> flat;
  std::unique_ptr<Flattening> flattening;
  Waits waits;
  waits.first = 1e3 * secondsOf([&] {
                  SurfacePaths paths(surface, costs);
                  paths.startFrom(35);
                  Seams seams(surface);
                  cutPath(surface, paths.pathTo(35 * 72 + 35, job), seams);
                  const Charts charts = makeCharts(surface, seams, job);
                  flat = std::make_unique<FlatChart>(surface, charts.charts.at(0), "chart 1");
                  flattening = std::make_unique<Flattening>(*flat, FlattenOptions{}, job);
                  flattening->step(job);
                });
  waits.settled = waits.first + 1e3 * secondsOf([&] {
                                  while (flattening->step(job)) {
                                  }
                                  flattening->finish(job);
                                });
  return waits;
}

/// A corner of the settled chart one boundary vertex further.
Waits dragCorner(const Surface& surface, Job& job) {
  const Charts charts = makeCharts(surface, Seams(surface), job);
  const FlatChart flat(surface, charts.charts.at(0), "chart 1");
  FlattenOptions options;
  options.boundary = ChartBoundary::Polygon;
  options.cornerCount = 5;
  Flattening flattening(flat, options, job);
  while (flattening.step(job)) {
  }
  std::vector<std::uint32_t> corners = flattening.corners();
  Waits waits;
  const auto drag = [&] {
    corners[1] += 1;
    waits.first = 1e3 * secondsOf([&] {
                    flattening.setCorners(corners, job);
                    flattening.step(job);
                  });
  };
  drag();  // makes what later ones use again
  const double begin = waits.first;
  drag();
  waits.first = std::max(waits.first, begin);
  waits.settled = waits.first + 1e3 * secondsOf([&] {
                                  while (flattening.step(job)) {
                                  }
                                  flattening.finish(job);
                                });
  return waits;
}

}  // namespace

void benchChartEdit(BenchResult& result, Job& job) {
  InnerJob inner(job);
  const Surface surface(hill(), inner.job);
  const std::vector<float> costs = seamCosts(surface, {}, inner.job);
  const Waits cut = cutOnce(surface, costs, inner.job), corner = dragCorner(surface, inner.job);
  result.details["edit_faces"] = double(surface.triangleCount());
  result.details["edit_cut_first_ms"] = cut.first;
  result.details["edit_cut_settled_ms"] = cut.settled;
  result.details["edit_corner_first_ms"] = corner.first;
  result.details["edit_corner_settled_ms"] = corner.settled;
  result.details["edit_limit_ms"] = 100;
}

}  // namespace prt
