#pragma once
// Directions as two angles: azimuth about +Y, counter-clockwise seen from above, 0 towards -Z; elevation
// above the horizon. What people type and drag; everything else uses unit vectors.

#include "libprt/core/math.h"

#include <algorithm>
#include <cmath>

namespace prt {

/// Radians.
struct SkyAngles {
  double azimuth = 0;    ///< -pi .. pi where it comes from a direction
  double elevation = 0;  ///< -pi/2 .. pi/2
};

/// The unit vector.
inline Vec3 directionOf(const SkyAngles& a) {
  return Vec3(-std::sin(a.azimuth) * std::cos(a.elevation), std::sin(a.elevation),
              -std::cos(a.azimuth) * std::cos(a.elevation));
}

/// The reverse, for a unit vector. Straight up and down have azimuth 0.
inline SkyAngles anglesOf(const Vec3& direction) {
  const DVec3 d(direction);
  const double level = std::hypot(d.x, d.z);
  return {level > 0 ? std::atan2(-d.x, -d.z) : 0, std::atan2(d.y, level)};
}

}  // namespace prt
