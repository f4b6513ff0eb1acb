#pragma once
// The last step of a repair: from triangles over the soup's corners to an indexed mesh.

#include "libprt/core/job.h"
#include "libprt/mesh/soup.h"

namespace prt {

struct AssemblyInput {
  const PolygonSoup& soup;
  std::span<const Vec3> positions;      ///< [P] the soup's first, then copies made by splitting
  std::span<const UVec3> triangles;     ///< [F] into positions
  std::span<const UVec3> corners;       ///< [F] the soup's corners they stem from
  std::span<const Vec3> cornerNormals;  ///< [3F] unit
  bool keepLoneVertices;                ///< finite vertices of no face stay, with normal +Y
};

struct Assembly {
  /// One vertex for each position and normal, in the order of the soup's vertices that they stem from.
  TriMesh mesh;
  std::vector<std::uint32_t>
      representative;               ///< [V] the first vertex of the mesh at the same entry of positions
  std::size_t weldedVertices = 0;   ///< fewer than the soup's vertices that triangles use
  std::size_t removedVertices = 0;  ///< the soup's that no triangle uses
  std::size_t creaseVertices = 0;   ///< beyond one for each position
  std::size_t filledUvs = 0;        ///< corners without usable texture coordinates, now (0, 0)
};

/// Linear time. Throws Cancelled.
Assembly assemble(const AssemblyInput& input, Job& job);

}  // namespace prt
