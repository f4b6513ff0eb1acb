#pragma once
// A line while it is drawn on a surface: places under the pointer, those left out that lie on another sheet
// behind a silhouette, and as few points in the end as leave the line where it is. Without Qt.

#include "libprt/shade/pick.h"
#include "libprt/synthesis/orientation_field.h"
#include "ui/model/painting.h"

#include <memory>
#include <vector>

namespace prt::ui {

/// Of the points of a line those that leave it within `tolerance` of every point that is left out (Douglas
/// and Peucker 1973); the first and the last stay.
std::vector<Vec3> simplified(const std::vector<Vec3>& points, float tolerance);

class StrokePath {
 public:
  explicit StrokePath(std::shared_ptr<const PaintSurface> on);

  /// Goes on to a place. False when it is left out: seen from behind, or on another sheet than the last one.
  bool add(const SurfaceHit& hit);
  const std::vector<Vec3>& points() const { return points_; }
  /// What was drawn, as the recipe keeps it; fewer than two points when it is too short to have a direction.
  FieldStroke stroke() const;

 private:
  std::shared_ptr<const PaintSurface> on_;
  SheetTest sheets_;
  std::vector<Vec3> points_;
  std::uint32_t triangle_ = kNowhere;  // of the last point
};

}  // namespace prt::ui
