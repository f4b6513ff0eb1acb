#pragma once
// Which place of the patch a surface shows where, as colours: to judge a synthesis by eye. The patch itself,
// lit, is what biscale.h draws.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/patch_cover.h"

namespace prt {

/// Patch coordinates, u in red and v in green, darker where the surface turns away. Float RGBA,
/// premultiplied; grid x grid samples a pixel. Black where seen from behind and where the cover is empty.
/// Same result for any number of threads. Throws Cancelled.
Image patchColours(const TriMesh& mesh, const PatchCover& cover, const Camera& camera, int width, int height,
                   int grid, Job& job);

}  // namespace prt
