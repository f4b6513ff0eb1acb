#pragma once
// An environment map as a small picture for the screen.

#include "libprt/core/image.h"
#include "libprt/light/environment.h"

namespace prt::ui {

/// A lat-long picture, three channels encoded for the screen, exposed so that the mean of the map is a middle
/// grey: a sun counts by its share of the mean only.
Image probePicture(const EnvironmentMap& map, int width, int height);

}  // namespace prt::ui
