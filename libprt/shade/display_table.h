#pragma once
// toDisplay() for pictures that change many times a second: eight-bit values read from a table.

#include "libprt/shade/tonemap.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace prt {

/// Rows of ten mantissa bits: neighbours differ by a thousandth, a tenth of a step on the screen.
class DisplayTable {
 public:
  explicit DisplayTable(const ToneSettings& tone);

  const ToneSettings& tone() const { return tone_; }

  /// 255 * toDisplay(radiance), rounded, within 0.6; 0 for negative values and NaN.
  std::uint8_t operator()(float radiance) const {
    const float x = radiance * gain_;
    if (!(x >= kLow)) return 0;
    if (x >= kHigh) return 255;
    return table_[(std::bit_cast<std::uint32_t>(x) >> kDropped) - kFirst];
  }

 private:
  static constexpr int kDropped = 13;                      // of 23 mantissa bits
  static constexpr float kLow = 0x1p-14f, kHigh = 0x1p8f;  // less is black, more is white, with either curve
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kLow) >> kDropped,
                                 kLast = std::bit_cast<std::uint32_t>(kHigh) >> kDropped;

  ToneSettings tone_;
  float gain_ = 1;
  std::vector<std::uint8_t> table_;
};

}  // namespace prt
