#pragma once
// Spots of a surface as a brush lays and takes them away, and as they are shown: wishes for parts of the
// patch, and where layers cover it. Without Qt.

#include "libprt/synthesis/layer_masks.h"
#include "libprt/synthesis/texture_synthesis.h"
#include "ui/model/painting.h"

#include <algorithm>
#include <vector>

namespace prt::ui {

/// Middles of spots along a drag, each near enough to the last one for what is painted to be full between
/// them.
class SpotTrail {
 public:
  explicit SpotTrail(float radius) : radius_(radius) {}

  /// Goes on to a place; true when that made a new spot.
  bool add(const Vec3& place);
  const std::vector<Vec3>& centres() const { return centres_; }

 private:
  float radius_;
  std::vector<Vec3> centres_;
};

/// `spots`, and a brush at many places over them: what it covers to more than half is its own, older spots
/// there go. Spot: PatchWish or LayerSpot.
template <class Spot>
std::vector<Spot> paintedOver(const std::vector<Spot>& spots, const Spot& brush,
                              const std::vector<Vec3>& centres) {
  constexpr float kCovered = 0.6f;  // a middle within so much of a spot's radius is covered by it
  std::vector<Spot> result;
  for (const Spot& spot : spots) {
    const bool covered = spot.radius <= brush.radius * 1.01f &&
                         std::any_of(centres.begin(), centres.end(), [&](const Vec3& centre) {
                           return distance(spot.centre, centre) < kCovered * brush.radius;
                         });
    if (!covered) result.push_back(spot);
  }
  for (const Vec3& centre : centres) {
    result.push_back(brush);
    result.back().centre = centre;
  }
  return result;
}

/// Without those whose middle lies within `radius` of a place.
template <class Spot>
std::vector<Spot> erasedAround(std::vector<Spot> spots, const Vec3& place, float radius) {
  std::erase_if(spots, [&](const Spot& spot) { return distance(spot.centre, place) < radius; });
  return spots;
}

/// The point of the surface that is nearest to a place, every triangle tried.
SurfacePoint nearestPoint(const Surface& surface, const Vec3& place, Job& job);
/// A spot as corners of triangles that follow the surface.
std::vector<Vec3> spotTriangles(const Surface& surface, const SurfacePoint& centre, float radius);
/// What spots of a part of the patch are shown in: u in red and v in green, as id maps are. Of few different
/// ones.
Rgb colorOfPart(const Vec2& place);
/// What layers are shown in, told apart by their number.
Rgb colorOfLayer(int layer);

}  // namespace prt::ui
