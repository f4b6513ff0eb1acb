#include "libprt/shade/flip.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace prt {
namespace {

// Constants of the 2020 paper, sections 4.1 to 4.3.
constexpr float kColourExponent = 0.7f, kColourSplit = 0.4f, kColourTarget = 0.95f;
constexpr float kFeatureExponent = 0.5f, kFeatureWidthDegrees = 0.082f;
/// Contrast sensitivity of a channel in the frequency domain is a sum of two Gaussians; in space
/// a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivity{
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidestSensitivity = 0.04;

/// Three planes, one after the other.
struct Planes {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> plane;

  Planes(int w, int h) : width(w), height(h) {
    for (auto& p : plane) p.resize(std::size_t(w) * std::size_t(h));
  }
  std::size_t pixels() const { return plane[0].size(); }
  Vec3 at(std::size_t i) const { return {plane[0][i], plane[1][i], plane[2][i]}; }
  void set(std::size_t i, const Vec3& v) {
    for (int c = 0; c < 3; ++c) plane[std::size_t(c)][i] = v[c];
  }
};

using Kernel = std::vector<float>;  // weights of offsets -radius .. radius

// Colour spaces. Rows of sRGB's matrix to XYZ (IEC 61966-2-1); the white is that of (1, 1, 1).
const Mat3 kToXyz = transpose(Mat3(0.4123907993f, 0.3575843394f, 0.1804807884f, 0.2126390059f, 0.7151686788f,
                                   0.0721923154f, 0.0193308187f, 0.1191947798f, 0.9505321522f));
const Mat3 kFromXyz = inverse(kToXyz);
const Vec3 kWhite = kToXyz * Vec3(1);

/// Linearised CIELAB, in which filtering is linear.
Vec3 toOpponent(const Rgb& c) {
  const Vec3 n = (kToXyz * c) / kWhite;
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}
Rgb fromOpponent(const Vec3& o) {
  const float y = (o.x + 16) / 116;
  return kFromXyz * (Vec3(o.y / 500 + y, y, y - o.z / 200) * kWhite);
}

/// CIELAB with the Hunt effect: chroma counts less in the dark.
Vec3 toHuntLab(const Rgb& c) {
  const auto f = [](float t) {
    constexpr float d = 6.0f / 29.0f;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0f / 29.0f;
  };
  const Vec3 n = (kToXyz * c) / kWhite;
  const float l = 116 * f(n.y) - 16;
  const float hunt = 0.01f * l;
  return {l, hunt * 500 * (f(n.x) - f(n.y)), hunt * 200 * (f(n.y) - f(n.z))};
}

/// Distance for large colour differences (Abasi et al. 2020).
float hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + length(Vec2(a.y - b.y, a.z - b.z));
}

/// Compresses large colour differences to 0..1.
float redistribute(float difference) {
  static const float largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColourExponent);
  const float d = std::pow(difference, kColourExponent), split = kColourSplit * largest;
  if (d < split) return kColourTarget / split * d;
  return kColourTarget + (d - split) / (largest - split) * (1 - kColourTarget);
}

/// out = in filtered by `across` along rows and `down` along columns; edges repeat.
void separable(const std::vector<float>& in, int width, int height, const Kernel& across, const Kernel& down,
               std::vector<float>& out, Job& job) {
  std::vector<float> rows(in.size());
  const int ra = int(across.size() / 2), rd = int(down.size() / 2);
  parallelFor(job, 0, std::size_t(height), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> padded(std::size_t(width) + across.size());
    for (std::size_t y = begin; y < end; ++y) {
      const float* line = in.data() + y * std::size_t(width);
      for (std::size_t i = 0; i < padded.size(); ++i) padded[i] = line[std::clamp(int(i) - ra, 0, width - 1)];
      float* to = rows.data() + y * std::size_t(width);
      std::fill(to, to + width, 0.0f);
      for (std::size_t k = 0; k < across.size(); ++k)
        for (int x = 0; x < width; ++x) to[x] += across[k] * padded[std::size_t(x) + k];
    }
  });
  out.assign(in.size(), 0.0f);
  parallelFor(job, 0, std::size_t(height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t k = 0; k < down.size(); ++k) {
        const int row = std::clamp(int(y) + int(k) - rd, 0, height - 1);
        const float* line = rows.data() + std::size_t(row) * std::size_t(width);
        float* to = out.data() + y * std::size_t(width);
        for (int x = 0; x < width; ++x) to[x] += down[k] * line[x];
      }
  });
}

/// Filters one channel by its contrast sensitivity: two separable Gaussians, normalised together.
void filterChannel(const std::vector<float>& in, int width, int height, const Sensitivity& s, float ppd,
                   std::vector<float>& out, Job& job) {
  const int radius = int(std::ceil(3 * std::sqrt(kWidestSensitivity / (2 * kPi * kPi)) * ppd));
  const auto gaussian = [&](double b) {
    Kernel k;
    for (int i = -radius; i <= radius; ++i)
      k.push_back(float(std::exp(-kPi * kPi * i * i / (double(ppd) * ppd * b))));
    return k;
  };
  const auto total = [](const Kernel& k) {
    double sum = 0;
    for (const float w : k) sum += w;
    return sum * sum;
  };
  const Kernel first = gaussian(s.b1), second = gaussian(s.b2);
  const double h1 = s.a1 * std::sqrt(kPi / s.b1), h2 = s.a2 * std::sqrt(kPi / s.b2);
  const double norm = h1 * total(first) + h2 * total(second);
  separable(in, width, height, first, first, out, job);
  for (float& v : out) v *= float(h1 / norm);
  if (h2 == 0) return;
  std::vector<float> more;
  separable(in, width, height, second, second, more, job);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += float(h2 / norm) * more[i];
}

/// What a viewer's eye keeps of an image, in Hunt-adjusted CIELAB.
Planes perceived(const Planes& opponent, float ppd, Job& job) {
  Planes out(opponent.width, opponent.height);
  for (std::size_t c = 0; c < 3; ++c)
    filterChannel(opponent.plane[c], out.width, out.height, kSensitivity[c], ppd, out.plane[c], job);
  parallelFor(job, 0, out.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      out.set(i, toHuntLab(clamp(fromOpponent(out.at(i)), 0.0f, 1.0f)));
  });
  return out;
}

/// Strength of edges (first derivative) and points (second derivative) of the lightness.
struct Features {
  std::vector<float> edge, point;
};

/// Scales positive weights to a sum of 1 and negative ones to -1.
void balance(Kernel& k) {
  double up = 0, down = 0;
  for (const float w : k) (w > 0 ? up : down) += w;
  for (float& w : k) w = float(w > 0 ? w / up : w / -down);
}

Features features(const Planes& opponent, float ppd, Job& job) {
  const double sigma = 0.5 * kFeatureWidthDegrees * ppd;
  const int radius = int(std::ceil(3 * sigma));
  Kernel smooth, first, second;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    smooth.push_back(float(g)), sum += g;
    first.push_back(float(-i * g));
    second.push_back(float((i * i / (sigma * sigma) - 1) * g));
  }
  for (float& w : smooth) w = float(w / sum);
  balance(first), balance(second);

  const int width = opponent.width, height = opponent.height;
  std::vector<float> lightness(opponent.pixels());
  for (std::size_t i = 0; i < lightness.size(); ++i) lightness[i] = (opponent.plane[0][i] + 16) / 116;
  const auto magnitude = [&](const Kernel& derivative) {
    std::vector<float> x, y;
    separable(lightness, width, height, derivative, smooth, x, job);
    separable(lightness, width, height, smooth, derivative, y, job);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    return x;
  };
  return {magnitude(first), magnitude(second)};
}

/// LDR-FLIP of two images with values in 0..1, per pixel.
std::vector<float> differenceMap(const Planes& image, const Planes& reference, float ppd, Job& job) {
  const auto opponent = [&](const Planes& in) {
    Planes out(in.width, in.height);
    for (std::size_t i = 0; i < in.pixels(); ++i) out.set(i, toOpponent(in.at(i)));
    return out;
  };
  const Planes oa = opponent(image), ob = opponent(reference);
  const Planes a = perceived(oa, ppd, job), b = perceived(ob, ppd, job);
  const Features fa = features(oa, ppd, job), fb = features(ob, ppd, job);
  std::vector<float> map(image.pixels());
  parallelFor(job, 0, map.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float colour = redistribute(hyab(a.at(i), b.at(i)));
      const float strongest =
          std::max(std::abs(fa.edge[i] - fb.edge[i]), std::abs(fa.point[i] - fb.point[i]));
      const float feature = std::pow(strongest * std::sqrt(0.5f), kFeatureExponent);
      map[i] = std::clamp(std::pow(colour, 1 - feature), 0.0f, 1.0f);
    }
  });
  return map;
}

/// Copies the counted pixels; NaN and negative values become 0.
Planes planesOf(const Image& image, const PixelMask& mask) {
  Planes out(image.width, image.height);
  for (int y = 0, i = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, ++i) {
      const Rgb c = image.rgb(x, y);
      if (!mask.empty() && !mask[std::size_t(i)]) continue;
      out.set(std::size_t(i), {c.x > 0 ? c.x : 0, c.y > 0 ? c.y : 0, c.z > 0 ? c.z : 0});
    }
  return out;
}

template <class Tone>
Planes toned(const Planes& in, const Tone& tone) {
  Planes out(in.width, in.height);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < in.pixels(); ++i) out.plane[c][i] = std::min(tone(in.plane[c][i]), 1.0f);
  return out;
}

FlipResult summarise(std::vector<float> map, int width, int height, const PixelMask& mask) {
  FlipResult result;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!mask.empty() && !mask[i])
      map[i] = 0;
    else
      sum += map[i], count += 1;
  }
  result.mean = count > 0 ? sum / count : 0;
  result.map = Image(width, height, 1);
  result.map.data = std::move(map);
  return result;
}

void expectFit(const Image& image, const Image& reference, const PixelMask& mask, float ppd) {
  if (image.width != reference.width || image.height != reference.height || image.empty())
    throw ValueError("images differ in size or are empty", "FLIP", "compare images of one size");
  if (!mask.empty() && mask.size() != image.pixels())
    throw ValueError("the mask has another size than the images", "FLIP", "make one entry per pixel");
  if (!(ppd >= 1 && ppd <= 1000))
    throw ValueError("pixels per degree are out of range", "FLIP",
                     "use 1 to 1000; a desk screen has about 67");
}

/// The radiance that the filmic curve takes to `shown`.
float inverseFilmic(float shown) {
  const double a = 2.51 - 2.43 * shown, b = 0.03 - 0.59 * shown, c = -0.14 * shown;
  return float((-b + std::sqrt(b * b - 4 * a * c)) / (2 * a));
}

/// Exposures at which the brightest and the median pixel of the reference appear bright (0.85).
void exposureRange(const Planes& reference, const PixelMask& mask, FlipResult& result) {
  std::vector<float> luminances;
  for (std::size_t i = 0; i < reference.pixels(); ++i)
    if ((mask.empty() || mask[i]) && luminance(reference.at(i)) > 0)
      luminances.push_back(std::min(luminance(reference.at(i)), 1e30f));
  if (luminances.empty()) return;
  const auto middle = luminances.begin() + std::ptrdiff_t(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const float median = *middle, brightest = *std::max_element(luminances.begin(), luminances.end());
  const float bright = inverseFilmic(0.85f);
  result.firstExposure = std::log2(bright / brightest);
  result.lastExposure = std::log2(bright / median);
  result.exposures = std::max(2, int(std::ceil(result.lastExposure - result.firstExposure)));
}

}  // namespace

FlipResult ldrFlip(const Image& image, const Image& reference, const PixelMask& mask, Job& job,
                   float pixelsPerDegree) {
  expectFit(image, reference, mask, pixelsPerDegree);
  const auto clip = [](float x) { return x; };
  return summarise(differenceMap(toned(planesOf(image, mask), clip), toned(planesOf(reference, mask), clip),
                                 pixelsPerDegree, job),
                   image.width, image.height, mask);
}

FlipResult hdrFlip(const Image& image, const Image& reference, const PixelMask& mask, Job& job,
                   float pixelsPerDegree) {
  expectFit(image, reference, mask, pixelsPerDegree);
  const Planes a = planesOf(image, mask), r = planesOf(reference, mask);
  FlipResult range;
  exposureRange(r, mask, range);
  std::vector<float> worst(a.pixels(), 0.0f);
  for (int i = 0; i < range.exposures; ++i) {
    const float part = range.exposures > 1 ? float(i) / float(range.exposures - 1) : 0;
    const float gain = std::exp2(range.firstExposure + part * (range.lastExposure - range.firstExposure));
    const auto tone = [gain](float x) { return filmicCurve(std::min(gain * x, 1e6f)); };
    const std::vector<float> map = differenceMap(toned(a, tone), toned(r, tone), pixelsPerDegree, job);
    for (std::size_t k = 0; k < worst.size(); ++k) worst[k] = std::max(worst[k], map[k]);
  }
  FlipResult result = summarise(std::move(worst), image.width, image.height, mask);
  result.exposures = range.exposures;
  result.firstExposure = range.firstExposure;
  result.lastExposure = range.lastExposure;
  return result;
}

}  // namespace prt
