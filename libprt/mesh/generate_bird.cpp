#include "libprt/mesh/generate.h"
#include "libprt/mesh/generate_check.h"
#include "libprt/mesh/isosurface.h"

#include <algorithm>

namespace prt {
namespace {

/// Signed distance of an ellipsoid about the origin to first order: its equation over its gradient.
float ellipsoid(const Vec3& p, const Vec3& radii) {
  const float k = length(p / radii);
  const float slope = length(p / (radii * radii));
  return slope > 0 ? k * (k - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

/// Distance to the segment a-b, less a radius that goes from ra to rb along it.
float taperedCapsule(const Vec3& p, const Vec3& a, const Vec3& b, float ra, float rb) {
  const float t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0f, 1.0f);
  return length(p - a - t * (b - a)) - (ra + t * (rb - ra));
}

/// Union with a fillet of about the given radius.
float blend(float a, float b, float radius) {
  const float h = std::max(radius - std::abs(a - b), 0.0f);
  return std::min(a, b) - h * h / (4 * radius);
}

/// Intersection with a rounded edge.
float cut(float a, float b, float radius) {
  return -blend(-a, -b, radius);
}

Vec3 turnedAboutZ(const Vec3& p, float degreesUp) {
  const float angle = float(radians(degreesUp)), c = std::cos(angle), s = std::sin(angle);
  return {c * p.x + s * p.y, -s * p.x + c * p.y, p.z};
}

/// The bird in its own units: about 1.2 long, facing +X, its belly cut flat at y = 0.
float birdField(const Vec3& world) {
  const Vec3 p(world.x, world.y, std::sqrt(world.z * world.z + 1e-6f));  // both halves at once
  // Body and chest.
  float d = ellipsoid(turnedAboutZ(p - Vec3(-0.02f, 0.235f, 0), 17), {0.385f, 0.225f, 0.215f});
  d = blend(d, ellipsoid(p - Vec3(0.17f, 0.275f, 0), {0.215f, 0.235f, 0.205f}), 0.12f);
  // Neck, head, beak, eyes.
  d = blend(d, taperedCapsule(p, {0.20f, 0.38f, 0}, {0.325f, 0.60f, 0}, 0.150f, 0.095f), 0.10f);
  d = blend(d, ellipsoid(p - Vec3(0.345f, 0.625f, 0), {0.140f, 0.122f, 0.115f}), 0.07f);
  d = blend(d, taperedCapsule(p, {0.43f, 0.625f, 0}, {0.615f, 0.578f, 0}, 0.052f, 0.012f), 0.035f);
  d = blend(d, length(p - Vec3(0.400f, 0.655f, 0.092f)) - 0.029f, 0.012f);
  // Tail: a fan that widens backwards.
  const Vec3 tail = turnedAboutZ(p - Vec3(-0.32f, 0.24f, 0), -9);
  const float along = std::clamp(-tail.x / 0.46f, 0.0f, 1.0f);
  const float halfWidth = 0.075f + 0.065f * along;
  const float fan = ellipsoid(tail - Vec3(-0.20f, 0, 0), {0.303f, 0.036f, halfWidth - 0.01f}) - 0.01f;
  d = blend(d, fan, 0.06f);
  // Folded wings, set off from the body by a groove, their tips over the tail.
  Vec3 wing = turnedAboutZ(p - Vec3(-0.09f, 0.300f, 0.186f), 10);
  wing.z += 0.30f * wing.x * wing.x - 0.16f * wing.x;
  const float taper = 0.150f * (1 + 0.55f * std::clamp(wing.x / 0.36f, -1.0f, 1.0f));
  d = blend(d, ellipsoid(wing, {0.355f, taper - 0.01f, 0.042f}) - 0.01f, 0.035f);
  // A flat to sit on.
  return cut(d, 0.035f - p.y, 0.03f);
}

}  // namespace

TriMesh makeBird(const BirdOptions& options) {
  requireLength("length", options.length);
  requireRange("cellsAlong", options.cellsAlong, 64, 400);
  requireRange("relaxations", options.relaxations, 0, 200);
  const float cell = 1.45f / options.cellsAlong;
  const Box3 box{{-0.90f, -0.06f, -0.36f}, {0.72f, 0.84f, 0.36f}};
  TriMesh mesh = polygonise(birdField, box, cell);
  relaxOnSurface(mesh, birdField, cell, options.relaxations);

  const Box3 bounds = mesh.bounds();
  const float scale = options.length / (bounds.high.x - bounds.low.x);
  const Vec3 base(0.5f * (bounds.low.x + bounds.high.x), bounds.low.y, 0);
  for (Vec3& p : mesh.positions) p = scale * (p - base);
  return mesh;
}

}  // namespace prt
