#pragma once
// The same picture drawn by OpenGL, without a window.

#include "libprt/project/relight.h"

namespace prt::cli {

/// Throws as relight() does, and ResourceError when the machine has no OpenGL 4.5.
Image relightGl(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, const Camera& camera,
                const PictureOptions& options, Job& job);

}  // namespace prt::cli
