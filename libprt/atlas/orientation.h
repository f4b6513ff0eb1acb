#pragma once
// Which way a flat triangle turns, without rounding errors.

#include "libprt/atlas/surface.h"

namespace prt {

/// 1 for a counter-clockwise triangle, -1 for a clockwise one, 0 for one without area: exact for any finite
/// floats (products of floats are exact in double; where their sum might round to the wrong side it is made
/// exactly, Shewchuk 1997).
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Twice the signed area in plain double.
inline double signedArea2(const DVec2& a, const DVec2& b, const DVec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether a triangle is counter-clockwise beyond the doubt that rounding leaves.
inline bool surelyPositive(const DVec2& a, const DVec2& b, const DVec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  return left - right > 4.5e-16 * (std::abs(left) + std::abs(right));
}

}  // namespace prt
