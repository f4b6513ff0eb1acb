#include "libprt/light/light_rig.h"

#include "libprt/core/error.h"

#include <cmath>
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
    require(rig.circles[i].halfAngle > 0 && rig.circles[i].halfAngle <= kPiF, "half-angle is outside (0, pi]", where,
            "give a half-angle of up to 180 degrees");
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

double capSolidAngle(double halfAngle) {
  const double s = std::sin(0.5 * halfAngle);
  return 4 * kPi * s * s;
}

bool contains(const CircleLight& light, const Vec3& d) {
  // Chords instead of cosines: 1 - cos of the sun's radius has only two or three digits in float.
  const Vec3 chord = d - light.direction;
  const float reach = 2 * std::sin(0.5f * light.halfAngle);
  return dot(chord, chord) <= reach * reach;
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

}  // namespace prt
