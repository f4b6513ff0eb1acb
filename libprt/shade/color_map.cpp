#include "libprt/shade/color_map.h"

#include "libprt/core/srgb.h"

#include <algorithm>
#include <array>

namespace prt {
namespace {

constexpr int kColors = 256;
constexpr double kLightest = 0.93, kDarkest = 0.29;  // OkLab lightness of the ends
constexpr double kFirstHue = 318, kLastHue = 105;    // degrees: violet, yellow
// Colourful at the ends, less between, where blue and green hold less at these lightnesses: all of it can be
// shown as it is, so that no colour is cut off.
constexpr double kChromaOfEnds = 0.14, kChromaBetween = 0.08;

/// Linear Rec.709 from OkLab in polar form.
DVec3 fromOkLab(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(radians(hue)), b = chroma * std::sin(radians(hue));
  const auto cubed = [](double x) { return x * x * x; };
  const double l = cubed(lightness + 0.3963377774 * a + 0.2158037573 * b),
               m = cubed(lightness - 0.1055613458 * a - 0.0638541728 * b),
               s = cubed(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Rgb colorAt(double t) {
  const double lightness = kDarkest + (kLightest - kDarkest) * t,
               hue = kFirstHue + (kLastHue - kFirstHue) * t;
  const double end = std::cos(kPi * t) * std::cos(kPi * t);
  const double chroma = kChromaBetween + (kChromaOfEnds - kChromaBetween) * end;
  const DVec3 linear = fromOkLab(lightness, chroma, hue);
  return {encodeSrgb(float(linear.x)), encodeSrgb(float(linear.y)), encodeSrgb(float(linear.z))};
}

}  // namespace

std::span<const Rgb> magnitudeColors() {
  static const std::array<Rgb, kColors> colors = [] {
    std::array<Rgb, kColors> all;
    for (int i = 0; i < kColors; ++i) all[std::size_t(i)] = colorAt(double(i) / (kColors - 1));
    return all;
  }();
  return colors;
}

Rgb magnitudeColor(float value) {
  if (!(value >= 0)) return kUnknownColor;
  const auto colors = magnitudeColors();
  const float at = std::min(value, 1.0f) * float(kColors - 1);
  const auto first = std::min(std::size_t(at), std::size_t(kColors - 2));
  return mix(colors[first], colors[first + 1], at - float(first));
}

}  // namespace prt
