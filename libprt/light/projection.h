#pragma once
// Environment maps to spherical harmonics and back.

#include "libprt/basis/sh.h"
#include "libprt/core/job.h"
#include "libprt/light/environment.h"

#include <vector>

namespace prt {

/// Coefficients of the map, not turned, intensity 1. Integrates the piecewise-constant map itself: exact
/// texel solid angles, sums in double; lat-long maps in closed form along rows, and the functions are
/// integrated over texels wherever texels are not small against the shortest wave. The result does not
/// depend on the number of threads. Throws ValueError unless 1 <= bands <= kMaxShBands.
ShRgb projectEnvironment(const EnvironmentMap& map, int bands);
ShRgb projectEnvironment(const EnvironmentMap& map, int bands, Job& job);

/// How much of a light each band holds.
struct BandSpectrum {
  double energy = 0;          ///< integral of luminance squared over the sphere, all bands: of the map itself
  std::vector<double> power;  ///< [bands] sum over m of the squared luminance coefficients
  std::vector<double>
      truncation;  ///< [bands] relative L2 error of keeping bands 0..l: sqrt(energy beyond / energy)
};

/// Spectrum of a map's luminance for `bands` bands (l = 32 is 33 bands).
BandSpectrum bandSpectrum(const EnvironmentMap& map, const ShRgb& coefficients);

/// The light as a non-negative function of the same bands: convolved with the sharpest non-negative
/// kernel (Fejer window, see sh_window.h). What "band-limited light" means in tests.
ShRgb nonNegativeLight(const ShRgb& light);

/// A lat-long map whose pixels hold the mean of `light` over their texel, so that projecting the map
/// gives `light` back. Values below zero become 0, and the map's report counts those pixels; when the light
/// is non-negative that is rounding.
EnvironmentMap bandLimitedMap(const ShRgb& light, int width, int height);

}  // namespace prt
