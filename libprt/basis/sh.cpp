#include "libprt/basis/sh.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace prt {
namespace {

// --- Coefficients of the recurrences, made by the compiler ---------------------------------------

constexpr double squareRoot(double x) {
  double root = x > 1 ? x : 1;
  for (double last = 0; root != last && root * root > x;) {
    last = root;
    root = 0.5 * (root + x / root);
  }
  return root;
}

constexpr int kRows = kMaxShBands * (kMaxShBands + 1) / 2;
constexpr int packed(int l, int m) {
  return l * (l + 1) / 2 + m;
}

/// With q_lm = Y_lm / (sin^m(theta) cos(m phi)), sqrt(2) included for m > 0:
/// q_mm = start[m], q_lm = up[lm] z q_{l-1,m} - back[lm] q_{l-2,m}.
template <class T>
struct Recurrence {
  std::array<T, kMaxShBands> start{};
  std::array<T, kRows> up{};
  std::array<T, kRows> back{};

  constexpr Recurrence() {
    double q = squareRoot(1 / (4 * kPi));
    for (int m = 0; m < kMaxShBands; ++m) {
      if (m > 0) q *= squareRoot((2 * m + 1.0) / (2 * m));
      start[m] = T(m > 0 ? squareRoot(2) * q : q);
      for (int l = m + 1; l < kMaxShBands; ++l) {
        const double ll = double(l) * l, mm = double(m) * m, kk = (l - 1.0) * (l - 1.0);
        const double a = squareRoot((4 * ll - 1) / (ll - mm));
        up[packed(l, m)] = T(a);
        back[packed(l, m)] = T(l > m + 1 ? a * squareRoot((kk - mm) / (4 * kk - 1)) : 0);
      }
    }
  }
};

// Named in full where it is used: GCC 12 with sanitizers crashes on a constexpr reference to it.
template <class T>
constexpr Recurrence<T> kRecurrence{};

// --- Kernels: V is a number or a vector of numbers of type T; emit(k, scale * Y_k) takes the results ---

template <int N, class F>
constexpr void unrolled(F&& body) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (body(std::integral_constant<int, I>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

/// All functions of one order; `cosine` and `sine` hold sin^m(theta) cos(m phi) and sin^m(theta) sin(m phi).
template <int N, int M, class T, class V, class Emit>
inline void evaluateOrder(V z, V cosine, V sine, Emit& emit) {
  constexpr T start = kRecurrence<T>.start[M];
  V q = V{} + start, before = V{};
  unrolled<N - M>([&](auto step) {
    constexpr int l = M + step;
    constexpr T up = kRecurrence<T>.up[packed(l, M)], back = kRecurrence<T>.back[packed(l, M)];
    if constexpr (l == M + 1) before = std::exchange(q, z * (up * start));
    if constexpr (l > M + 1) before = std::exchange(q, z * q * up - before * back);
    emit(shIndex(l, M), q * cosine);
    if constexpr (M > 0) emit(shIndex(l, -M), q * sine);
  });
}

/// Straight-line code for N bands: no loop, no branch, coefficients as constants.
template <int N, class T, class V, class Emit>
inline void evaluateFixed(V x, V y, V z, V scale, Emit emit) {
  V cosine = scale, sine = V{};
  unrolled<N>([&](auto order) {
    evaluateOrder<N, order, T>(z, cosine, sine, emit);
    const V c = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = c;
  });
}

/// Any number of bands.
template <class T, class V, class Emit>
inline void evaluateAny(int bands, V x, V y, V z, V scale, Emit emit) {
  V cosine = scale, sine = V{};
  for (int m = 0; m < bands; ++m) {
    V q = V{} + kRecurrence<T>.start[m], before = V{};
    for (int l = m;; before = std::exchange(q, z * q * kRecurrence<T>.up[packed(l, m)] -
                                                   before * kRecurrence<T>.back[packed(l, m)])) {
      emit(shIndex(l, m), q * cosine);
      if (m > 0) emit(shIndex(l, -m), q * sine);
      if (++l == bands) break;
    }
    const V c = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = c;
  }
}

template <class T, class V, class Emit>
inline void evaluate(int bands, V x, V y, V z, V scale, Emit emit) {
  switch (bands) {
    case 1:
      return evaluateFixed<1, T>(x, y, z, scale, emit);
    case 2:
      return evaluateFixed<2, T>(x, y, z, scale, emit);
    case 3:
      return evaluateFixed<3, T>(x, y, z, scale, emit);
    case 4:
      return evaluateFixed<4, T>(x, y, z, scale, emit);
    case 5:
      return evaluateFixed<5, T>(x, y, z, scale, emit);
    case 6:
      return evaluateFixed<6, T>(x, y, z, scale, emit);
    default:
      return evaluateAny<T>(bands, x, y, z, scale, emit);
  }
}

// --- Eight directions at a time ---------------------------------------------------------------------

constexpr int kLanes = 8;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;

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

/// Rows become columns.
void transpose(std::array<Lanes, kLanes>& r) {
  const auto swapOffDiagonal = [&](int distance, auto lowMask, auto highMask) {
    for (int i = 0; i < kLanes; ++i) {
      if (i & distance) continue;
      const Lanes a = r[i], b = r[i + distance];
      r[i] = __builtin_shuffle(a, b, lowMask);
      r[i + distance] = __builtin_shuffle(a, b, highMask);
    }
  };
  using Mask [[gnu::vector_size(4 * kLanes)]] = int;
  swapOffDiagonal(4, Mask{0, 1, 2, 3, 8, 9, 10, 11}, Mask{4, 5, 6, 7, 12, 13, 14, 15});
  swapOffDiagonal(2, Mask{0, 1, 8, 9, 4, 5, 12, 13}, Mask{2, 3, 10, 11, 6, 7, 14, 15});
  swapOffDiagonal(1, Mask{0, 8, 2, 10, 4, 12, 6, 14}, Mask{1, 9, 3, 11, 5, 13, 7, 15});
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
