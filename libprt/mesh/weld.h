#pragma once
// Vertices at exactly one position.

#include "libprt/core/job.h"
#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// For each vertex, the first vertex at exactly its position: itself where it is the first. Non-finite
/// vertices stand for themselves. Expected linear time; can be cancelled.
std::vector<std::uint32_t> weldByPosition(std::span<const DVec3> positions, Job& job);
std::vector<std::uint32_t> weldByPosition(std::span<const Vec3> positions, Job& job);

}  // namespace prt
