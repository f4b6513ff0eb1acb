#pragma once
// Triangles over the same three vertices.

#include "libprt/core/job.h"
#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Which triangles to drop so that no two are left over the same vertices. Of several, the first stays.
/// Two back to back that stand out of a surface like a fin both go: without them, each of their edges has
/// the two triangles of the surface left. A sheet whose triangles are all doubled keeps one side.
std::vector<bool> duplicateTriangles(std::span<const UVec3> triangles, Job& job);

}  // namespace prt
