#pragma once
// Where a surface is seen from, as shaders take it.

#include "libprt/core/math.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/footprint.h"

namespace prt::gl {

/// Distances along the optical axis that hold the whole box; never nearer than a thousandth of it.
Vec2 depthRange(const Camera& camera, const Box3& box);

struct SurfaceView {
  Mat4 worldToClip{1};
  PixelSteps steps;
};

/// `shift`: where in its pixels the picture is taken, from the centre, in pixels right and up.
SurfaceView surfaceView(const Camera& camera, const Box3& bounds, int width, int height,
                        const Vec2& shift = Vec2(0));

/// What the driver can do of so many samples a pixel.
int supportedSamples(int wanted);

}  // namespace prt::gl
