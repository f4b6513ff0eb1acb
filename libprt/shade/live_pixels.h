#pragma once
// From light to the bytes on the screen, a tile at a time: what is behind the scene, the ground grid, and the
// sums of fragments' displayed colours. Internal to live renderers.

#include "libprt/shade/display_table.h"
#include "libprt/shade/ground_grid.h"
#include "libprt/shade/live_background.h"
#include "libprt/shade/raster.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace prt {

struct LiveScene;
struct LivePicture;

/// A rectangle of pixels that some renderer fills.
struct PixelTile {
  int x = 0, y = 0;  ///< first pixel
  int width = 0, height = 0;
  std::vector<float> open;  ///< [width * height] share of each pixel that shows the background
};

/// Sets the tile's place and open shares, and calls add(fragment, pixel, share) for every fragment of it.
template <class Add>
void coverTile(PixelTile& tile, const FragmentTile& seen, int grid, const Add& add) {
  tile.x = seen.x, tile.y = seen.y, tile.width = seen.width, tile.height = seen.height;
  const float part = 1.0f / float(grid * grid);
  tile.open.resize(std::size_t(seen.width) * std::size_t(seen.height));
  for (std::size_t p = 0; p < tile.open.size(); ++p) {
    float covered = 0;
    for (const Fragment& f : seen.pixel(p)) {
      const float share = float(f.samples) * part;
      covered += share;
      add(f, std::uint32_t(p), share);
    }
    tile.open[p] = covered < 1 - 0.5f * part ? 1 - covered : 0;
  }
}

/// Sums what the screen shows of a tile's pixels; values 0..255.
struct LiveSums {
  std::vector<Vec4> values;  ///< w unused: four floats add at once

  void add(std::size_t pixel, float share, const Rgb& radiance, const DisplayTable& display) {
    values[pixel] +=
        share * Vec4(float(display(radiance.x)), float(display(radiance.y)), float(display(radiance.z)), 0);
  }
};

class LivePixels {
 public:
  /// All must outlive it.
  LivePixels(const LiveScene& scene, const LivePicture& picture, const DisplayTable& display);

  /// Sums of a tile with the background in its open shares.
  void begin(const PixelTile& tile, LiveSums& sums) const;
  /// Bytes 0xffRRGGBB to their places in the whole picture.
  void write(const PixelTile& tile, const LiveSums& sums, std::span<std::uint32_t> pixels) const;

 private:
  void addBackground(const PixelTile& tile, LiveSums& sums) const;
  void addPlain(const PixelTile& tile, LiveSums& sums) const;
  void addGrid(const PixelTile& tile, LiveSums& sums) const;

  const LivePicture& picture_;
  const DisplayTable& display_;
  std::optional<LiveBackground> background_;
  GridRays gridRays_;
};

}  // namespace prt
