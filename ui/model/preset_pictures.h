#pragma once
// Small pictures of the material presets: a sphere under the built-in studio light, shaded as the viewport
// does.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/material/material.h"

#include <vector>

namespace prt::ui {

/// A sphere of each material, encoded for the screen: four channels, the last one coverage. `pixels` a side.
std::vector<Image> materialPictures(const std::vector<Material>& materials, int pixels, Job& job);

}  // namespace prt::ui
