#pragma once
// What a patch looks like as a thing: a picture of a few periods of it in perspective, for people who choose
// its shape. One sun with its shadows and a plain sky; no light transport.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/meso/patch_scene.h"

namespace prt {

/// Where from. Angles in radians, about the middle of what is shown; u points right at azimuth 0.
struct PatchView {
  float azimuth = 0.6f;
  float elevation = 0.7f;  ///< above the plane of the patch, -pi/2 .. pi/2
  float zoom = 1;          ///< 1: everything fits; larger is closer, 0.1 .. 10
  int periods = 1;         ///< a side, 1..3
  int samples = 2;         ///< a side of every pixel, 1..8
};

/// `width` x `height` pixels, RGBA, linear, alpha = coverage. Cut sides of solid patches are dark. Throws
/// ValueError for sizes and views out of range, Cancelled. The same for any number of threads.
Image patchPicture(const PatchScene& patch, const PatchView& view, int width, int height, Job& job);

}  // namespace prt
