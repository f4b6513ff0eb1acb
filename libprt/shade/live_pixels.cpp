#include "libprt/shade/live_pixels.h"

#include "libprt/shade/live_renderer.h"

#include <algorithm>

namespace prt {

LivePixels::LivePixels(const LiveScene& scene, const LivePicture& picture, const DisplayTable& display)
    : picture_(picture), display_(display), gridRays_(picture.camera, picture.width, picture.height) {
  if (scene.environment || !scene.circles.empty() || scene.constant != Rgb(0))
    background_.emplace(LiveSky{scene.environment.get(), scene.environmentRotation,
                                scene.environmentIntensity, scene.circles, scene.constant},
                        picture.camera, picture.width, picture.height);
}

void LivePixels::begin(const PixelTile& tile, LiveSums& sums) const {
  sums.values.assign(tile.open.size(), Vec4(0));
  if (background_)
    addBackground(tile, sums);
  else
    addPlain(tile, sums);
  if (picture_.gridSpacing > 0) addGrid(tile, sums);
}

/// Runs of open pixels of each row.
void LivePixels::addBackground(const PixelTile& tile, LiveSums& sums) const {
  std::vector<Rgb> row(std::size_t(tile.width));
  for (int y = 0; y < tile.height; ++y) {
    const std::size_t start = std::size_t(y) * std::size_t(tile.width);
    for (int x = 0; x < tile.width;) {
      if (tile.open[start + std::size_t(x)] == 0) {
        ++x;
        continue;
      }
      int end = x;
      while (end < tile.width && tile.open[start + std::size_t(end)] > 0) ++end;
      background_->row(tile.x + x, tile.y + y, std::span(row).first(std::size_t(end - x)));
      for (int i = x; i < end; ++i)
        sums.add(start + std::size_t(i), tile.open[start + std::size_t(i)], row[std::size_t(i - x)],
                 display_);
      x = end;
    }
  }
}

void LivePixels::addPlain(const PixelTile& tile, LiveSums& sums) const {
  for (std::size_t i = 0; i < tile.open.size(); ++i)
    sums.values[i] += tile.open[i] * Vec4(255.0f * picture_.behind, 0);
}

/// The part of each pixel that shows the background is replaced by the same with the grid. For that the
/// background comes first, and fragments are added to it afterwards.
void LivePixels::addGrid(const PixelTile& tile, LiveSums& sums) const {
  for (std::size_t i = 0; i < tile.open.size(); ++i) {
    if (tile.open[i] == 0) continue;
    const int x = int(i) % tile.width, y = int(i) / tile.width;
    const Rgb behind = Rgb(sums.values[i]) / (255 * tile.open[i]);
    sums.values[i] = Vec4(255 * tile.open[i] *
                              withGrid(gridRays_, picture_.camera.orthographic, picture_.gridSpacing,
                                       float(tile.x + x) + 0.5f, float(tile.y + y) + 0.5f, behind),
                          0);
  }
}

void LivePixels::write(const PixelTile& tile, const LiveSums& sums, std::span<std::uint32_t> pixels) const {
  for (int y = 0; y < tile.height; ++y) {
    const Vec4* from = sums.values.data() + std::size_t(y) * std::size_t(tile.width);
    std::uint32_t* to =
        pixels.data() + std::size_t(tile.y + y) * std::size_t(picture_.width) + std::size_t(tile.x);
    for (int x = 0; x < tile.width; ++x) {
      const auto byte = [](float v) { return std::uint32_t(std::min(v, 255.0f) + 0.5f); };
      to[x] = 0xff000000u | byte(from[x].x) << 16 | byte(from[x].y) << 8 | byte(from[x].z);
    }
  }
}

}  // namespace prt
