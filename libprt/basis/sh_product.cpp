#include "libprt/basis/sh_product.h"

#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace prt {
namespace {

constexpr double kZero = 1e-10;  // what is smaller is rounding

/// The part of Y_lm that depends on z, at every Gauss-Legendre node: Y_l|m| at azimuth 0.
class PolarParts {
 public:
  PolarParts(int bands, int degree) : rule_(gaussLegendre(degree / 2 + 1)), values_(shCount(bands)) {
    std::vector<double> y(shCount(bands));
    for (double z : rule_.nodes) {
      shEvaluate(bands, DVec3(std::sqrt((1 - z) * (1 + z)), 0, z), std::span(y));
      for (int l = 0; l < bands; ++l)
        for (int m = 0; m <= l; ++m) values_[shIndex(l, m)].push_back(y[shIndex(l, m)]);
    }
  }
  /// Integral over z of three of them, orders taken as absolute values.
  double integral(int l1, int m1, int l2, int m2, int l3, int m3) const {
    const auto &a = values_[shIndex(l1, m1)], &b = values_[shIndex(l2, m2)], &c = values_[shIndex(l3, m3)];
    double sum = 0;
    for (std::size_t i = 0; i < rule_.nodes.size(); ++i) sum += rule_.weights[i] * a[i] * b[i] * c[i];
    return sum;
  }

 private:
  IntervalRule rule_;
  std::vector<std::vector<double>> values_;
};

/// Integral over azimuth of three of cos(m phi) (m >= 0), sin(|m| phi) (m < 0).
double azimuthIntegral(int m1, int m2, int m3) {
  const int steps = std::abs(m1) + std::abs(m2) + std::abs(m3) + 1;
  const auto wave = [](int m, double phi) { return m >= 0 ? std::cos(m * phi) : std::sin(-m * phi); };
  double sum = 0;
  for (int s = 0; s < steps; ++s) {
    const double phi = 2 * kPi * (s + 0.25) / steps;
    sum += wave(m1, phi) * wave(m2, phi) * wave(m3, phi);
  }
  return sum * 2 * kPi / steps;
}

struct Order {
  int m;
  double integral;
};

/// Third orders for which the azimuth integral with m1, m2 is not zero, with its value.
std::vector<Order> matchingOrders(int m1, int m2) {
  const int sum = std::abs(m1) + std::abs(m2), difference = std::abs(std::abs(m1) - std::abs(m2));
  std::vector<Order> orders;
  for (int m : std::set<int>{-sum, -difference, difference, sum}) {
    const double integral = azimuthIntegral(m1, m2, m);
    if (std::abs(integral) > kZero) orders.push_back({m, integral});
  }
  return orders;
}

void requireBands(int bands) {
  if (bands >= 1 && bands <= kMaxGauntBands) return;
  throw ValueError("cannot use " + std::to_string(bands) + " bands", "product of spherical harmonics",
                   "use 1 to " + std::to_string(kMaxGauntBands));
}

void requireSize(std::size_t size, std::size_t needed) {
  if (size < needed) throw std::length_error("product of spherical harmonics: a span is too short");
}

template <class T>
void contractEntries(const GauntTensor& g, std::span<const T> f, std::span<T> matrix) {
  const std::size_t columns = shCount(g.bandsJ()), size = shCount(g.bandsI()) * columns;
  requireSize(f.size(), shCount(g.bandsK()));
  requireSize(matrix.size(), size);
  std::fill_n(matrix.begin(), size, T(0));
  const std::span<const GauntTensor::Entry> entries = g.entries();
  for (std::size_t e = 0; e < entries.size();) {
    const GauntTensor::Entry& first = entries[e];
    double sum = 0;
    for (; e < entries.size() && entries[e].j == first.j && entries[e].i == first.i; ++e)
      sum += entries[e].value * f[entries[e].k];
    matrix[first.i * columns + first.j] = T(sum);
  }
}

}  // namespace

GauntTensor::GauntTensor(int bandsI, int bandsJ, int bandsK)
    : bandsI_(bandsI), bandsJ_(bandsJ), bandsK_(bandsK) {
  for (int bands : {bandsI, bandsJ, bandsK}) requireBands(bands);
  const PolarParts polar(std::max({bandsI, bandsJ, bandsK}), bandsI + bandsJ + bandsK - 3);
  for (int m1 = 1 - bandsI; m1 < bandsI; ++m1)
    for (int m2 = 1 - bandsJ; m2 < bandsJ; ++m2)
      for (const Order& third : matchingOrders(m1, m2))
        for (int l1 = std::abs(m1); l1 < bandsI; ++l1)
          for (int l2 = std::abs(m2); l2 < bandsJ; ++l2)
            // Triangle rule and parity: l3 = |l1-l2|, |l1-l2|+2, ... l1+l2.
            for (int l3 = std::abs(l1 - l2); l3 <= std::min(l1 + l2, bandsK - 1); l3 += 2) {
              if (l3 < std::abs(third.m)) continue;
              const double value =
                  third.integral * polar.integral(l1, std::abs(m1), l2, std::abs(m2), l3, std::abs(third.m));
              if (std::abs(value) < kZero) continue;
              entries_.push_back({std::uint16_t(shIndex(l1, m1)), std::uint16_t(shIndex(l2, m2)),
                                  std::uint16_t(shIndex(l3, third.m)), value});
            }
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.i, a.j, a.k) < std::tie(b.i, b.j, b.k); });
}

void GauntTensor::contract(std::span<const float> f, std::span<float> matrix) const {
  contractEntries(*this, f, matrix);
}
void GauntTensor::contract(std::span<const double> f, std::span<double> matrix) const {
  contractEntries(*this, f, matrix);
}

const GauntTensor& gauntTensor(int bandsI, int bandsJ, int bandsK) {
  static std::mutex mutex;
  static std::map<std::tuple<int, int, int>, std::unique_ptr<const GauntTensor>> kept;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const GauntTensor>& tensor = kept[{bandsI, bandsJ, bandsK}];
  if (!tensor) tensor = std::make_unique<const GauntTensor>(bandsI, bandsJ, bandsK);
  return *tensor;
}

void expandVisibility(int bands, std::span<const float> visibility, std::span<float> matrix) {
  // One lock per sample would serialise the threads of a bake: the tensors found so far are kept here.
  static std::array<std::atomic<const GauntTensor*>, kMaxGauntBands / 2 + 1> found{};
  if (bands < 1 || bands >= int(found.size())) requireBands(bands < 1 ? bands : 2 * bands - 1);
  const GauntTensor* tensor = found[bands].load(std::memory_order_acquire);
  if (!tensor)
    found[bands].store(tensor = &gauntTensor(bands, bands, 2 * bands - 1), std::memory_order_release);
  tensor->contract(visibility, matrix);
}

std::vector<float> shProduct(int bandsA, std::span<const float> a, int bandsB, std::span<const float> b,
                             int bandsOut) {
  const GauntTensor& tensor = gauntTensor(bandsA, bandsB, bandsOut);
  requireSize(a.size(), shCount(bandsA));
  requireSize(b.size(), shCount(bandsB));
  std::vector<double> sums(shCount(bandsOut), 0.0);
  for (const GauntTensor::Entry& e : tensor.entries()) sums[e.k] += e.value * a[e.i] * b[e.j];
  return {sums.begin(), sums.end()};
}

}  // namespace prt
