#pragma once
// A surface in many small compact patches, each a disk, whose rims keep to creases: what automatic cutting
// starts from.

#include "libprt/atlas/seams.h"

#include <vector>

namespace prt {

struct Clusters {
  std::vector<std::uint32_t> clusterOf;  ///< [F]
  std::uint32_t count = 0;
};

/// About `wanted` patches of similar size, at least one per component, by Lloyd's iteration over the dual
/// graph (Cohen-Steiner et al. 2004, with distances instead of planes): crossing an edge costs more the more
/// it bends, and the more a triangle turns from its patch's mean. Every patch is a disk whose rim meets
/// itself in no vertex. `bends` is bendAngles(). Deterministic; throws Cancelled.
Clusters makeClusters(const Surface& surface, std::span<const float> bends, std::size_t wanted, Job& job);

}  // namespace prt
