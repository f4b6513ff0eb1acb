#pragma once
// Zonal functions - those that depend on the angle to one axis only - and convolution with them.
// Two descriptions, both with one number per band:
// - zonal coefficients z_l: the coefficients (order 0) of the function about +z;
// - band factors k_l = 2 pi * integral over t in [-1,1] of k(t) P_l(t): what convolution multiplies band l
// by;
//   k_0 is the integral of the kernel. z_l = sqrt((2l+1) / 4pi) k_l.
// Sources: Ramamoorthi and Hanrahan 2001 (clamped cosine, Phong), Sloan 2008, "Stupid SH Tricks".

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"

#include <span>
#include <vector>

namespace prt {

/// Band factors of the clamped cosine max(0, t): pi, 2pi/3, pi/4, 0, -pi/24, 0, pi/64 ... They turn incident
/// radiance into irradiance.
std::vector<double> clampedCosineFactors(int bands);

/// Band factors of the lobe max(0, t)^exponent, not normalised: multiply by (exponent + 1) / 2pi for a lobe
/// of integral 1, by (exponent + 2) / 2pi for normalised Phong. Any real exponent >= 0 (ValueError).
std::vector<double> phongFactors(int bands, double exponent);

/// Zonal coefficients of a spherical cap about +z, radiance 1, half-angle 0 .. pi (ValueError). Accurate to
/// rounding for every size: the sun's disc, and smaller.
std::vector<double> capZonal(int bands, double halfAngle);

/// Coefficients of a zonal function (zonal coefficients `zonal`, one per band) about the unit axis `d`.
std::vector<double> rotateZonal(std::span<const double> zonal, const DVec3& d);

std::vector<double> factorsFromZonal(std::span<const double> zonal);
std::vector<double> zonalFromFactors(std::span<const double> factors);

/// Multiplies each band by its factor, in place: convolution with a kernel, or a window. Bands beyond the
/// factors become zero.
void scaleBands(std::span<const double> factors, ShRgb& light);
void scaleBands(std::span<const double> factors, int bands, std::span<float> coefficients);
void scaleBands(std::span<const double> factors, int bands, std::span<double> coefficients);

}  // namespace prt
