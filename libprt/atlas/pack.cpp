#include "libprt/atlas/pack.h"

#include "libprt/atlas/convex_hull.h"
#include "libprt/atlas/pack_compact.h"
#include "libprt/core/error.h"

#include <algorithm>

namespace prt {
namespace {

/// The turn that makes the bounding box least, long side along x.
double boxAngle(const std::vector<DVec2>& outline) {
  const std::vector<DVec2> hull = convexHull(outline);
  double best = 0, least = -1;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const DVec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double angle = -std::atan2(side.y, side.x), c = std::cos(angle), s = std::sin(angle);
    DVec2 low(1e300), high(-1e300);
    for (const DVec2& p : hull) {
      const DVec2 q(c * p.x - s * p.y, s * p.x + c * p.y);
      low = min(low, q), high = max(high, q);
    }
    const double area = (high.x - low.x) * (high.y - low.y);
    if (least < 0 || area < least) {
      least = area;
      best = high.x - low.x >= high.y - low.y ? angle : angle + kPi / 2;
    }
  }
  return best;
}

PackTask makeTask(std::span<const PackChart> charts, std::span<const ChartPlacement> locked,
                  const PackOptions& options) {
  PackTask task;
  task.charts = charts;
  task.locked = locked;
  task.options = options;
  for (std::uint32_t c = 0; c < charts.size(); ++c) {
    const PackChart& chart = charts[c];
    task.relative.push_back(chart.flatArea > 0 ? std::sqrt(chart.area / chart.flatArea * chart.weight) : 0);
    const bool stays = !locked.empty() && locked[c].locked;
    if (stays) {
      task.lockedArea += chart.flatArea * locked[c].scale * locked[c].scale;
    } else {
      task.free.push_back(c);
      task.area += chart.area * chart.weight;
    }
    task.angles.push_back(stays ? 0 : boxAngle(chart.outline));
  }
  std::stable_sort(task.free.begin(), task.free.end(), [&](std::uint32_t a, std::uint32_t b) {
    return charts[a].area * charts[a].weight > charts[b].area * charts[b].weight;
  });
  return task;
}

/// Where the charts of a layout are in the square; locked ones stay.
std::vector<ChartPlacement> placesOf(const PackTask& task, const PackLayout& layout) {
  const int cells = layout.cells;
  std::vector<ChartPlacement> places(task.charts.size());
  for (std::size_t c = 0; c < task.locked.size(); ++c)
    if (task.locked[c].locked) places[c] = task.locked[c];
  const double scale = task.scaleOf(layout.part);
  for (std::uint32_t c : task.free) {
    const PackSpot& spot = layout.spots[c];
    const PackMask mask = makeMask(task.turned(c, scale, spot.angle, cells), task.margin(cells));
    places[c].scale = scale * task.relative[c];
    places[c].angle = spot.angle;
    places[c].offset = (mask.origin + DVec2(spot.x, spot.y)) / double(cells);
  }
  return places;
}

}  // namespace

std::vector<ChartPlacement> packCharts(std::span<const PackChart> charts,
                                       std::span<const ChartPlacement> locked, const PackOptions& options,
                                       Job& job) {
  if (options.size < 16 || options.gutter < 0)
    throw ValueError("an atlas has 16 texels a side or more and a gutter of 0 or more", "atlas",
                     "set atlas.size");
  const PackTask task = makeTask(charts, locked, options);
  if (task.free.empty()) return {locked.begin(), locked.end()};
  job.begin("packing", 3, "passes");
  constexpr int kCoarse = 256, kFine = 512;        // cells
  constexpr double kWork = 600, kFineWork = 1400;  // charts placed
  PackLayout layout = searchLayout(task, std::min(options.size, kCoarse), kWork * options.effort, job);
  job.advance(1);
  if (layout.part > 0 && options.size > kCoarse)
    layout = searchLayout(task, std::min(options.size, kFine), kFineWork, job, &layout);
  job.advance(1);
  if (layout.part == 0)
    throw ResourceError(std::to_string(charts.size()) + " charts do not fit into " +
                            std::to_string(options.size) + " x " + std::to_string(options.size) + " texels",
                        "atlas.size", "make the atlas larger, the gutter smaller, or cut fewer charts");
  std::vector<ChartPlacement> places = placesOf(task, layout);
  const bool anyLocked = task.free.size() < charts.size();
  return anyLocked ? places : compactLayout(task, std::move(places), options.size, job);
}

}  // namespace prt
