#include "libprt/atlas/flatten.h"

#include "libprt/atlas/orientation.h"
#include "libprt/atlas/stretch_sweep.h"
#include "libprt/core/error.h"

#include <algorithm>

namespace prt {
namespace {

double signedArea(const std::vector<DVec2>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

}  // namespace

Flattening::Flattening(const FlatChart& chart, const FlattenOptions& options, Job& job)
    : chart_(chart), options_(options) {
  if (options.boundary == ChartBoundary::Polygon) {
    layBoundary(
        options.corners.empty() ? spreadCorners(chart.rimLengths, options.cornerCount) : options.corners,
        job);
  } else {
    boundary_ = boundaryOnCircle(chart);
  }
  uv_ = bijectiveMap(chart, boundary_, options.name, job);
}

Flattening::Flattening(const FlatChart& chart, std::vector<DVec2> start, const FlattenOptions& options,
                       Job& job)
    : chart_(chart), options_(options), uv_(std::move(start)) {
  job.checkCancelled();
  options_.boundary = ChartBoundary::Free;
  if (!isInjective(chart, uv_))
    throw ValueError("the start is not one-to-one", options.name, "start without one");
}

void Flattening::layBoundary(std::vector<std::uint32_t> corners, Job& job) {
  job.checkCancelled();
  corners = usableCorners(chart_.rimLengths, std::move(corners));
  polygon_ = layOnPolygon(chart_.rimLengths, corners, sidesToBow(chart_, corners));
  // As large as the chart: what is left is distortion, not scale.
  boundary_ = polygon_.points;
  const double scale = std::sqrt(chart_.area / signedArea(boundary_));
  for (DVec2& p : boundary_) p *= scale;
}

void Flattening::setCorners(std::vector<std::uint32_t> corners, Job& job) {
  if (options_.boundary != ChartBoundary::Polygon)
    throw ValueError("a chart with a free boundary has no corners", options_.name,
                     "lay it on a polygon first");
  layBoundary(std::move(corners), job);
  if (!tutte_) tutte_.emplace(chart_, false, job);
  // Old inside + harmonic extension of how the boundary moved.
  std::vector<DVec2> shift(boundary_.size());
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = boundary_[i] - uv_[chart_.rim[i]];
  std::vector<DVec2> moved = tutte_->map(shift);
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += uv_[v];
  for (std::size_t i = 0; i < boundary_.size(); ++i) moved[chart_.rim[i]] = boundary_[i];
  if (!flippedTriangles(chart_, moved).empty()) moved = tutte_->map(boundary_);
  if (!flippedTriangles(chart_, moved).empty()) moved = bijectiveMap(chart_, boundary_, options_.name, job);
  uv_ = std::move(moved);
  descent_.reset();
  stepsDone_ = smallSteps_ = 0;
}

bool Flattening::step(Job& job) {
  if (!descent_) {
    descent_.emplace(chart_, options_.boundary == ChartBoundary::Polygon, job);
    energy_ = descent_->energy(uv_);
  }
  if (stepsDone_ >= options_.steps) return false;
  const double before = energy_;
  energy_ = descent_->step(uv_, job);
  ++stepsDone_;
  // Far from the end small steps may be an obstacle being passed: only several of them are one.
  const bool small = !(before - energy_ > options_.tolerance * std::max(before - 1, 1e-9));
  smallSteps_ = small ? smallSteps_ + 1 : 0;
  return smallSteps_ < (energy_ > 1.5 ? 5 : 1);
}

void Flattening::finish(Job& job) {
  sweepStretch(chart_, uv_, options_.sweeps, job);
  if (options_.boundary == ChartBoundary::Free) center();
}

void Flattening::center() {
  DVec2 low = uv_[0], high = uv_[0];
  for (const DVec2& p : uv_) low = min(low, p), high = max(high, p);
  for (DVec2& p : uv_) p -= 0.5 * (low + high);
}

std::vector<DVec2> flatten(const FlatChart& chart, const FlattenOptions& options, Job& job,
                           const std::vector<DVec2>* start, const FlattenPreview& preview) {
  const bool useStart = start && options.boundary == ChartBoundary::Free && isInjective(chart, *start);
  Flattening flattening =
      useStart ? Flattening(chart, *start, options, job) : Flattening(chart, options, job);
  if (preview) preview(flattening.uv());
  while (flattening.step(job))
    if (preview) preview(flattening.uv());
  flattening.finish(job);
  return flattening.uv();
}

}  // namespace prt
