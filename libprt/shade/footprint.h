#pragma once
// What a pixel covers of a texture: its footprint, as an ellipse with a short and a long axis. Shaders have
// the same in shaders/footprint.glsl.

#include "libprt/core/math.h"
#include "libprt/shade/camera.h"

#include <algorithm>
#include <cmath>

namespace prt {

/// How a pixel's ray moves from pixel to pixel.
struct PixelSteps {
  Vec3 forward{0, 0, -1};   ///< along the optical axis
  Vec3 right{0}, down{0};   ///< of the place that is seen: for a pinhole at distance 1 along the axis
  Vec4 viewer{0, 0, 1, 0};  ///< where, w = 1; or in which direction, w = 0

  PixelSteps() = default;
  PixelSteps(const Camera& camera, int width, int height);
};

/// How a place on the plane of a triangle moves from pixel to pixel, in world units.
struct PlaneSteps {
  Vec3 right{0}, down{0};
};
/// `p` on the plane of edges e1, e2. Finite wherever the plane is not degenerate.
PlaneSteps planeSteps(const PixelSteps& steps, const Vec3& p, const Vec3& e1, const Vec3& e2);

/// How a step moves the weights of corners 1 and 2.
Vec2 weightStep(const Vec3& step, const Vec3& e1, const Vec3& e2);

/// Samples along the long axis, each a square of the size of the short one.
struct Footprint {
  static constexpr int kMostTaps = 8;
  int taps = 1;
  float width = 0;  ///< of a sample, in texels
  Vec2 step{0};     ///< from sample to sample; they lie evenly around the middle
};
/// From how a place in the texture, in texels, moves from pixel to pixel.
Footprint footprintOf(const Vec2& right, const Vec2& down);

}  // namespace prt
