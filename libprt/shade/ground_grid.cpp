#include "libprt/shade/ground_grid.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

// As shaders/grid.glsl has them.
constexpr float kMinor = 0.25f, kMajor = 0.5f, kAxis = 0.8f;
const Rgb kLine(0.55f), kAxisX(0.85f, 0.37f, 0.37f), kAxisZ(0.37f, 0.56f, 0.85f);

float near(float distance, float footprint) {
  return std::clamp(1 - distance / footprint, 0.0f, 1.0f);
}

/// How much a line of this spacing covers at coordinate p.
float line(float p, float footprint, float spacing) {
  const float distance = std::abs(p - spacing * std::round(p / spacing));
  return near(distance, footprint) * std::clamp(1.5f - 5 * footprint / spacing, 0.0f, 1.0f);
}

Rgb mixed(const Rgb& a, const Rgb& b, float share) {
  return (1 - share) * a + share * b;
}

}  // namespace

GridRays::GridRays(const Camera& camera, int width, int height) {
  const CameraRays rays(camera, width, height);
  origin = rays.origin(0, 0), direction = rays.through(0, 0);
  // Far apart, so that rounding does not matter.
  const float w = float(width), h = float(height);
  originRight = (rays.origin(w, 0) - origin) / w, originDown = (rays.origin(0, h) - origin) / h;
  directionRight = (rays.through(w, 0) - direction) / w, directionDown = (rays.through(0, h) - direction) / h;
}

float gridSpacing(const Box3& bounds) {
  const float size = bounds.diagonal();
  return size > 0 ? std::pow(10.0f, std::floor(std::log10(0.5f * size))) : 1.0f;
}

Rgb withGrid(const GridRays& rays, bool parallel, float spacing, float x, float y, const Rgb& over) {
  const Vec3 o = rays.origin + x * rays.originRight + y * rays.originDown;
  const Vec3 d = rays.direction + x * rays.directionRight + y * rays.directionDown;
  const float t = -o.y / d.y;
  if (!(parallel || t > 0) || !(std::abs(t) < 1e18f)) return over;
  const auto moved = [&](const Vec3& origin, const Vec3& direction) {
    return origin + t * direction - (origin.y + t * direction.y) / d.y * d;
  };
  const Vec3 p = o + t * d, right = moved(rays.originRight, rays.directionRight),
             down = moved(rays.originDown, rays.directionDown);
  const float wx = std::abs(right.x) + std::abs(down.x), wz = std::abs(right.z) + std::abs(down.z);
  if (!(wx > 0 && wz > 0)) return over;
  const float minor = std::max(line(p.x, wx, spacing), line(p.z, wz, spacing));
  const float major = std::max(line(p.x, wx, 10 * spacing), line(p.z, wz, 10 * spacing));
  const float fade = std::clamp(1.5f - 0.5f * std::max(wx, wz) / spacing, 0.0f, 1.0f);
  Rgb colour = mixed(over, kLine, std::max(kMinor * minor, kMajor * major));
  colour = mixed(colour, kAxisX, kAxis * fade * near(std::abs(p.z), wz));
  return mixed(colour, kAxisZ, kAxis * fade * near(std::abs(p.x), wx));
}

}  // namespace prt
