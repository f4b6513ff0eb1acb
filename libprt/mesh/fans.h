#pragma once
// A surface taken apart where it is not a manifold.

#include "libprt/core/job.h"
#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

struct FanSplit {
  std::vector<UVec3> triangles;  ///< [F] the same triangles over the new vertices
  std::vector<std::uint32_t>
      source;  ///< [W] old vertex of each new one; the first V are the old ones themselves
};

/// Gives every fan of triangles around a vertex its own vertex. Fans are parted by edges of more or fewer
/// than two triangles and by edges along which two triangles run in the same direction, so that what comes
/// out is an oriented manifold with boundary. Near linear; can be cancelled.
FanSplit splitIntoFans(std::span<const UVec3> triangles, std::size_t vertexCount, Job& job);

}  // namespace prt
