#pragma once
// How far an image is from a reference. All figures are over the counted pixels only and over the first
// three channels (one for grey images), in linear radiance unless said otherwise.

#include "libprt/core/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Which pixels count, row by row; 0 = left out. Empty = all.
using PixelMask = std::vector<std::uint8_t>;

/// Pixels whose alpha is at least `least`; all of them when the image has no alpha channel.
PixelMask coveredPixels(const Image& image, float least = 0.999f);
/// Pixels counted by both; an empty mask counts all.
PixelMask bothMasks(const PixelMask& a, const PixelMask& b);

struct ImageErrors {
  std::size_t pixels = 0;   ///< counted
  double rmse = 0;          ///< sqrt(mean (a - r)^2)
  double relativeRmse = 0;  ///< ||a - r|| / ||r||; 0 when both are black, infinite when only r is
  double maximum = 0;       ///< largest |a - r|
  double percentile95 = 0;  ///< of |a - r| / (r + 0.01 mean r), one value per pixel and channel
};

/// Throws ValueError when sizes or colour channels differ, the mask does not fit, or a counted value is
/// not finite.
ImageErrors compareImages(const Image& image, const Image& reference, const PixelMask& mask = {});

/// An error freed of the references' noise. With two independent unbiased references r1, r2 the mean of
/// (a - r1)(a - r2) has no noise term: its expectation is the true mean squared error of `a`. The
/// interval is two-sided 95 %, from the spread between blocks.
struct NoiseFreeError {
  double meanSquare = 0;     ///< may be slightly negative when the error is far below the noise
  double standardError = 0;  ///< of meanSquare
  double signal = 0;         ///< mean of r1 r2: the references' mean square, free of noise too
  std::size_t blocks = 0;

  /// sqrt(meanSquare / signal), negative mean squares as 0; and the ends of its interval.
  double relative() const;
  double relativeLow() const;
  double relativeHigh() const;
};

/// Values in one long row; consecutive runs of `blockSize` form the blocks. Throws ValueError when sizes
/// differ, there are fewer than two blocks, or a value is not finite.
NoiseFreeError noiseFreeError(std::span<const float> a, std::span<const float> r1, std::span<const float> r2,
                              std::size_t blockSize);
/// Images; blocks are squares of `blockPixels` pixels a side.
NoiseFreeError noiseFreeError(const Image& a, const Image& r1, const Image& r2, const PixelMask& mask = {},
                              int blockPixels = 16);

/// Colours an image's first channel for display: dark blue at 0, over purple, red and orange to pale
/// yellow at `top`; even steps in value are even steps in lightness. Result: 3 channels, sRGB-encoded.
/// Pixels left out by the mask are mid grey.
Image heatMap(const Image& values, float top, const PixelMask& mask = {});

}  // namespace prt
