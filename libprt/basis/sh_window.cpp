#include "libprt/basis/sh_window.h"

#include "libprt/basis/legendre.h"
#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace prt {
namespace {

void requireBands(int bands, int most) {
  if (bands >= 1 && bands <= most) return;
  throw ValueError("cannot use " + std::to_string(bands) + " bands", "window",
                   "use 1 to " + std::to_string(most));
}

// --- Search for the minimum ----------------------------------------------------------------------------

constexpr int kGrid = 4096;
constexpr double kGridSpacing = 0.056;  // radians: sqrt(4 pi / kGrid)

/// Directions on a spiral of equal areas (a Fibonacci lattice).
struct Grid {
  std::vector<float> x, y, z;

  Grid() {
    const double golden = kPi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kGrid; ++i) {
      const double h = 1 - (2 * i + 1.0) / kGrid, r = std::sqrt(1 - h * h);
      x.push_back(float(r * std::cos(golden * i)));
      y.push_back(float(r * std::sin(golden * i)));
      z.push_back(float(h));
    }
  }
  DVec3 operator[](int i) const { return normalize(DVec3(x[i], y[i], z[i])); }
};

const Grid& grid() {
  static const Grid instance;
  return instance;
}

std::vector<float> valuesOnGrid(int bands, std::span<const float> c) {
  const int functions = shCount(bands);
  std::vector<float> values, y;
  constexpr std::size_t kChunk = 256;
  for (std::size_t i = 0; i < kGrid; i += kChunk) {
    y.resize(kChunk * functions);
    const auto part = [&](const std::vector<float>& v) { return std::span(v).subspan(i, kChunk); };
    shEvaluateBatch(bands, part(grid().x), part(grid().y), part(grid().z), y);
    for (std::size_t s = 0; s < kChunk; ++s)
      values.push_back(std::inner_product(c.begin(), c.begin() + functions, y.begin() + s * functions, 0.0f));
  }
  return values;
}

double valueAt(int bands, std::span<const float> c, const DVec3& d) {
  std::array<double, shCount(kMaxWindowBands)> y;
  shEvaluate(bands, d, std::span(y));
  double sum = 0;
  for (int k = 0; k < shCount(bands); ++k) sum += c[k] * y[k];
  return sum;
}

/// Walks downhill in ever smaller steps around `start`.
ShMinimum refine(int bands, std::span<const float> c, const DVec3& start) {
  ShMinimum best{valueAt(bands, c, start), start};
  for (double step = kGridSpacing; step > 1e-5; step *= 0.5) {
    const Frame frame = frameFromNormal(Vec3(best.direction));
    const DVec3 centre = best.direction;
    for (int i = 0; i < 8; ++i) {
      const double angle = i * kPi / 4;
      const DVec3 d = normalize(centre + step * (std::cos(angle) * DVec3(frame.tangent) +
                                                 std::sin(angle) * DVec3(frame.bitangent)));
      const double value = valueAt(bands, c, d);
      if (value < best.value) best = {value, d};
    }
  }
  return best;
}

// --- Dering ----------------------------------------------------------------------------------------------

std::vector<double> blended(std::span<const double> window, double blend) {
  std::vector<double> w(window.begin(), window.end());
  for (double& factor : w) factor = 1 + blend * (factor - 1);
  return w;
}

/// Coefficients of one channel as a receiver sees them through a window.
std::vector<float> channelSeen(const ShRgb& light, int channel, std::span<const double> window,
                               std::span<const double> receiver) {
  std::vector<float> c;
  for (const Rgb& value : light.c) c.push_back(value[channel]);
  scaleBands(window, light.bands, std::span(c));
  if (!receiver.empty()) scaleBands(receiver, light.bands, std::span(c));
  return c;
}

/// Least blend that lifts a value f at blend 0, g at blend 1, to zero.
double blendFor(double f, double g) {
  return f >= 0 ? 0 : g <= f ? 1 : std::min(1.0, -f / (g - f));
}

}  // namespace

std::vector<double> hannWindow(int bands) {
  requireBands(bands, kMaxShBands);
  std::vector<double> w(bands);
  for (int l = 0; l < bands; ++l) w[l] = 0.5 * (1 + std::cos(kPi * l / bands));
  return w;
}

std::vector<double> lanczosWindow(int bands) {
  requireBands(bands, kMaxShBands);
  std::vector<double> w(bands, 1.0);
  for (int l = 1; l < bands; ++l) w[l] = std::sin(kPi * l / bands) / (kPi * l / bands);
  return w;
}

std::vector<double> fejerWindow(int bands) {
  requireBands(bands, kMaxShBands);
  // Among non-negative kernels q(t)^2 (degree even) or (1 + t) q(t)^2 (degree odd) with integral 1, the
  // largest value at t = 1 has q = the kernel that reproduces q(1) under the weight 1 or 1 + t: the Jacobi
  // polynomial P_K^(1,0) or P_K^(1,1), which are sums of Legendre derivatives.
  const int degree = bands - 1, k = degree / 2;
  const bool odd = degree % 2;
  const IntervalRule rule = gaussLegendre(bands);
  std::vector<double> w(bands, 0.0);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = rule.nodes[i];
    const LegendreTable p(std::max(bands, k + 2), t);
    const double q = p.slope[k + 1] + (odd ? 0 : p.slope[k]);
    const double kernel = (odd ? 1 + t : 1) * q * q;
    for (int l = 0; l < bands; ++l) w[l] += rule.weights[i] * kernel * p.value[l];
  }
  for (int l = bands - 1; l >= 0; --l) w[l] /= w[0];
  return w;
}

ShMinimum findMinimum(int bands, std::span<const float> c) {
  requireBands(bands, kMaxWindowBands);
  if (c.size() < std::size_t(shCount(bands)))
    throw std::length_error("minimum: a coefficient span is too short");
  const std::vector<float> values = valuesOnGrid(bands, c);
  std::vector<int> order(kGrid);
  std::iota(order.begin(), order.end(), 0);
  constexpr int kCandidates = 32;  // several basins may be nearly equally deep
  std::partial_sort(order.begin(), order.begin() + kCandidates, order.end(),
                    [&](int a, int b) { return values[a] < values[b]; });
  ShMinimum best = refine(bands, c, grid()[order[0]]);
  for (int i = 1; i < kCandidates; ++i) {
    const ShMinimum other = refine(bands, c, grid()[order[i]]);
    if (other.value < best.value) best = other;
  }
  return best;
}

Deringed dering(const ShRgb& light, std::span<const double> receiver) {
  requireBands(light.bands, kMaxWindowBands);
  const std::vector<double> fejer = fejerWindow(light.bands), none(light.bands, 1.0);
  Deringed result{light, none, 0, 0};
  // Raise the blend until the deepest point of the blended light is not negative. Each round looks at the
  // point that is deepest now, so a few rounds are enough.
  constexpr int kRounds = 12;
  for (int round = 0; round <= kRounds; ++round) {
    double needed = result.blend;
    result.minimum = std::numeric_limits<double>::max();
    for (int channel = 0; channel < 3; ++channel) {
      const ShMinimum lowest = findMinimum(light.bands, channelSeen(light, channel, result.window, receiver));
      result.minimum = std::min(result.minimum, lowest.value);
      if (lowest.value >= 0) continue;
      const double f = valueAt(light.bands, channelSeen(light, channel, none, receiver), lowest.direction);
      const double g = valueAt(light.bands, channelSeen(light, channel, fejer, receiver), lowest.direction);
      needed = std::max(needed, blendFor(f, g));
    }
    if (needed <= result.blend || round == kRounds) break;
    result.blend = std::min(1.0, needed + 1e-6);  // clear of rounding
    result.window = blended(fejer, result.blend);
  }
  scaleBands(result.window, result.light);
  return result;
}

}  // namespace prt
