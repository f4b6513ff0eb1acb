#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

float displayed(float radiance, float gain, ToneCurve curve) {
  const float x = radiance * gain;
  if (!(x > 0)) return 0;  // NaN included
  if (curve == ToneCurve::Linear || x > 1e4f) return encodeSrgb(std::min(x, 1.0f));
  return encodeSrgb(std::min(filmicCurve(x), 1.0f));
}

}  // namespace

float filmicCurve(float x) {
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

Rgb toDisplay(const Rgb& radiance, const ToneSettings& tone) {
  const float gain = std::exp2(tone.exposure);
  return {displayed(radiance.x, gain, tone.curve), displayed(radiance.y, gain, tone.curve),
          displayed(radiance.z, gain, tone.curve)};
}

Image toDisplay(const Image& radiance, const ToneSettings& tone) {
  const float gain = std::exp2(tone.exposure);
  const int colours = std::min(radiance.channels, 3);
  Image out(radiance.width, radiance.height, radiance.channels);
  for (std::size_t i = 0; i < radiance.data.size(); ++i) {
    const bool alpha = int(i % std::size_t(radiance.channels)) >= colours;
    const float v = radiance.data[i];
    out.data[i] = alpha ? (v > 0 ? std::min(v, 1.0f) : 0.0f) : displayed(v, gain, tone.curve);
  }
  return out;
}

}  // namespace prt
