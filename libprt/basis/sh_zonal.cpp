#include "libprt/basis/sh_zonal.h"

#include "libprt/basis/legendre.h"
#include "libprt/core/error.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace prt {
namespace {

void requireBands(int bands) {
  if (bands >= 1 && bands <= kMaxShBands) return;
  throw ValueError("cannot use " + std::to_string(bands) + " bands", "zonal functions",
                   "use 1 to " + std::to_string(kMaxShBands));
}

double zonalNorm(std::size_t l) {
  return std::sqrt((2 * double(l) + 1) / (4 * kPi));
}

template <class T>
void scale(std::span<const double> factors, int bands, std::span<T> c) {
  requireBands(bands);
  if (c.size() < std::size_t(shCount(bands)))
    throw std::length_error("scaling of bands: a coefficient span is too short");
  for (int l = 0; l < bands; ++l) {
    const double factor = std::size_t(l) < factors.size() ? factors[l] : 0;
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
      if constexpr (std::is_same_v<T, Rgb>)
        c[k] *= float(factor);
      else
        c[k] = T(c[k] * factor);
    }
  }
}

}  // namespace

std::vector<double> clampedCosineFactors(int bands) {
  return phongFactors(bands, 1);
}

std::vector<double> phongFactors(int bands, double exponent) {
  requireBands(bands);
  if (!(exponent >= 0) || !std::isfinite(exponent))
    throw ValueError("the exponent must be at least 0", "Phong lobe", "use 1 to 10000");
  std::vector<double> k(bands);
  for (int l = 0; l < bands; ++l) {
    if (l < 2)
      k[l] = 2 * kPi / (exponent + 1 + l);
    else
      k[l] = k[l - 2] * (exponent - l + 2) / (exponent + l + 1);
  }
  return k;
}

std::vector<double> capZonal(int bands, double halfAngle) {
  requireBands(bands);
  if (!(halfAngle >= 0 && halfAngle <= kPi))
    throw ValueError("the half-angle must be 0 to 180 degrees", "circle light", "");
  // The integral of P_l over the cap, (P_{l-1} - P_{l+1}) / (2l+1), cancels for small caps. It equals
  // sin^2 P_l' / (l(l+1)), which does not.
  const double half = std::sin(0.5 * halfAngle), sine = std::sin(halfAngle);
  const LegendreTable legendre(bands, std::cos(halfAngle));
  std::vector<double> z(bands);
  for (int l = 0; l < bands; ++l) {
    const double integral = l == 0 ? 2 * half * half : sine * sine * legendre.slope[l] / (l * (l + 1.0));
    z[l] = 2 * kPi * zonalNorm(std::size_t(l)) * integral;
  }
  return z;
}

std::vector<double> rotateZonal(std::span<const double> zonal, const DVec3& d) {
  const int bands = int(zonal.size());
  requireBands(bands);
  std::vector<double> c(shCount(bands));
  shEvaluate(bands, d, std::span(c));
  scaleBands(factorsFromZonal(zonal), bands, std::span(c));
  return c;
}

std::vector<double> factorsFromZonal(std::span<const double> zonal) {
  std::vector<double> factors(zonal.begin(), zonal.end());
  for (std::size_t l = 0; l < factors.size(); ++l) factors[l] /= zonalNorm(l);
  return factors;
}

std::vector<double> zonalFromFactors(std::span<const double> factors) {
  std::vector<double> zonal(factors.begin(), factors.end());
  for (std::size_t l = 0; l < zonal.size(); ++l) zonal[l] *= zonalNorm(l);
  return zonal;
}

void scaleBands(std::span<const double> factors, ShRgb& light) {
  scale(factors, light.bands, std::span(light.c));
}
void scaleBands(std::span<const double> factors, int bands, std::span<float> c) {
  scale(factors, bands, c);
}
void scaleBands(std::span<const double> factors, int bands, std::span<double> c) {
  scale(factors, bands, c);
}

}  // namespace prt
