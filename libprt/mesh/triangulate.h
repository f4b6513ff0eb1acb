#pragma once
// Simple polygons cut into triangles.

#include "libprt/core/job.h"
#include "libprt/core/math.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Cuts a polygon in space into n - 2 triangles of its corner numbers by clipping ears (Meisters 1975) in
/// the plane of its area vector; corners of a polygon that bends out of the plane stay where they are.
/// Concave polygons, and those that touch themselves along a bridge to a hole, are cut properly; one that
/// crosses itself gets some triangulation over its corners. Near linear for polygons that people draw; the
/// work is bounded for any other, after which the rest is cut as a fan.
std::vector<std::array<std::uint32_t, 3>> triangulatePolygon(std::span<const DVec3> corners, Job& job);

}  // namespace prt
