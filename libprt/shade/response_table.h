#pragma once
// A radiance transfer texture as renderers read it: 16-bit floats, each texel's views together, each view a
// whole number of cache lines for up to 5 bands.

#include "libprt/meso/rtt.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

class ResponseTable {
 public:
  explicit ResponseTable(const Rtt& rtt);
  ResponseTable(const ResponseTable&) = delete;
  ResponseTable& operator=(const ResponseTable&) = delete;

  int texels() const { return texels_; }
  /// Patches; texel t of patch n is t + n * texelCount().
  int layers() const { return layers_; }
  std::uint32_t texelCount() const { return std::uint32_t(texels_ * texels_); }
  int bands() const { return bands_; }
  int channels() const { return channels_; }
  const ViewSquare& views() const { return views_; }
  /// Factor on what the table gives.
  const Rgb& colour() const { return colour_; }
  /// Functions of a channel and zeros up to a multiple of 8.
  std::size_t padded() const { return padded_; }
  /// The texel that patch coordinates fall into; any coordinates, they repeat.
  std::uint32_t texelAt(const Vec2& uv) const;
  /// [channels][padded] halfs of a texel and view.
  const std::uint16_t* block(std::uint32_t texel, std::uint32_t view) const {
    return first_ + (std::size_t(texel) * std::size_t(views_.count()) + view) * blockSize();
  }
  /// All blocks, [layers * texels * texels][views][channels][padded].
  std::span<const std::uint16_t> halfs() const {
    return {first_, std::size_t(layers_) * texelCount() * std::size_t(views_.count()) * blockSize()};
  }
  std::size_t blockSize() const { return std::size_t(channels_) * padded_; }

 private:
  int texels_, layers_, bands_, channels_;
  ViewSquare views_;
  Rgb colour_;
  std::size_t padded_;
  std::vector<std::uint16_t> halfs_;
  const std::uint16_t* first_;  // on a cache line
};

}  // namespace prt
