#pragma once
// Real spherical harmonics: orthonormal over the sphere, index l(l+1)+m, no Condon-Shortley sign, so
// Y(1,-1..1) = sqrt(3/4pi) (y, z, x). "n bands" means l = 0..n-1, n*n functions; the papers' "order 5"
// is 5 bands, 25 functions. Evaluation: normalised recurrences with sin^m(theta) factored out, no
// trigonometry and no poles (ALGORITHMS notes; Sloan 2013, "Efficient Spherical Harmonic Evaluation").

#include "libprt/core/math.h"

#include <cstddef>
#include <span>
#include <vector>

namespace prt {

/// Most bands that any function here accepts.
inline constexpr int kMaxShBands = 65;

constexpr int shCount(int bands) {
  return bands * bands;
}
constexpr int shIndex(int l, int m) {
  return l * (l + 1) + m;
}

/// Values of all bands*bands functions in unit direction `d`. out.size() >= shCount(bands).
/// Float error below 1e-6 for 5 bands and 1e-5 for 17; use the double version above that. No branches up
/// to 6 bands. Throws ValueError unless bands is 1..kMaxShBands.
void shEvaluate(int bands, const Vec3& d, std::span<float> out);
void shEvaluate(int bands, const DVec3& d, std::span<double> out);

/// The same for many directions given as separate coordinates (SIMD inside).
/// out[i * shCount(bands) + k] = Y_k(direction i).
void shEvaluateBatch(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                     std::span<float> out);

/// Projection sum, SIMD inside: sum[k] += sum over i of weights[i] * Y_k(direction i). The order of
/// summation is fixed by the order of the directions. Keep calls to a few thousand directions and add
/// the results in double when there are more: the sums inside are float.
void shAccumulate(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                  std::span<const float> weights, std::span<float> sum);

/// Coefficients of a colour-valued function on the sphere; c[k] belongs to Y_k, size shCount(bands).
struct ShRgb {
  int bands = 0;
  std::vector<Rgb> c;

  ShRgb() = default;
  explicit ShRgb(int n) : bands(n), c(std::size_t(shCount(n)), Rgb(0)) {}
  /// Value in unit direction `d`.
  Rgb evaluate(const Vec3& d) const;
};

}  // namespace prt
