#pragma once
// What a coarse layout leaves between charts, texel by texel. Internal to packing.

#include "libprt/atlas/pack_layout.h"

#include <memory>

namespace prt {

/// Slides the charts of a layout down and to the left on a grid of `cells` until they touch, and grows all of
/// them by what that leaves at the far sides, some times over. `places` are of the layout's charts, in the
/// square; none may be locked. Never smaller than before. Deterministic, serial; throws Cancelled.
std::vector<ChartPlacement> compactLayout(const PackTask& task, std::vector<ChartPlacement> places, int cells,
                                          Job& job);

}  // namespace prt
