#pragma once
// A grid on the plane y = 0 with the axes x (red) and z (blue), drawn over the background where nothing
// stands before it. Lines are one pixel wide and fade out where they would crowd; shaders/grid.glsl is the
// same in other words.

#include "libprt/core/math.h"
#include "libprt/shade/camera.h"

namespace prt {

/// Where the ray through a pixel meets the plane, and how that moves from pixel to pixel: everything is
/// linear in the pixel, the origin as well as the direction.
struct GridRays {
  Vec3 origin, originRight, originDown;
  Vec3 direction, directionRight, directionDown;

  GridRays(const Camera& camera, int width, int height);
};

/// A power of ten: lines this far apart suit a scene of this size; every tenth is stronger.
float gridSpacing(const Box3& bounds);

/// `over` (as the screen shows it) with the grid at image position (x, y). Rays of a pinhole begin at the
/// eye, parallel ones reach both ways.
Rgb withGrid(const GridRays& rays, bool parallel, float spacing, float x, float y, const Rgb& over);

}  // namespace prt
