#pragma once
// Spherical harmonics as code to be inlined: for sh.cpp, and for loops of other folders that need eight
// directions at a time in registers. Sources that include it are compiled with -Wno-psabi (vectors as
// arguments of inlined functions).

#include "libprt/basis/sh.h"

#include <array>
#include <cstring>
#include <utility>

namespace prt::sh_kernel {

// --- Coefficients of the recurrences, made by the compiler ---------------------------------------

constexpr double squareRoot(double x) {
  double root = x > 1 ? x : 1;
  for (double last = 0; root != last && root * root > x;) {
    last = root;
    root = 0.5 * (root + x / root);
  }
  return root;
}

inline constexpr int kRows = kMaxShBands * (kMaxShBands + 1) / 2;
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
inline constexpr Recurrence<T> kRecurrence{};

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

inline constexpr int kLanes = 8;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;

inline Lanes load(const float* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store(const Lanes& v, float* to) {
  std::memcpy(to, &v, sizeof v);
}
/// In an order of its own: pairs, then pairs of these.
inline float sum(const Lanes& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Rows become columns.
inline void transpose(std::array<Lanes, kLanes>& r) {
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

}  // namespace prt::sh_kernel
