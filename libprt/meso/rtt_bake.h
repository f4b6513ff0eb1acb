#pragma once
// The fast bake of a radiance transfer texture: light on the patch's surface once (patch_transfer.h), then
// every view is a picture of one first-hit ray cast, B(u, v) = albedo/pi e(hit) averaged over the texel,
// which lies on the plane midway in depth. Source: ALGORITHMS 6.3; the literal equation (5) is in
// btf_render.h.
//
// Glossy patches add a Phong lobe towards the viewer: for every hit, `lobeRays` directions drawn in
// proportion to f cos; open ones bring the basis functions themselves, blocked ones the diffuse light that
// leaves where they end. No function is cut off in between, so the lobe may be as sharp as it likes; what is
// left is the noise of the directions, which falls as their number (times the samples of a texel) grows.
// Light that was reflected by a lobe before counts as diffuse only.

#include "libprt/meso/patch_transfer.h"
#include "libprt/meso/rtt.h"

#include <functional>
#include <span>
#include <vector>

namespace prt {

struct RttSettings {
  int texels = 64;  ///< a side
  int views = 8;    ///< a side
  int bands = 5;
  int rays = 1024;       ///< per vertex of the surface
  int bounces = 2;       ///< inside the patch
  int supersamples = 4;  ///< a side per texel: 4 = 16 rays per texel and view; 1..16
  int lobeRays = 16;     ///< per hit of a glossy patch, 1..1024
  float stopThreshold = 0;
  std::uint64_t seed = 1;
  std::size_t hitMemory = std::size_t{1} << 30;

  PatchTransferSettings transfer() const { return {bands, rays, bounces, stopThreshold, seed, hitMemory}; }
};

/// What previews get: the table so far. The first comes soon and is whole but coarse (few rays, one sample
/// per texel); then one after each finished view of the final pass, in the order of their indices.
struct RttPreview {
  const Rtt& rtt;  ///< valid during the call only
  int viewsDone = 0;
  int viewsWanted = 0;
  bool coarse = false;
};

/// Bakes; the phases of the job count rays, then images. `preview` is called between parallel loops on the
/// thread of the caller and must be quick. Throws ValueError for settings out of range, Cancelled within
/// milliseconds. The result depends on patch and settings only, not on threads.
Rtt bakeRtt(const PatchScene& patch, const RttSettings& settings, Job& job,
            const std::function<void(const RttPreview&)>& preview = {});

/// The first part alone: light (of basis functions) on the patch's surface. The one preview is coarse.
PatchLight bakePatchLight(const PatchScene& patch, const RttSettings& settings, Job& job,
                          const std::function<void(const RttPreview&)>& preview = {});

/// The last part alone: pictures of a patch on whose surface the light is known (of basis functions).
Rtt viewsOfPatch(const PatchScene& patch, const PatchLight& light, const RttSettings& settings, Job& job,
                 const std::function<void(const RttPreview&)>& preview = {});

/// The same pictures along other views: a table whose first "views" are along `directions`, at most 1024, in
/// this order (it has as many cells as a square needs; its own lookups between views mean nothing). Rows of
/// texels that `everyRow` does not divide stay zero.
Rtt picturesOfPatch(const PatchScene& patch, const PatchLight& light, const RttSettings& settings,
                    std::span<const Vec3> directions, int everyRow, Job& job,
                    const std::function<void(const RttPreview&)>& preview = {});

/// Where the samples of every texel lie, relative to the texel: [supersamples^2] in [0,1)^2, stratified.
std::vector<Vec2> texelSamples(int supersamples, std::uint64_t seed);

}  // namespace prt
