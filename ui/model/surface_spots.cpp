#include "ui/model/surface_spots.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr float kSpacing = 0.4f;  // of spots, relative to their radius: they are full up to half of it
constexpr int kSides = 24, kRings = 3;

}  // namespace

bool SpotTrail::add(const Vec3& place) {
  for (const Vec3& centre : centres_)
    if (distance(centre, place) < kSpacing * radius_) return false;
  centres_.push_back(place);
  return true;
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

Rgb colorOfLayer(int layer) {
  static const Rgb colors[] = {{0.95f, 0.55f, 0.15f}, {0.2f, 0.65f, 0.95f}, {0.85f, 0.35f, 0.75f}};
  return colors[std::size_t(std::max(layer, 0)) % std::size(colors)];
}

}  // namespace prt::ui
