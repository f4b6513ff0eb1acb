#pragma once
// Some triangles of a mesh as a mesh of its own: what a patch is grown over when not all of a scene carries
// it.

#include "libprt/mesh/tangent_frames.h"

#include <cstdint>
#include <vector>

namespace prt {

struct MeshPart {
  TriMesh mesh;                         ///< vertices that its triangles use, in their order; no coordinates
  TangentFrames frames;                 ///< of its triangles
  std::vector<std::uint32_t> triangle;  ///< [F] number in the whole mesh, rising
};

/// `kept`: of each triangle of `mesh`.
MeshPart meshPart(const TriMesh& mesh, const TangentFrames& frames, const std::vector<bool>& kept);

}  // namespace prt
