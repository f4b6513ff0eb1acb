#pragma once
// 16-bit floats (IEEE binary16): a storage type. 11 significant bits, relative error up to 2^-11; largest
// value 65504. Conversion rounds to nearest even; what is larger becomes infinite, so clamp before if that
// can happen. Hardware conversion where the build's CPU has it.

#include <cstdint>
#include <span>

namespace prt {

inline constexpr float kLargestHalf = 65504.0f;

std::uint16_t toHalf(float value);
float fromHalf(std::uint16_t bits);

/// The same for arrays of equal size (std::length_error otherwise).
void toHalf(std::span<const float> values, std::span<std::uint16_t> bits);
void fromHalf(std::span<const std::uint16_t> bits, std::span<float> values);

}  // namespace prt
