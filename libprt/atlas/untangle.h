#pragma once
// Triangles that a quick flat map turned over, turned back: around each the map is relaxed towards means of
// neighbours, which cannot fold inside of a convex ring, over wider and wider rings.

#include "libprt/atlas/flat_chart.h"

namespace prt {

/// Where the boundary crosses itself a little, both sides are drawn inwards too. True when the map is
/// injective then: what overlaps by more than a few rings is beyond it. Deterministic; throws Cancelled.
bool untangle(const FlatChart& chart, std::vector<DVec2>& uv, Job& job);

}  // namespace prt
