#pragma once
// Winding made consistent.

#include "libprt/core/job.h"
#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

struct OrientationInput {
  std::span<const Vec3> positions;
  std::span<const UVec3> triangles;
  /// [F] what the file's normals say: positive when they agree with the winding, negative when they are
  /// against it, 0 when there are none. Empty = none at all.
  std::span<const float> normalVotes;
  bool outward = true;  ///< turn closed surfaces outwards; walls of cavities stay as they are
};

/// Which triangles to turn over so that any two that meet in an edge of two run along it in opposite
/// directions. Each connected surface keeps the winding that its normals, or else most of its area, had.
/// A surface that cannot be oriented (a Möbius band) keeps edges with agreeing directions. Linear time.
std::vector<bool> trianglesToFlip(const OrientationInput& input, Job& job);

}  // namespace prt
