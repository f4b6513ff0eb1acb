#pragma once
// How often closed surfaces wind around a point.

#include "libprt/core/math.h"

namespace prt {

/// Signed solid angle of a triangle seen from a point (van Oosterom and Strackee 1983), positive when the
/// triangle shows its back, so that a closed outward surface around the point sums to 4 pi.
inline double signedSolidAngle(const DVec3& point, const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 x = a - point, y = b - point, z = c - point;
  const double lx = length(x), ly = length(y), lz = length(z);
  const double volume = dot(x, cross(y, z));
  const double spread = lx * ly * lz + dot(x, y) * lz + dot(y, z) * lx + dot(z, x) * ly;
  return 2 * std::atan2(volume, spread);
}

}  // namespace prt
