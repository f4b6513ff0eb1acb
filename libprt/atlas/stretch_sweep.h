#pragma once
// Sweeps that lower Sander's L2 stretch vertex by vertex (Sander et al. 2001, section 3): what the seed
// metric of the paper still gains after a smoother energy has found the place.

#include "libprt/atlas/flat_chart.h"

namespace prt {

/// Moves each inner vertex, in order, down the gradient of the area-weighted squared L2 stretch of its
/// triangles, as far as it falls and turns none over. An injective map stays so. Throws Cancelled.
void sweepStretch(const FlatChart& chart, std::vector<DVec2>& uv, int sweeps, Job& job);

}  // namespace prt
