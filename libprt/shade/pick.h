#pragma once
// What stands under a place of the picture.

#include "libprt/core/math.h"
#include "libprt/shade/camera.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <optional>

namespace prt {

/// A point of the surface. Its corners' weights are (1 - x - y, x, y).
struct SurfaceHit {
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;  ///< of the scene
  Vec2 barycentric{0};
  Vec3 position{0};
  bool back = false;  ///< seen from behind
};

/// The nearest surface along the ray through image position (x, y) in pixels of a width x height image;
/// nothing where the background shows. Tries every triangle, in parallel: a few milliseconds for a million of
/// them, and nothing to build before.
std::optional<SurfaceHit> pickSurface(const Scene& scene, const Camera& camera, float x, float y, int width,
                                      int height);

}  // namespace prt
