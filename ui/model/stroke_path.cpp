#include "ui/model/stroke_path.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {

// Relative to the diagonal of the bounding box.
constexpr double kTolerance = 5e-4, kShortest = 4e-3;

float distanceToPiece(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const float square = dot(along, along);
  const float t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0f, 1.0f) : 0.0f;
  return distance(p, a + t * along);
}

}  // namespace

std::vector<Vec3> simplified(const std::vector<Vec3>& points, float tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> pieces{{0, points.size() - 1}};
  while (!pieces.empty()) {
    const auto [first, last] = pieces.back();
    pieces.pop_back();
    float most = tolerance;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const float d = distanceToPiece(points[i], points[first], points[last]); d > most)
        most = d, farthest = i;
    if (farthest == first) continue;
    kept[farthest] = true;
    pieces.emplace_back(first, farthest);
    pieces.emplace_back(farthest, last);
  }
  std::vector<Vec3> few;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) few.push_back(points[i]);
  return few;
}

StrokePath::StrokePath(std::shared_ptr<const PaintSurface> on) : on_(std::move(on)), sheets_(on_->sheets) {}

bool StrokePath::add(const SurfaceHit& hit) {
  if (hit.back || hit.triangle >= on_->surface.triangleCount()) return false;
  if (!points_.empty()) {
    if (hit.position == points_.back()) return false;
    if (!sheets_.sameSheet(points_.back(), triangle_, hit.position, hit.triangle)) return false;
  }
  points_.push_back(hit.position);
  triangle_ = hit.triangle;
  return true;
}

FieldStroke StrokePath::stroke() const {
  float length = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) length += distance(points_[i - 1], points_[i]);
  if (double(length) < kShortest * on_->diagonal) return {};
  return {simplified(points_, float(kTolerance * on_->diagonal))};
}

}  // namespace prt::ui
