#include "libprt/atlas/pack.h"

#include "libprt/atlas/pack_mask.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace prt {
namespace {

double cross(const DVec2& a, const DVec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Andrew's monotone chain.
std::vector<DVec2> convexHull(std::vector<DVec2> points) {
  std::sort(points.begin(), points.end(),
            [](const DVec2& a, const DVec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<DVec2> hull;
  for (const int pass : {0, 1}) {
    const std::size_t base = hull.size();
    for (const DVec2& p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return hull.empty() ? points : hull;
}

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

class Packer {
 public:
  Packer(std::span<const PackChart> charts, std::span<const ChartPlacement> locked,
         const PackOptions& options, Job& job)
      : charts_(charts), locked_(locked), options_(options), job_(job) {
    for (std::uint32_t c = 0; c < charts.size(); ++c) {
      const PackChart& chart = charts[c];
      relative_.push_back(chart.flatArea > 0 ? std::sqrt(chart.area / chart.flatArea * chart.weight) : 0);
      const bool stays = !locked.empty() && locked[c].locked;
      if (stays) {
        const double scale = locked[c].scale;
        lockedArea_ += chart.flatArea * scale * scale;
      } else {
        order_.push_back(c);
        area_ += chart.area * chart.weight;
      }
      angles_.push_back(stays ? 0 : boxAngle(chart.outline));
    }
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return charts_[a].area * charts_[a].weight > charts_[b].area * charts_[b].weight;
    });
    // Cells coarse enough to be quick, fine enough for what lies between the charts.
    cells_ = order_.size() > 40 ? 512 : 256;
    cells_ = std::min(cells_, options.size);
  }

  std::vector<ChartPlacement> run() {
    job_.begin("packing", 8, "tries");
    if (order_.empty()) return {locked_.begin(), locked_.end()};
    // Area of the charts as part of the square, by bisection.
    double fits = 0, fails = 0.95 - lockedArea_;
    std::vector<ChartPlacement> best;
    double next = std::min(0.80, 0.9 * fails);
    for (int round = 0; round < 8; ++round) {
      std::vector<ChartPlacement> placed;
      if (next > 0 && tryScale(next, placed)) {
        best = std::move(placed);
        fits = next;
      } else {
        fails = next;
      }
      job_.advance(1);
      next = fits > 0 ? 0.5 * (fits + fails) : next * 0.85;
      if (fits > 0 && fails - fits < 0.006) break;
    }
    for (int round = 0; best.empty() && round < 40; ++round, next *= 0.7)
      if (next > 0 && !tryScale(next, best)) best.clear();
    if (best.empty())
      throw ResourceError(std::to_string(charts_.size()) + " charts do not fit into " +
                              std::to_string(options_.size) + " x " + std::to_string(options_.size) +
                              " texels",
                          "atlas.size", "make the atlas larger, the gutter smaller, or cut fewer charts");
    return best;
  }

 private:
  std::vector<DVec2> turned(std::uint32_t chart, double scale, double angle) const {
    std::vector<DVec2> outline;
    outline.reserve(charts_[chart].outline.size());
    const double c = std::cos(angle) * scale, s = std::sin(angle) * scale;
    for (const DVec2& p : charts_[chart].outline) outline.emplace_back(c * p.x - s * p.y, s * p.x + c * p.y);
    return outline;
  }

  /// Conservative by the gutter and a hair for rounding; by half a texel more where cells do not end with
  /// texels.
  double margin() const {
    const double texels = options_.gutter + (options_.size % cells_ == 0 ? 0.01 : 0.51);
    return texels * cells_ / options_.size + 1e-6;
  }

  bool tryScale(double part, std::vector<ChartPlacement>& placed) {
    const double scale = std::sqrt(part / area_);  // lengths of the surface -> sides of the square
    PackGrid grid(cells_);
    placed.assign(charts_.size(), {});
    for (std::uint32_t c = 0; c < charts_.size(); ++c) {
      if (locked_.empty() || !locked_[c].locked) continue;
      placed[c] = locked_[c];
      std::vector<DVec2> outline;
      for (const DVec2& p : charts_[c].outline) outline.push_back(locked_[c](p) * double(cells_));
      const PackMask mask = makeMask(outline, margin());
      // The mask begins at a whole cell; a locked chart does not: it takes one more on each side.
      const DVec2 at = -mask.origin;
      for (const int dx : {0, 1})
        for (const int dy : {0, 1}) grid.place(mask, int(std::floor(at.x)) + dx, int(std::floor(at.y)) + dy);
    }
    for (std::uint32_t c : order_) {
      job_.checkCancelled();
      if (!placeOne(grid, c, scale * relative_[c], placed[c])) return false;
    }
    return true;
  }

  bool placeOne(PackGrid& grid, std::uint32_t chart, double scale, ChartPlacement& placement) const {
    const int turns = std::clamp(options_.turns, 1, 64);
    struct Try {
      PackMask mask;
      double angle = 0;
      int x = 0, y = 0;
      bool found = false;
    };
    std::vector<Try> tries(static_cast<std::size_t>(turns));
    parallelFor(job_, 0, tries.size(), 2, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        Try& t = tries[i];
        // Quarter turns of the least box first, then between.
        t.angle = angles_[chart] + 2 * kPi * double(i) / double(turns);
        t.mask = makeMask(turned(chart, scale * cells_, t.angle), margin());
        t.found = grid.find(t.mask, cells_, t.x, t.y);
      }
    });
    const Try* best = nullptr;
    for (const Try& t : tries)
      if (t.found && (!best || t.y + t.mask.height < best->y + best->mask.height ||
                      (t.y + t.mask.height == best->y + best->mask.height && t.x < best->x)))
        best = &t;
    if (!best) return false;
    grid.place(best->mask, best->x, best->y);
    placement.scale = scale;
    placement.angle = best->angle;
    placement.offset = (best->mask.origin + DVec2(best->x, best->y)) / double(cells_);
    return true;
  }

  std::span<const PackChart> charts_;
  std::span<const ChartPlacement> locked_;
  const PackOptions& options_;
  Job& job_;
  std::vector<double> relative_, angles_;
  std::vector<std::uint32_t> order_;
  double area_ = 0, lockedArea_ = 0;
  int cells_ = 256;
};

}  // namespace

std::vector<ChartPlacement> packCharts(std::span<const PackChart> charts,
                                       std::span<const ChartPlacement> locked, const PackOptions& options,
                                       Job& job) {
  if (options.size < 16 || options.gutter < 0)
    throw ValueError("an atlas has 16 texels a side or more and a gutter of 0 or more", "atlas",
                     "set atlas.size");
  return Packer(charts, locked, options, job).run();
}

}  // namespace prt
