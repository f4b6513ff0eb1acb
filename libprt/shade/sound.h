#pragma once
// What a picture may hold.

#include "libprt/core/math.h"

#include <algorithm>

namespace prt {

/// Radiance clamped to 0 .. 3e38; NaN gives 0.
inline float sound(float radiance) {
  return radiance > 0 ? std::min(radiance, 3e38f) : 0.0f;
}
inline Rgb sound(const Rgb& radiance) {
  return {sound(radiance.x), sound(radiance.y), sound(radiance.z)};
}

}  // namespace prt
