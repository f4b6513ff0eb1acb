#pragma once
// The light behind a picture.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/camera.h"

namespace prt {

/// Fills what a float RGBA picture, premultiplied, leaves open with the light from there, and sets alpha to
/// 1: the mean over grid x grid samples of each pixel. No pixel becomes NaN or negative. Throws Cancelled.
void addBackground(const LightRig& rig, const Camera& camera, int grid, Image& image, Job& job);

}  // namespace prt
