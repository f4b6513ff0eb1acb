#pragma once
// Windows against ringing: a truncated series of a bright light swings below zero around it; damping the
// upper bands trades contrast for that. A window is one factor per band (apply it with scaleBands).
// Dering what is displayed: light or irradiance. Negative lobes inside transfer are legitimate.
// Sources: Sloan 2008, 2017 ("Deringing Spherical Harmonics"); the Fejer family and its blend are our own.

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"

#include <span>
#include <vector>

namespace prt {

/// (1 + cos(pi l / bands)) / 2 and sin(pi l / bands) / (pi l / bands): customary, but neither removes
/// negative values altogether.
std::vector<double> hannWindow(int bands);
std::vector<double> lanczosWindow(int bands);

/// Band factors of the sharpest non-negative zonal kernel with this many bands, normalised to integral 1:
/// any non-negative light convolved with it stays non-negative. 5 bands: 1, 0.667, 0.514, 0.286, 0.159.
std::vector<double> fejerWindow(int bands);

struct ShMinimum {
  double value;
  DVec3 direction;
};

/// Lowest value of a function of 1..kMaxWindowBands bands over the sphere: the best of a grid of 4096
/// directions, refined.
ShMinimum findMinimum(int bands, std::span<const float> coefficients);

inline constexpr int kMaxWindowBands = 20;

struct Deringed {
  ShRgb light;
  std::vector<double> window;  ///< 1 + blend * (fejer - 1): what the light was multiplied by
  double blend = 0;            ///< 0 = left as it was, 1 = fully windowed
  double minimum = 0;          ///< lowest value of any channel afterwards, after `receiver` if given
};

/// The least blend from no window to the Fejer window that leaves no negative value in any channel; one
/// window for all three, so that colours do not shift. With `receiver` (band factors, such as
/// clampedCosineFactors) the convolved light is tested instead, which takes less. Where the light does not
/// come from a non-negative source even the full window may leave a negative minimum: see `minimum`.
Deringed dering(const ShRgb& light, std::span<const double> receiver = {});

}  // namespace prt
