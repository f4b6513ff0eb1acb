#pragma once
// Gradient noise for generated shapes.

#include "libprt/core/math.h"

#include <cstdint>

namespace prt {

/// Smooth lattice noise (Perlin 2002's interpolant, gradients from an integer hash): zero at lattice
/// points, within -1..1, unit wavelength. The same seed gives the same noise on every machine.
float gradientNoise(const Vec3& p, std::uint32_t seed);

/// Sum of octaves of gradient noise, each of twice the frequency and half the height.
float fractalNoise(const Vec3& p, int octaves, std::uint32_t seed);

/// Octaves of 1 - |noise|, squared: sharp crests between rounded hollows, in 0..about 2.
float ridgedNoise(const Vec3& p, int octaves, std::uint32_t seed);

}  // namespace prt
