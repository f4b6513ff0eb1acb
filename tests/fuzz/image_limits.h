#pragma once
// The largest images that harnesses read.

#include "libprt/core/image_io.h"

namespace prt::fuzz {

inline constexpr ImageLimits kImageLimits{.maxSide = 4096, .maxChannels = 64, .maxBytes = 16 << 20};

}  // namespace prt::fuzz
