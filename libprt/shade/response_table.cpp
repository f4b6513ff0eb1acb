#include "libprt/shade/response_table.h"

#include "libprt/core/half.h"

#include <algorithm>
#include <cmath>

namespace prt {

ResponseTable::ResponseTable(const Rtt& rtt)
    : texels_(rtt.texels),
      layers_(rtt.layers),
      bands_(rtt.bands),
      channels_(rtt.channels),
      views_(rtt.views),
      colour_(rtt.colour),
      padded_((std::size_t(rtt.functions()) + 7) / 8 * 8) {
  constexpr std::size_t kLine = 64 / sizeof(std::uint16_t);
  const std::size_t blocks = std::size_t(layers_) * texelCount() * std::size_t(views_.count());
  halfs_.assign(blocks * blockSize() + kLine, 0);
  const auto address = reinterpret_cast<std::uintptr_t>(halfs_.data()) / sizeof(std::uint16_t);
  std::uint16_t* to = halfs_.data() + (kLine - address % kLine) % kLine;
  first_ = to;
  const auto channels = std::size_t(channels_), functions = std::size_t(rtt.functions());
  for (std::size_t b = 0; b < blocks; ++b, to += blockSize())
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t k = 0; k < functions; ++k)
        to[c * padded_ + k] =
            toHalf(std::clamp(rtt.values[(b * functions + k) * channels + c], -kLargestHalf, kLargestHalf));
}

std::uint32_t ResponseTable::texelAt(const Vec2& uv) const {
  const auto cell = [n = texels_](float x) { return std::min(int((x - std::floor(x)) * float(n)), n - 1); };
  return std::uint32_t(cell(uv.y) * texels_ + cell(uv.x));
}

}  // namespace prt
