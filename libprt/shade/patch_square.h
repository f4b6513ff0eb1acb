#pragma once
// A radiance transfer texture on a square that lies on the ground, repeated over it: the plainest picture of
// one
// ("the weave RTT is mapped to a simple square", Bi-Scale Radiance Transfer, figure 4). u runs along +X, v
// along -Z, the patch's outside is +Y.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/meso/rtt.h"
#include "libprt/shade/camera.h"

namespace prt {

/// Light in world coefficients as the patch on the ground sees it: in its own frame.
ShRgb lightOnGround(const ShRgb& world);
/// The same for a direction, and back.
Vec3 toGround(const Vec3& world);
Vec3 fromGround(const Vec3& patch);

struct SquareOptions {
  int repeats = 3;  ///< copies of the patch along each side of the unit square around the origin
  int width = 480, height = 360;
  int grid = 3;  ///< grid x grid samples per pixel
};

/// Linear RGBA, alpha = coverage. Spatially nearest texel, views interpolated, as the paper has it.
Image renderPatchSquare(const Rtt& rtt, const ShRgb& worldLight, const Camera& camera,
                        const SquareOptions& options, Job& job);

}  // namespace prt
