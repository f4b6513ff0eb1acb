#pragma once
// Wishes ("this spot of the surface from that part of the patch") as a brush lays and takes them away, and as
// they are shown. Without Qt.

#include "libprt/synthesis/texture_synthesis.h"
#include "ui/model/painting.h"

#include <vector>

namespace prt::ui {

/// Spots along a drag, each near enough to the last one for the wish to hold between them at full strength.
class WishTrail {
 public:
  /// `brush`: what every spot wishes; its centre does not count.
  explicit WishTrail(const PatchWish& brush) : brush_(brush) {}

  /// Goes on to a place; true when that made a new spot.
  bool add(const Vec3& place);
  const std::vector<PatchWish>& spots() const { return spots_; }

 private:
  PatchWish brush_;
  std::vector<PatchWish> spots_;
};

/// `wishes`, and spots over them: what a spot covers to more than half is its own, older wishes there go.
std::vector<PatchWish> paintedOver(const std::vector<PatchWish>& wishes, const std::vector<PatchWish>& spots);
/// Without those whose middle lies within `radius` of a place.
std::vector<PatchWish> erasedAround(const std::vector<PatchWish>& wishes, const Vec3& place, float radius);

/// The point of the surface that is nearest to a place, every triangle tried.
SurfacePoint nearestPoint(const Surface& surface, const Vec3& place, Job& job);
/// A spot as corners of triangles that follow the surface.
std::vector<Vec3> spotTriangles(const Surface& surface, const SurfacePoint& centre, float radius);
/// What spots of a part of the patch are shown in: u in red and v in green, as id maps are. Of few different
/// ones.
Rgb colorOfPart(const Vec2& place);

}  // namespace prt::ui
