#pragma once
// All light that reaches the scene, all of it from infinitely far away: an environment map that can be
// turned, discs of light in the sky, directional lights and a constant. A plain value; environment maps are
// shared.

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"
#include "libprt/light/environment.h"

#include <memory>
#include <vector>

namespace prt {

/// A disc of constant radiance. The papers' "110 degree light" has a half-angle of 55 degrees.
struct CircleLight {
  Vec3 direction{0, 1, 0};  ///< unit, towards the light
  float halfAngle = 0.5f;   ///< radians, 0 < a <= pi
  Rgb radiance{1};
  bool operator==(const CircleLight&) const = default;
};

/// Parallel light: a point on the sky, zero solid angle.
struct DirectionalLight {
  Vec3 direction{0, 1, 0};  ///< unit, towards the light
  Rgb irradiance{1};        ///< on a surface that faces the light
  bool operator==(const DirectionalLight&) const = default;
};

struct LightRig {
  std::shared_ptr<const EnvironmentMap> environment;  ///< may be absent
  float rotation =
      0;  ///< of the environment about +Y, radians; positive is counter-clockwise seen from above
  float intensity = 1;  ///< multiplies the environment, >= 0
  std::vector<CircleLight> circles;
  std::vector<DirectionalLight> directionals;
  Rgb constant{0};  ///< radiance from everywhere
};

/// Throws ValueError, naming the light, when a direction is not of unit length, a half-angle is outside (0,
/// pi], a colour or the intensity is negative, or anything is not finite.
void validate(const LightRig& rig);

/// The rotation that an environment angle stands for: world = environmentRotation(angle) * map direction.
/// What came from -Z comes from -X after +90 degrees.
Mat3 environmentRotation(float radians);

/// Radiance arriving from unit direction `d`. Directional lights are not in it: they have no radiance.
Rgb radiance(const LightRig& rig, const Vec3& d);
/// The same for many lookups: toMap = transpose(environmentRotation(rig.rotation)), made once.
Rgb radiance(const LightRig& rig, const Mat3& toMap, const Vec3& d);

/// Solid angle of the light's disc, accurate for tiny ones.
double solidAngle(const CircleLight& light);
/// Whether unit direction `d` lies in the light's disc, accurate for tiny ones.
bool contains(const CircleLight& light, const Vec3& d);

/// SH coefficients of all the light, directional lights included (E * y(d)). Projects the environment
/// anew; keep projectEnvironment's result and use the second form when only rotation, intensity or the
/// other lights change (about a microsecond).
ShRgb projectLights(const LightRig& rig, int bands);
/// `environment` = projectEnvironment(*rig.environment, bands): not turned, intensity 1. Its bands are
/// the result's; without an environment pass ShRgb(bands).
ShRgb projectLights(const LightRig& rig, const ShRgb& environment);

}  // namespace prt
