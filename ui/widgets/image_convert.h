#pragma once
// From the library's images to Qt's.

#include "libprt/core/image.h"
#include "libprt/shade/tonemap.h"

#include <QImage>

#include <algorithm>

namespace prt::ui {

/// An image that is encoded for the screen already, 0..1; a fourth channel is opacity, not multiplied in.
inline QImage toQImage(const Image& image) {
  const bool covers = image.channels == 4;
  QImage out(image.width, image.height, covers ? QImage::Format_ARGB32 : QImage::Format_RGB32);
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(out.scanLine(y));
    for (int x = 0; x < image.width; ++x) {
      const Rgb c = image.rgb(x, y);
      const int alpha = covers ? qRound(255 * image.pixel(x, y)[3]) : 255;
      row[x] = qRgba(qRound(255 * c.x), qRound(255 * c.y), qRound(255 * c.z), alpha);
    }
  }
  return out;
}

/// A picture of linear radiance as `tone` shows it; where it has a fourth channel, coverage that is
/// multiplied in, that becomes opacity.
inline QImage toQImage(Image image, const ToneSettings& tone) {
  const auto channels = std::size_t(image.channels);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    float* p = image.data.data() + channels * i;
    const float covered = channels == 4 ? std::max(p[3], 1e-6f) : 1;
    const Rgb c = toDisplay(Rgb(p[0], p[1], p[2]) / covered, tone);
    std::copy_n(&c.x, 3, p);
  }
  return toQImage(image);
}

}  // namespace prt::ui
