#pragma once
// The sky behind the scene for LiveRenderer.

#include "libprt/core/math.h"
#include "libprt/light/environment.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/camera.h"

#include <span>

namespace prt {

/// What is seen of a sky.
struct LiveSky {
  const EnvironmentMap* map = nullptr;  ///< lat-long; null: none
  float rotation = 0, intensity = 1;    ///< of the map, as in LightRig
  std::span<const CircleLight> circles = {};
  Rgb constant{0};
};

/// A sky seen by a camera: the map smooth between texels, circle lights with edges a pixel wide. Directional
/// lights have no size and are not seen.
class LiveBackground {
 public:
  /// Keeps references to the map and the circles.
  LiveBackground(const LiveSky& sky, const Camera& camera, int width, int height);

  /// Radiance at the centres of pixels x .. x + out.size() - 1 of row y.
  void row(int x, int y, std::span<Rgb> out) const;

 private:
  Rgb texel(float u, float v) const;

  LiveSky sky_;
  CameraRays rays_;
  float turns_;
};

}  // namespace prt
