#pragma once
// Vertex normals from geometry.

#include "libprt/mesh/mesh.h"

#include <span>
#include <vector>

namespace prt {

/// Unit normal of each vertex: its triangles' normals, each weighted by its angle there (Thürmer and
/// Wüthrich 1998), which does not depend on how flat parts are cut into triangles. Vertices of no
/// triangle, or whose triangles cancel, get the normal of one of their triangles or else +Y.
std::vector<Vec3> angleWeightedNormals(std::span<const Vec3> positions, std::span<const UVec3> triangles);

}  // namespace prt
