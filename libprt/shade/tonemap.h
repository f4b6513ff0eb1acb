#pragma once
// From linear radiance to what a screen shows: exposure, tone curve, sRGB encoding.

#include "libprt/core/image.h"
#include "libprt/core/math.h"
#include "libprt/core/srgb.h"

namespace prt {

enum class ToneCurve {
  Linear,  ///< clips at 1
  Filmic   ///< soft shoulder and toe (Narkowicz 2015, "ACES Filmic Tone Mapping Curve")
};

struct ToneSettings {
  float exposure = 0;  ///< stops: radiance is multiplied by 2^exposure first
  ToneCurve curve = ToneCurve::Linear;
};

/// The rational curve of ToneCurve::Filmic for x >= 0; tends to 1.03, so clip afterwards.
float filmicCurve(float x);

/// One colour: 0..1, sRGB-encoded. Negative and non-finite input gives 0 (infinity gives 1).
Rgb toDisplay(const Rgb& radiance, const ToneSettings& tone);
/// Every pixel of an image with 1, 3 or 4 channels; alpha is kept, clamped to 0..1.
Image toDisplay(const Image& radiance, const ToneSettings& tone);

}  // namespace prt
