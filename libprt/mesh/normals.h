#pragma once
// Shading normals: from geometry, or a file's where they make sense.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <span>
#include <vector>

namespace prt {

/// Unit normal of each vertex: its triangles' normals, each weighted by its angle there (Thürmer and
/// Wüthrich 1998), which does not depend on how flat parts are cut into triangles. Vertices whose
/// triangles cancel get the normal of one of them, vertices of no triangle +Y.
std::vector<Vec3> angleWeightedNormals(std::span<const Vec3> positions, std::span<const UVec3> triangles);

struct CornerNormalInput {
  std::span<const Vec3> positions;
  std::span<const UVec3> triangles;
  /// [3F] normals to keep where they are usable; empty = compute all.
  std::span<const Vec3> fromFile;
  /// Computed normals break at edges whose triangles meet at more than this angle, in radians.
  float creaseAngle = kPiF;
};

struct CornerNormals {
  std::vector<Vec3> normals;  ///< [3F] unit; corners that share a normal hold exactly the same numbers
  std::size_t kept = 0;       ///< corners whose normal came from the file
};

/// A file's normal is kept when it is finite, not zero, and within 90 degrees of the angle-weighted normal
/// of all corners at its vertex that share it; it is normalised. The other corners get the angle-weighted
/// normal of their fan: of all other corners at their vertex, or of those reached across edges that are no
/// crease. Near linear; can be cancelled.
CornerNormals cornerNormals(const CornerNormalInput& input, Job& job);

}  // namespace prt
