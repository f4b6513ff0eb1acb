#include "ui/model/wish_spots.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr float kSpacing = 0.4f;  // of spots, relative to their radius: a wish is full up to half of it
constexpr float kCovered = 0.6f;  // a middle within so much of a spot's radius is covered by it
constexpr int kSides = 24, kRings = 3;

}  // namespace

bool WishTrail::add(const Vec3& place) {
  for (const PatchWish& spot : spots_)
    if (distance(spot.centre, place) < kSpacing * brush_.radius) return false;
  spots_.push_back(brush_);
  spots_.back().centre = place;
  return true;
}

std::vector<PatchWish> paintedOver(const std::vector<PatchWish>& wishes,
                                   const std::vector<PatchWish>& spots) {
  std::vector<PatchWish> result;
  for (const PatchWish& wish : wishes) {
    const bool covered = std::any_of(spots.begin(), spots.end(), [&](const PatchWish& spot) {
      return wish.radius <= spot.radius * 1.01f &&
             distance(wish.centre, spot.centre) < kCovered * spot.radius;
    });
    if (!covered) result.push_back(wish);
  }
  result.insert(result.end(), spots.begin(), spots.end());
  return result;
}

std::vector<PatchWish> erasedAround(const std::vector<PatchWish>& wishes, const Vec3& place, float radius) {
  std::vector<PatchWish> result;
  for (const PatchWish& wish : wishes)
    if (distance(wish.centre, place) >= radius) result.push_back(wish);
  return result;
}

SurfacePoint nearestPoint(const Surface& surface, const Vec3& place, Job& job) {
  CancelCheck check(job);
  SurfacePoint best;
  float least = 1e30f;
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) {
    check();
    const UVec3& c = surface.triangles[t];
    const SurfacePoint point{
        t, nearestInTriangle(DVec3(place), DVec3(surface.positions[c.x]), DVec3(surface.positions[c.y]),
                             DVec3(surface.positions[c.z]))};
    if (const float d = distance(positionAt(surface, point), place); d < least) least = d, best = point;
  }
  return best;
}

std::vector<Vec3> spotTriangles(const Surface& surface, const SurfacePoint& centre, float radius) {
  const DVec3 areaNormal = surface.areaNormal(centre.triangle);
  if (!(dot(areaNormal, areaNormal) > 0)) return {};
  const Frame frame = frameFromNormal(Vec3(normalize(areaNormal)));
  const Vec3 middle = positionAt(surface, centre);
  std::vector<Vec3> ring[kRings + 1];
  ring[0].assign(kSides, middle);
  for (int r = 1; r <= kRings; ++r)
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * kPi * i / kSides, away = double(radius) * r / kRings;
      const DVec3 way =
          away * (std::cos(angle) * DVec3(frame.tangent) + std::sin(angle) * DVec3(frame.bitangent));
      ring[r].push_back(positionAt(surface, walk(surface, centre, way)));
    }
  std::vector<Vec3> triangles;
  for (int r = 0; r < kRings; ++r)
    for (std::size_t i = 0; i < kSides; ++i) {
      const std::size_t next = (i + 1) % kSides;
      triangles.insert(triangles.end(), {ring[r][i], ring[r + 1][i], ring[r + 1][next]});
      if (r > 0) triangles.insert(triangles.end(), {ring[r][i], ring[r + 1][next], ring[r][next]});
    }
  return triangles;
}

Rgb colorOfPart(const Vec2& place) {
  const auto step = [](float x) { return 0.15f + 0.85f * std::round(4 * std::clamp(x, 0.0f, 1.0f)) / 4; };
  return {step(place.x), step(place.y), 0.3f};
}

}  // namespace prt::ui
