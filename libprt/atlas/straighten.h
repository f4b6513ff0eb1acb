#pragma once
// Seams drawn tight: each stretch of cut between two places where cuts meet becomes the cheapest way between
// them, as long as the charts on its sides stay disks.

#include "libprt/atlas/charts.h"

namespace prt {

/// `costs` is [E]: seamCosts(). Deterministic, serial; throws Cancelled.
void straightenSeams(const Surface& surface, std::span<const float> costs, Seams& seams, Job& job);

}  // namespace prt
