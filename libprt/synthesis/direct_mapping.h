#pragma once
// Patches laid by a mesh's own texture coordinates, repeated: no synthesis and no id map (Bi-Scale Radiance
// Transfer, section 5: "surfaces defined parametrically already have a mapping").

#include "libprt/core/math.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>

namespace prt {

/// Patches along u and along v over the unit square of texture coordinates.
struct PatchRepeat {
  int u = 1, v = 1;
};

/// `along` patches along u, and along v the whole number that makes them nearest to square in the mean over
/// the surface. Throws ValueError when the mesh has no texture coordinates or `along` is not 1..4096.
PatchRepeat squareRepeat(const TriMesh& mesh, int along);

/// Patch coordinates, in [0, 1)^2, of a point of a triangle.
Vec2 directPatchCoordinates(const TriMesh& mesh, const PatchRepeat& repeat, std::uint32_t triangle,
                            const Vec2& barycentric);

}  // namespace prt
