#pragma once
// A float image in memory. Rows from the top, pixels from the left, channels interleaved; the centre
// of pixel (x, y) is (x + 0.5, y + 0.5). Colours are linear Rec.709.

#include "libprt/core/math.h"

#include <cstddef>
#include <span>
#include <vector>

namespace prt {

struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> data;  ///< width * height * channels

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), data(std::size_t(w) * h * c, 0.0f) {}

  bool empty() const { return data.empty(); }
  std::size_t pixels() const { return std::size_t(width) * height; }
  float* pixel(int x, int y) { return data.data() + (std::size_t(y) * width + x) * channels; }
  const float* pixel(int x, int y) const { return data.data() + (std::size_t(y) * width + x) * channels; }
  /// First three channels of a pixel; a grey image gives grey.
  Rgb rgb(int x, int y) const {
    const float* p = pixel(x, y);
    return channels >= 3 ? Rgb(p[0], p[1], p[2]) : Rgb(p[0]);
  }
};

}  // namespace prt
