#pragma once
// Perceptual false colour for magnitudes.

#include "libprt/core/math.h"

#include <span>

namespace prt {

/// Colours of a scale from 0 to 1: dark violet over teal to bright yellow, on a path through OkLab (Ottosson
/// 2020, "A perceptual color space for image processing") along which lightness rises evenly, so that equal
/// steps look equal and a grey print keeps the order. Display-encoded sRGB.
std::span<const Rgb> magnitudeColors();

/// The colour of one value, interpolated; values beyond the scale take its ends. A value that is NaN or below
/// 0 stands for "not known": neutral grey.
Rgb magnitudeColor(float value);

inline constexpr Rgb kUnknownColor{0.42f, 0.42f, 0.42f};

}  // namespace prt
