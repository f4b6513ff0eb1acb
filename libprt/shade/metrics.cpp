#include "libprt/shade/metrics.h"

#include "libprt/core/error.h"
#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace prt {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& fix) {
  throw ValueError(what, "image comparison", fix);
}

std::string sizeText(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height) + "x" +
         std::to_string(image.channels);
}

int colours(const Image& image) {
  return image.channels >= 3 ? 3 : 1;
}

void expectComparable(const Image& a, const Image& r, const PixelMask& mask) {
  if (a.width != r.width || a.height != r.height || colours(a) != colours(r))
    refuse("images differ in shape: " + sizeText(a) + " and " + sizeText(r), "compare images of one size");
  if (!mask.empty() && mask.size() != a.pixels())
    refuse("the mask has another size than the images", "make one entry per pixel");
}

bool counts(const PixelMask& mask, std::size_t pixel) {
  return mask.empty() || mask[pixel] != 0;
}

/// A value that is known to be finite.
double finite(float v) {
  if (!std::isfinite(v)) refuse("a pixel is not finite", "find what made NaN or infinity");
  return v;
}

/// visit(value of a, value of r) for every counted pixel and channel.
template <class Visit>
void eachValue(const Image& a, const Image& r, const PixelMask& mask, const Visit& visit) {
  for (std::size_t i = 0; i < a.pixels(); ++i)
    if (counts(mask, i))
      for (int c = 0; c < colours(a); ++c)
        visit(finite(a.data[i * std::size_t(a.channels) + std::size_t(c)]),
              finite(r.data[i * std::size_t(r.channels) + std::size_t(c)]));
}

/// The smallest value that is not below 95 % of all.
double percentile95(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::lround(0.95 * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Sums of one block.
struct Block {
  double product = 0, signal = 0, count = 0;

  void add(double a, double r1, double r2) { product += (a - r1) * (a - r2), signal += r1 * r2, count += 1; }
};

/// Means over all blocks, and the standard error of the ratio of sums (blocks may differ in count).
NoiseFreeError combine(const std::vector<Block>& blocks) {
  NoiseFreeError e;
  Block all;
  for (const Block& b : blocks) {
    if (b.count == 0) continue;
    all.product += b.product, all.signal += b.signal, all.count += b.count;
    ++e.blocks;
  }
  if (e.blocks < 2) refuse("too few values for an interval", "compare more pixels or use smaller blocks");
  e.meanSquare = all.product / all.count;
  e.signal = all.signal / all.count;
  double spread = 0;
  for (const Block& b : blocks) spread += std::pow(b.product - e.meanSquare * b.count, 2);
  const double n = double(e.blocks);
  e.standardError = std::sqrt(spread * n / (n - 1)) / all.count;
  return e;
}

double relativeOf(double meanSquare, double signal) {
  if (!(meanSquare > 0)) return 0;
  return signal > 0 ? std::sqrt(meanSquare / signal) : std::numeric_limits<double>::infinity();
}

/// Oklab (Ottosson 2020, "A perceptual color space for image processing") to linear Rec.709.
Rgb fromOklab(float lightness, float a, float b) {
  const float l = std::pow(lightness + 0.3963377774f * a + 0.2158037573f * b, 3.0f);
  const float m = std::pow(lightness - 0.1055613458f * a - 0.0638541728f * b, 3.0f);
  const float s = std::pow(lightness - 0.0894841775f * a - 1.2914855480f * b, 3.0f);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

/// Lightness rises evenly; hue runs from blue over purple and red to yellow; colour fades at both ends.
Rgb heatColour(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  const float hue = float(radians(272.0 + 192.0 * double(t)));
  const float chroma = 0.05f + 0.14f * std::sin(kPiF * std::pow(t, 0.8f));
  return fromOklab(0.15f + 0.81f * t, chroma * std::cos(hue), chroma * std::sin(hue));
}

}  // namespace

PixelMask coveredPixels(const Image& image, float least) {
  PixelMask mask(image.pixels(), 1);
  if (image.channels != 2 && image.channels != 4) return mask;
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = image.data[(i + 1) * std::size_t(image.channels) - 1] >= least;
  return mask;
}

PixelMask bothMasks(const PixelMask& a, const PixelMask& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  if (a.size() != b.size()) refuse("masks differ in size", "compare images of one size");
  PixelMask both(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) both[i] = a[i] && b[i];
  return both;
}

ImageErrors compareImages(const Image& image, const Image& reference, const PixelMask& mask) {
  expectComparable(image, reference, mask);
  double error = 0, signal = 0, sum = 0, count = 0;
  ImageErrors e;
  eachValue(image, reference, mask, [&](double a, double r) {
    error += (a - r) * (a - r), signal += r * r, sum += std::abs(r), count += 1;
    e.maximum = std::max(e.maximum, std::abs(a - r));
  });
  if (count == 0) refuse("no pixel counts", "widen the mask");
  e.pixels = std::size_t(count) / std::size_t(colours(image));
  e.rmse = std::sqrt(error / count);
  e.relativeRmse = error == 0 ? 0 : relativeOf(error, signal);

  const double ground = std::max(0.01 * sum / count, 1e-30);
  std::vector<float> relative;
  relative.reserve(std::size_t(count));
  eachValue(image, reference, mask,
            [&](double a, double r) { relative.push_back(float(std::abs(a - r) / (std::abs(r) + ground))); });
  e.percentile95 = percentile95(std::move(relative));
  return e;
}

double NoiseFreeError::relative() const {
  return relativeOf(meanSquare, signal);
}
double NoiseFreeError::relativeLow() const {
  return relativeOf(meanSquare - 1.96 * standardError, signal);
}
double NoiseFreeError::relativeHigh() const {
  return relativeOf(meanSquare + 1.96 * standardError, signal);
}

NoiseFreeError noiseFreeError(std::span<const float> a, std::span<const float> r1, std::span<const float> r2,
                              std::size_t blockSize) {
  if (a.size() != r1.size() || a.size() != r2.size())
    refuse("value counts differ", "compare arrays of one size");
  if (blockSize == 0) refuse("blocks are empty", "use at least one value per block");
  std::vector<Block> blocks((a.size() + blockSize - 1) / blockSize);
  for (std::size_t i = 0; i < a.size(); ++i)
    blocks[i / blockSize].add(finite(a[i]), finite(r1[i]), finite(r2[i]));
  return combine(blocks);
}

NoiseFreeError noiseFreeError(const Image& a, const Image& r1, const Image& r2, const PixelMask& mask,
                              int blockPixels) {
  expectComparable(a, r1, mask);
  expectComparable(a, r2, mask);
  if (blockPixels < 1) refuse("blocks are empty", "use at least one pixel per block");
  const int across = (a.width + blockPixels - 1) / blockPixels;
  std::vector<Block> blocks(std::size_t(across) * std::size_t((a.height + blockPixels - 1) / blockPixels));
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (!counts(mask, std::size_t(y) * std::size_t(a.width) + std::size_t(x))) continue;
      Block& block =
          blocks[std::size_t(y / blockPixels) * std::size_t(across) + std::size_t(x / blockPixels)];
      for (int c = 0; c < colours(a); ++c)
        block.add(finite(a.pixel(x, y)[c]), finite(r1.pixel(x, y)[c]), finite(r2.pixel(x, y)[c]));
    }
  return combine(blocks);
}

Image heatMap(const Image& values, float top, const PixelMask& mask) {
  Image out(values.width, values.height, 3);
  const float scale = top > 0 ? 1 / top : 0;
  for (std::size_t i = 0; i < values.pixels(); ++i) {
    const float v = values.data[i * std::size_t(values.channels)] * scale;
    const Rgb colour = counts(mask, i) ? toDisplay(heatColour(std::isnan(v) ? 1.0f : v), {}) : Rgb(0.5f);
    for (int c = 0; c < 3; ++c) out.data[i * 3 + std::size_t(c)] = colour[c];
  }
  return out;
}

}  // namespace prt
