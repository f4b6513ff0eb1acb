#pragma once
// How a patch looks on the surface it was laid over: to judge a synthesis by eye. Each pixel looks up the id
// map and then the radiance transfer texture, nearest texels both (Bi-Scale Radiance Transfer, section 5).

#include "libprt/atlas/atlas.h"
#include "libprt/core/image.h"
#include "libprt/mesh/tangent_frames.h"
#include "libprt/meso/rtt.h"
#include "libprt/shade/camera.h"
#include "libprt/synthesis/id_map.h"

#include <span>

namespace prt {

struct PatchLook {
  const TriMesh& mesh;
  const TangentFrames& frames;
  const Atlas& atlas;
  const IdMap& map;
  /// Null: patch coordinates as colours, u in red and v in green, darker where the surface turns away.
  const Rtt* rtt = nullptr;
  /// Light in the object frame, for all vertices alike, or ..
  ShRgb light{1};
  /// .. [V, bands^2] at each vertex: transferred radiance, rtt->bands bands. Empty = not given.
  std::span<const Rgb> incident = {};
};

/// Float RGBA, premultiplied; grid x grid samples a pixel. Surfaces seen from behind are black. Same result
/// for any number of threads. Throws ValueError when sizes do not fit, Cancelled.
Image patchLook(const PatchLook& look, const Camera& camera, int width, int height, int grid, Job& job);

}  // namespace prt
