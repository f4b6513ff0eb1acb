#include "libprt/shade/display_table.h"

#include <cmath>

namespace prt {

DisplayTable::DisplayTable(const ToneSettings& tone) : tone_(tone), gain_(std::exp2(tone.exposure)) {
  table_.resize(kLast - kFirst);
  const ToneSettings curve{.exposure = 0, .curve = tone.curve};
  for (std::uint32_t i = 0; i < kLast - kFirst; ++i) {
    const float middle = std::bit_cast<float>(((i + kFirst) << kDropped) | (1u << (kDropped - 1)));
    table_[i] = std::uint8_t(std::lround(255 * toDisplay(Rgb(middle), curve).x));
  }
}

}  // namespace prt
