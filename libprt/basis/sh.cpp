#include "libprt/basis/sh.h"

#include "libprt/basis/sh_kernel.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <string>

namespace prt {
namespace {

using sh_kernel::evaluate;
using sh_kernel::kLanes;
using sh_kernel::Lanes;
using sh_kernel::transpose;

struct LaneDirections {
  Lanes x, y, z;
};

/// Directions first .. first+count; the lanes beyond repeat +z.
LaneDirections loadDirections(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                              std::size_t first, std::size_t count) {
  LaneDirections d{Lanes{}, Lanes{}, Lanes{} + 1.0f};
  for (std::size_t i = 0; i < count; ++i) d.x[i] = x[first + i], d.y[i] = y[first + i], d.z[i] = z[first + i];
  return d;
}

/// out[lane * functions + k] = values[k][lane] for the first `count` lanes.
void storeByDirection(const Lanes* values, int functions, std::size_t count, float* out) {
  int k = 0;
  for (; k + kLanes <= functions; k += kLanes) {
    std::array<Lanes, kLanes> block;
    std::copy_n(values + k, kLanes, block.begin());
    transpose(block);
    for (std::size_t lane = 0; lane < count; ++lane)
      std::copy_n(reinterpret_cast<const float*>(&block[lane]), kLanes, out + lane * functions + k);
  }
  for (; k < functions; ++k)
    for (std::size_t lane = 0; lane < count; ++lane) out[lane * functions + k] = values[k][lane];
}

// --- Checks -------------------------------------------------------------------------------------------

void requireBands(int bands) {
  if (bands >= 1 && bands <= kMaxShBands) return;
  throw ValueError("cannot use " + std::to_string(bands) + " bands", "spherical harmonics",
                   "use 1 to " + std::to_string(kMaxShBands));
}

void requireSize(std::size_t size, std::size_t needed) {
  if (size < needed) throw std::length_error("spherical harmonics: a span is too short");
}

}  // namespace

void shEvaluate(int bands, const Vec3& d, std::span<float> out) {
  requireBands(bands);
  requireSize(out.size(), shCount(bands));
  evaluate<float>(bands, d.x, d.y, d.z, 1.0f, [&](int k, float value) { out[k] = value; });
}

void shEvaluate(int bands, const DVec3& d, std::span<double> out) {
  requireBands(bands);
  requireSize(out.size(), shCount(bands));
  evaluate<double>(bands, d.x, d.y, d.z, 1.0, [&](int k, double value) { out[k] = value; });
}

void shEvaluateBatch(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                     std::span<float> out) {
  requireBands(bands);
  const int functions = shCount(bands);
  requireSize(std::min(y.size(), z.size()), x.size());
  requireSize(out.size(), x.size() * functions);
  std::array<Lanes, shCount(kMaxShBands)> values;
  for (std::size_t i = 0; i < x.size(); i += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, x.size() - i);
    const LaneDirections d = loadDirections(x, y, z, i, count);
    evaluate<float>(bands, d.x, d.y, d.z, Lanes{} + 1.0f, [&](int k, Lanes value) { values[k] = value; });
    storeByDirection(values.data(), functions, count, out.data() + i * functions);
  }
}

void shAccumulate(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                  std::span<const float> weights, std::span<float> sum) {
  requireBands(bands);
  const int functions = shCount(bands);
  requireSize(std::min({y.size(), z.size(), weights.size()}), x.size());
  requireSize(sum.size(), functions);
  std::array<Lanes, shCount(kMaxShBands)> sums;
  std::fill_n(sums.begin(), functions, Lanes{});
  for (std::size_t i = 0; i < x.size(); i += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, x.size() - i);
    const LaneDirections d = loadDirections(x, y, z, i, count);
    Lanes w{};
    std::copy_n(weights.data() + i, count, reinterpret_cast<float*>(&w));
    evaluate<float>(bands, d.x, d.y, d.z, w, [&](int k, Lanes value) { sums[k] += value; });
  }
  for (int k = 0; k < functions; ++k)
    for (int lane = 0; lane < kLanes; ++lane) sum[k] += sums[k][lane];
}

Rgb ShRgb::evaluate(const Vec3& d) const {
  std::array<float, shCount(kMaxShBands)> y;
  shEvaluate(bands, d, y);
  Rgb value(0);
  for (int k = 0; k < shCount(bands); ++k) value += c[k] * y[k];
  return value;
}

}  // namespace prt
