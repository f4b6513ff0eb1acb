#include "libprt/shade/live_renderer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/ground_grid.h"
#include "libprt/shade/live_background.h"
#include "libprt/shade/surface_light.h"

#include <algorithm>

namespace prt {
namespace {

/// Sums what the screen shows of a tile's pixels; values 0..255.
struct Sums {
  std::vector<Vec4> values;  // w unused: four floats add at once

  void add(std::size_t pixel, float share, const Rgb& radiance, const DisplayTable& display) {
    values[pixel] +=
        share * Vec4(float(display(radiance.x)), float(display(radiance.y)), float(display(radiance.z)), 0);
  }
};

void addFragments(const LiveTile& tile, const LiveLight& light, const LiveMaterials& materials,
                  const DisplayTable& display, Sums& sums) {
  std::array<Rgb, kLiveLanes> radiance;
  for (std::size_t first = 0; first < tile.count; first += kLiveLanes) {
    shadeLive(tile, first, light, materials, radiance);
    const std::size_t lanes = std::min(kLiveLanes, tile.count - first);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      sums.add(tile.pixel[first + lane], tile.share[first + lane], radiance[lane], display);
  }
}

/// Runs of open pixels of each row.
void addBackground(const LiveTile& tile, const LiveBackground& background, const DisplayTable& display,
                   Sums& sums) {
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
      background.row(tile.x + x, tile.y + y, std::span(row).first(std::size_t(end - x)));
      for (int i = x; i < end; ++i)
        sums.add(start + std::size_t(i), tile.open[start + std::size_t(i)], row[std::size_t(i - x)], display);
      x = end;
    }
  }
}

void addPlain(const LiveTile& tile, const Rgb& behind, Sums& sums) {
  for (std::size_t i = 0; i < tile.open.size(); ++i)
    sums.values[i] += tile.open[i] * Vec4(255.0f * behind, 0);
}

/// The part of each pixel that shows the background is replaced by the same with the grid. For that the
/// background comes first, and fragments are added to it afterwards.
void addGrid(const LiveTile& tile, const GridRays& rays, bool parallel, float spacing, Sums& sums) {
  for (std::size_t i = 0; i < tile.open.size(); ++i) {
    if (tile.open[i] == 0) continue;
    const int x = int(i) % tile.width, y = int(i) / tile.width;
    const Rgb behind = Rgb(sums.values[i]) / (255 * tile.open[i]);
    sums.values[i] = Vec4(
        255 * tile.open[i] *
            withGrid(rays, parallel, spacing, float(tile.x + x) + 0.5f, float(tile.y + y) + 0.5f, behind),
        0);
  }
}

void write(const LiveTile& tile, const Sums& sums, int width, std::span<std::uint32_t> pixels) {
  for (int y = 0; y < tile.height; ++y) {
    const Vec4* from = sums.values.data() + std::size_t(y) * std::size_t(tile.width);
    std::uint32_t* to = pixels.data() + std::size_t(tile.y + y) * std::size_t(width) + std::size_t(tile.x);
    for (int x = 0; x < tile.width; ++x) {
      const auto byte = [](float v) { return std::uint32_t(std::min(v, 255.0f) + 0.5f); };
      to[x] = 0xff000000u | byte(from[x].x) << 16 | byte(from[x].y) << 8 | byte(from[x].z);
    }
  }
}

/// A view of nothing but background.
LiveView emptyView(int width, int height) {
  constexpr int kRows = 32;
  LiveView view;
  for (int y = 0; y < height; y += kRows) {
    LiveTile& tile = view.tiles.emplace_back();
    tile.y = y, tile.width = width, tile.height = std::min(kRows, height - y);
    tile.open.assign(std::size_t(tile.width) * std::size_t(tile.height), 1.0f);
  }
  return view;
}

}  // namespace

void LiveRenderer::followView(const LiveScene& scene, const LivePicture& picture, Job& job) {
  ViewKey key{scene.scene, scene.samples, {}, picture.camera, picture.width, picture.height, picture.grid};
  for (const Material& m : scene.materials) key.twoSided.push_back(m.twoSided);
  if (viewKey_ == key) return;
  viewKey_.reset();
  ++viewNumber_;
  if (!scene.scene) {
    view_ = emptyView(picture.width, picture.height);
  } else {
    if (scene.materials.size() != scene.scene->materials.size())
      throw ValueError("not as many materials as objects", "renderer", "give one for each object");
    const std::span<const std::uint32_t> back = scene.samples
                                                    ? std::span<const std::uint32_t>(scene.samples->back)
                                                    : std::span<const std::uint32_t>();
    view_ = makeLiveView(*scene.scene, back, key.twoSided, picture.camera, picture.width, picture.height,
                         picture.grid, job);
  }
  viewKey_ = std::move(key);
}

void LiveRenderer::followLight(const LiveScene& scene, Job& job) {
  const bool baked = scene.transfer && scene.samples;
  LightKey key{baked ? scene.transfer : nullptr, scene.light.c, viewNumber_};
  if (lightKey_ == key) return;
  lightKey_.reset();
  Transfer unshadowed;
  unshadowed.bands = scene.light.bands;
  const Transfer& transfer = baked ? *scene.transfer : unshadowed;
  if (baked && transfer.form != TransferForm::None &&
      (transfer.samples != scene.samples->size() ||
       (!view_.samples.empty() && view_.samples.back() >= transfer.samples)))
    throw ValueError("transfer was baked for another scene", "renderer", "bake the scene again");
  const SampleSet none;
  light_ = LiveLight(surfaceLight(transfer, scene.light, baked ? *scene.samples : none, view_.samples), job);
  lightKey_ = std::move(key);
}

void LiveRenderer::draw(const LiveScene& scene, const LivePicture& picture, std::span<std::uint32_t> pixels,
                        Job& job) {
  if (pixels.size() != std::size_t(picture.width) * std::size_t(picture.height))
    throw ValueError("the picture's memory has another size than the picture", "renderer", {});
  followView(scene, picture, job);
  if (scene.scene) {
    followLight(scene, job);
    materials_.set(scene.materials, light_.bands(), light_.form() != TransferForm::Diffuse);
  }
  if (!display_ || display_->tone().exposure != picture.tone.exposure ||
      display_->tone().curve != picture.tone.curve)
    display_.emplace(picture.tone);

  std::optional<LiveBackground> background;
  if (scene.environment || !scene.circles.empty() || scene.constant != Rgb(0))
    background.emplace(LiveSky{scene.environment.get(), scene.environmentRotation, scene.environmentIntensity,
                               scene.circles, scene.constant},
                       picture.camera, picture.width, picture.height);
  const GridRays gridRays(picture.camera, picture.width, picture.height);
  parallelFor(job, 0, view_.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    const LiveTile& tile = view_.tiles[t];
    thread_local Sums sums;
    sums.values.assign(tile.open.size(), Vec4(0));
    if (background)
      addBackground(tile, *background, *display_, sums);
    else
      addPlain(tile, picture.behind, sums);
    if (picture.gridSpacing > 0)
      addGrid(tile, gridRays, picture.camera.orthographic, picture.gridSpacing, sums);
    addFragments(tile, light_, materials_, *display_, sums);
    write(tile, sums, picture.width, pixels);
  });
}

}  // namespace prt
