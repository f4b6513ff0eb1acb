#include "libprt/light/light_rig.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/core/warp.h"
#include "libprt/light/projection.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace prt {
namespace {

void require(bool good, const std::string& problem, const std::string& where, const std::string& fix) {
  if (!good) throw ValueError(problem, where, fix);
}

void requireColour(const Rgb& c, const std::string& where) {
  require(isFinite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0, "light must be finite and not negative", where,
          "give three numbers >= 0");
}

void requireUnit(const Vec3& d, const std::string& where) {
  require(isFinite(d) && std::abs(length(d) - 1) < 1e-4f, "direction is not of unit length", where,
          "give a normalised direction towards the light");
}

}  // namespace

void validate(const LightRig& rig) {
  require(std::isfinite(rig.rotation), "rotation is not finite", "environment", "give an angle");
  require(std::isfinite(rig.intensity) && rig.intensity >= 0, "intensity must be finite and not negative",
          "environment", "give a number >= 0");
  requireColour(rig.constant, "constant light");
  for (std::size_t i = 0; i < rig.circles.size(); ++i) {
    const std::string where = "circle light " + std::to_string(i);
    requireUnit(rig.circles[i].direction, where);
    requireColour(rig.circles[i].radiance, where);
    require(rig.circles[i].halfAngle > 0 && rig.circles[i].halfAngle <= kPiF, "half-angle is outside (0, pi]",
            where, "give a half-angle of up to 180 degrees");
  }
  for (std::size_t i = 0; i < rig.directionals.size(); ++i) {
    const std::string where = "directional light " + std::to_string(i);
    requireUnit(rig.directionals[i].direction, where);
    requireColour(rig.directionals[i].irradiance, where);
  }
}

Mat3 environmentRotation(float radians) {
  const float c = std::cos(radians), s = std::sin(radians);
  return {Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c)};
}

double solidAngle(const CircleLight& light) {
  return 2 * kPi * double(coneHeight(light.halfAngle));
}

bool contains(const CircleLight& light, const Vec3& d) {
  // 1 - cosine from the chord: the sun's radius leaves a float cosine only two or three digits of it.
  const Vec3 chord = d - light.direction;
  return 0.5f * dot(chord, chord) <= coneHeight(light.halfAngle);
}

Rgb radiance(const LightRig& rig, const Vec3& d) {
  return radiance(rig, transpose(environmentRotation(rig.rotation)), d);
}

Rgb radiance(const LightRig& rig, const Mat3& toMap, const Vec3& d) {
  Rgb sum = rig.constant;
  if (rig.environment) sum += rig.intensity * rig.environment->radiance(toMap * d);
  for (const CircleLight& light : rig.circles)
    if (contains(light, d)) sum += light.radiance;
  return sum;
}

ShRgb projectLights(const LightRig& rig, int bands) {
  return projectLights(rig, rig.environment ? projectEnvironment(*rig.environment, bands) : ShRgb(bands));
}

ShRgb projectLights(const LightRig& rig, const ShRgb& environment) {
  validate(rig);
  const int bands = environment.bands;
  ShRgb sum(bands);
  const auto add = [&](std::span<const double> function, const Rgb& colour) {
    for (std::size_t k = 0; k < sum.c.size(); ++k) sum.c[k] += float(function[k]) * colour;
  };
  if (rig.environment) {
    sum = ShRotation(bands, environmentRotation(rig.rotation)).apply(environment);
    for (Rgb& c : sum.c) c *= rig.intensity;
  }
  for (const CircleLight& light : rig.circles)
    add(rotateZonal(capZonal(bands, std::min(double(light.halfAngle), kPi)),
                    normalize(DVec3(light.direction))),
        light.radiance);
  std::vector<double> y(sum.c.size());
  for (const DirectionalLight& light : rig.directionals) {
    shEvaluate(bands, normalize(DVec3(light.direction)), y);
    add(y, light.irradiance);
  }
  sum.c[0] += rig.constant * float(std::sqrt(4 * kPi));
  return sum;
}

}  // namespace prt
