#include "libprt/shade/live_renderer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/live_pixels.h"
#include "libprt/shade/surface_light.h"

#include <algorithm>

namespace prt {
namespace {

void addFragments(const LiveTile& tile, int around, const LiveLight& light, const LiveMaterials& materials,
                  const DisplayTable& display, LiveSums& sums) {
  std::array<Rgb, kLiveLanes> radiance;
  for (std::size_t first = 0; first < tile.count; first += kLiveLanes) {
    shadeLive(tile, around, first, light, materials, radiance);
    const std::size_t lanes = std::min(kLiveLanes, tile.count - first);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      sums.add(tile.pixel[first + lane], tile.share[first + lane], radiance[lane], display);
  }
}

void addFragments(const BiscaleTile& tile, const BiscaleLight& light, const BiscaleSurface& surface,
                  const DisplayTable& display, LiveSums& sums) {
  for (const BiscaleFragment& f : tile.fragments)
    sums.add(f.pixel, f.share, shadeBiscale(tile, f, light, surface), display);
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
  ViewKey key{scene.scene,    scene.samples, {},          picture.camera,      picture.width,
              picture.height, picture.grid,  scene.patch, scene.viewDependent, scene.surroundings.scene};
  for (const Material& m : scene.materials) key.twoSided.push_back(m.twoSided);
  if (viewKey_ == key) return;
  viewKey_.reset();
  ++viewNumber_;
  patchView_ = {};
  const Occluder occluder = occluderOf(&scene.surroundings);
  if (scene.scene && scene.patch) {
    patchView_ = makeBiscaleView(*scene.patch, picture.camera, picture.width, picture.height,
                                 {picture.grid, scene.viewDependent, occluder}, job);
  } else if (!scene.scene) {
    view_ = emptyView(picture.width, picture.height);
  } else {
    if (scene.materials.size() != scene.scene->materials.size())
      throw ValueError("not as many materials as objects", "renderer", "give one for each object");
    if (scene.samples && scene.samples->texels &&
        scene.samples->texels->triangles.size() != scene.scene->mesh.triangleCount())
      throw ValueError("transfer was baked for another scene", "renderer", "bake the scene again");
    view_ = makeLiveView(*scene.scene, scene.samples.get(), key.twoSided, picture.camera, picture.width,
                         picture.height, picture.grid, job, occluder);
  }
  viewAround(scene, picture, job);
  viewKey_ = std::move(key);
}

/// What is seen of the surroundings; the model's tiles are open where neither is seen.
void LiveRenderer::viewAround(const LiveScene& scene, const LivePicture& picture, Job& job) {
  around_ = {};
  if (!scene.scene || scene.surroundings.empty()) return;
  const Scene& others = *scene.surroundings.scene;
  std::vector<bool> twoSided;
  for (const Material& m : others.materials) twoSided.push_back(m.twoSided);
  around_ = makeLiveView(others, scene.surroundings.samples.get(), twoSided, picture.camera, picture.width,
                         picture.height, picture.grid, job, {&scene.scene->mesh, true});
  const auto close = [&](auto& tiles) {
    for (std::size_t t = 0; t < tiles.size(); ++t)
      for (std::size_t p = 0; p < tiles[t].open.size(); ++p) {
        const float open = tiles[t].open[p] + around_.tiles[t].open[p] - 1;
        tiles[t].open[p] = open > 1e-4f ? open : 0;  // less than any sample
      }
  };
  scene.patch ? close(patchView_.tiles) : close(view_.tiles);
}

void LiveRenderer::lightAround(const LiveScene& scene, Job& job) {
  if (around_.tiles.empty()) return;
  const Surroundings& around = scene.surroundings;
  Transfer unshadowed;
  unshadowed.bands = around.light.bands;
  aroundLight_ = LiveLight(surfaceLight(unshadowed, around.light, *around.samples, around_.samples), job);
  aroundMaterials_.set(around.scene->materials, around.light.bands, true, around.emission);
}

void LiveRenderer::followLight(const LiveScene& scene, Job& job) {
  const bool baked = scene.transfer && scene.samples;
  LightKey key{baked ? scene.transfer : nullptr, scene.light.c, viewNumber_};
  if (lightKey_ == key) return;
  lightKey_.reset();
  Transfer unshadowed;
  unshadowed.bands = scene.light.bands;
  const SampleSet none;
  const Transfer& transfer = baked ? *scene.transfer : unshadowed;
  const SampleSet& samples = baked ? *scene.samples : none;
  if (scene.patch) {
    patchLight_ = BiscaleLight(*scene.patch, patchView_.frames, samples, transfer, scene.light, job);
  } else {
    if (transfer.form != TransferForm::None &&
        (transfer.samples != samples.size() ||
         (!view_.samples.empty() && view_.samples.back() >= transfer.samples)))
      throw ValueError("transfer was baked for another scene", "renderer", "bake the scene again");
    light_ = LiveLight(surfaceLight(transfer, scene.light, samples, view_.samples), job);
  }
  lightKey_ = std::move(key);
}

void LiveRenderer::draw(const LiveScene& scene, const LivePicture& picture, std::span<std::uint32_t> pixels,
                        Job& job) {
  if (pixels.size() != std::size_t(picture.width) * std::size_t(picture.height))
    throw ValueError("the picture's memory has another size than the picture", "renderer", {});
  followView(scene, picture, job);
  const bool patch = scene.scene && scene.patch;
  if (scene.scene) followLight(scene, job);
  lightAround(scene, job);
  if (scene.scene && !patch)
    materials_.set(scene.materials, light_.bands(), light_.form() != TransferForm::Diffuse);
  if (!display_ || display_->tone().exposure != picture.tone.exposure ||
      display_->tone().curve != picture.tone.curve)
    display_.emplace(picture.tone);

  const LivePixels shown(scene, picture, *display_);
  const auto drawTiles = [&](const auto& tiles, const auto& add) {
    parallelFor(job, 0, tiles.size(), 1, [&](std::size_t t, std::size_t) {
      thread_local LiveSums sums;
      shown.begin(tiles[t], sums);
      add(tiles[t], sums);
      if (!around_.tiles.empty())
        addFragments(around_.tiles[t], around_.around, aroundLight_, aroundMaterials_, *display_, sums);
      shown.write(tiles[t], sums, pixels);
    });
  };
  if (patch)
    drawTiles(patchView_.tiles, [&](const BiscaleTile& tile, LiveSums& sums) {
      addFragments(tile, patchLight_, *scene.patch, *display_, sums);
    });
  else
    drawTiles(view_.tiles, [&](const LiveTile& tile, LiveSums& sums) {
      addFragments(tile, view_.around, light_, materials_, *display_, sums);
    });
}

}  // namespace prt
