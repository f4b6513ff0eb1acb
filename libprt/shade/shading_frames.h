#pragma once
// The frames that light at the vertices is turned into before it meets the patch: one for every vertex and
// tangent there, as M_p = R_p T_p has it (Bi-Scale Radiance Transfer, 4.1). Most vertices have one; where
// texture coordinates break, or the direction field changes to another of its branches, they have several.

#include "libprt/basis/sh_turns.h"
#include "libprt/mesh/tangent_frames.h"

#include <cstdint>
#include <vector>

namespace prt {

struct ShadingFrames {
  std::vector<std::uint32_t> corner;  ///< [3F] the frame at each corner
  std::vector<std::uint32_t> vertex;  ///< [R] whose it is
  std::vector<Frame> frame;           ///< [R]
  std::vector<ShTurns<float>> turns;  ///< [R] from the object's frame into this one

  std::size_t size() const { return vertex.size(); }
};

ShadingFrames shadingFrames(const TriMesh& mesh, const TangentFrames& frames);

}  // namespace prt
