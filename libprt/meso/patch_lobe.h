#pragma once
// The Phong lobe of a glossy patch towards the viewer. Internal to meso.

#include "libprt/meso/patch_transfer.h"

#include <vector>

namespace prt {

/// Memory of one thread.
struct LobeScratch {
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<Rgb> weights;
  std::vector<float> row, functions;
};

/// sum += response of the lobe at a hit towards `view` (unit), by `rays` directions drawn with `seed`:
/// `light` is that of the basis functions. `sum` holds lights * channels numbers, 1 or 3 channels.
void addLobe(const PatchScene& patch, const PatchLight& light, int bands, const Hit& hit, const Vec3& view,
             int rays, std::uint64_t seed, int channels, LobeScratch& scratch, float* sum);

/// The same for directional lights of irradiance 1: only what comes to the lobe from elsewhere on the patch
/// (`light` has their direct light at the vertices); the lobe's own view of the lights is evalLobe().
void addLobeOfPatch(const PatchScene& patch, const PatchLight& light, const Hit& hit, const Vec3& view,
                    int rays, std::uint64_t seed, int channels, LobeScratch& scratch, float* sum);

/// f of the lobe alone at a hit for light from `in`.
Rgb evalLobe(const Patch& patch, const Hit& hit, const Vec3& in, const Vec3& view);

/// Shading normal at a hit.
Vec3 normalAt(const Patch& patch, const Hit& hit);

/// The point of a hit, moved off the surface.
Vec3 originAt(const Patch& patch, const Hit& hit);

}  // namespace prt
