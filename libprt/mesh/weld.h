#pragma once
// Vertices at exactly one position.

#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// For each vertex, the first vertex at exactly its position: itself where it is the first. Non-finite
/// vertices stand for themselves. Expected linear time.
std::vector<std::uint32_t> weldByPosition(std::span<const DVec3> positions);
std::vector<std::uint32_t> weldByPosition(std::span<const Vec3> positions);

}  // namespace prt
