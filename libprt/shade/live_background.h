#pragma once
// The environment behind the scene for LiveRenderer.

#include "libprt/core/math.h"
#include "libprt/light/environment.h"
#include "libprt/shade/camera.h"

#include <span>

namespace prt {

/// A lat-long map seen by a camera, smooth between texels.
class LiveBackground {
 public:
  /// Keeps a reference to `map`, whose mapping must be lat-long.
  LiveBackground(const EnvironmentMap& map, float rotation, float intensity, const Camera& camera, int width,
                 int height);

  /// Radiance at the centres of pixels x .. x + out.size() - 1 of row y.
  void row(int x, int y, std::span<Rgb> out) const;

 private:
  Rgb texel(float u, float v) const;

  const Image& pixels_;
  CameraRays rays_;
  float turns_, intensity_;
};

}  // namespace prt
