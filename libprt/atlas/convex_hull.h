#pragma once
// The least convex polygon around points.

#include "libprt/atlas/surface.h"

#include <vector>

namespace prt {

/// Corners counter-clockwise, each once; fewer than three where the points have no area.
std::vector<DVec2> convexHull(std::vector<DVec2> points);
/// Of a polygon; negative when it runs clockwise.
double polygonArea(const std::vector<DVec2>& polygon);

}  // namespace prt
