#include "libprt/shade/live_view.h"

#include "libprt/core/parallel.h"

#include <atomic>

namespace prt {
namespace {

struct Maker {
  const Scene& scene;
  const SampleSet& surface;
  const std::vector<bool>& twoSided;
  const Camera& camera;
  Vec3 parallelView;
  std::vector<std::uint8_t> used;  // [S]

  void add(const Fragment& f, std::uint32_t pixel, float share, LiveTile& tile) {
    if (f.back && !twoSided[scene.triangleObject[f.triangle]]) return;
    SamplePlace place;
    if (!surface.at(scene.mesh, f.triangle, f.barycentric, f.back, place)) return;
    for (const std::uint32_t s : place.sample) std::atomic_ref(used[s]).store(1, std::memory_order_relaxed);
    const UVec3& t = scene.mesh.triangles[f.triangle];
    const Vec3 w(1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y);
    const auto mean = [&](const std::vector<Vec3>& values) {
      return w.x * values[t.x] + w.y * values[t.y] + w.z * values[t.z];
    };
    tile.pixel.push_back(pixel);
    tile.share.push_back(share);
    tile.object.push_back(scene.triangleObject[f.triangle]);
    tile.slot.push_back(place.sample);
    tile.weight.push_back(place.weight);
    const Vec3 normal = normalOf(f, mean(scene.mesh.normals));
    const Vec3 view = camera.orthographic ? parallelView : camera.towardsViewer(mean(scene.mesh.positions));
    for (std::size_t i = 0; i < 3; ++i) {
      tile.normal[i].push_back(normal[int(i)]);
      tile.view[i].push_back(view[int(i)]);
    }
  }

  /// As the renderer in render.h: the face's own normal where the shading normals cancel.
  Vec3 normalOf(const Fragment& f, const Vec3& smooth) const {
    const float side = f.back ? -1.0f : 1.0f, size = length(smooth);
    if (size > 1e-6f) return side / size * smooth;
    const Vec3 face = scene.mesh.areaNormal(f.triangle);
    return side * (length(face) > 0 ? normalize(face) : Vec3(0, 0, 1));
  }

  void fill(const FragmentTile& seen, int grid, LiveTile& tile) {
    reserve(tile, seen.fragments.size() + kLiveLanes);
    coverTile(tile, seen, grid,
              [&](const Fragment& f, std::uint32_t pixel, float share) { add(f, pixel, share, tile); });
    tile.count = tile.pixel.size();
    while (tile.pixel.size() % kLiveLanes != 0) repeatLast(tile);
  }

  template <class F>
  static void eachArray(LiveTile& tile, F&& f) {
    f(tile.pixel), f(tile.share), f(tile.object), f(tile.slot), f(tile.weight);
    for (std::size_t i = 0; i < 3; ++i) f(tile.normal[i]), f(tile.view[i]);
  }
  static void reserve(LiveTile& tile, std::size_t count) {
    eachArray(tile, [count](auto& values) { values.reserve(count); });
  }
  static void repeatLast(LiveTile& tile) {
    eachArray(tile, [](auto& values) { values.push_back(values.back()); });
    tile.share.back() = 0;
  }
};

}  // namespace

LiveView makeLiveView(const Scene& scene, const SampleSet* covering, const std::vector<bool>& twoSided,
                      const Camera& camera, int width, int height, int grid, Job& job,
                      const Occluder& occluder) {
  const SampleSet none;
  const SampleSet& surface = covering ? *covering : none;
  std::size_t sampleCount = surface.texels ? surface.texels->count : scene.mesh.vertexCount();
  for (const std::uint32_t s : surface.back)
    if (s != kNone) sampleCount = std::max(sampleCount, std::size_t(s) + 1);
  Maker maker{
      scene, surface, twoSided, camera, camera.axes().normal, std::vector<std::uint8_t>(sampleCount, 0)};

  const Rasterizer rasterizer(scene.mesh, camera, width, height, grid, job, occluder);
  LiveView view;
  view.around = surface.around();
  view.tiles.resize(rasterizer.tileCount());
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    thread_local SampleTile samples;
    thread_local FragmentTile fragments;
    rasterizer.drawFragments(t, samples, fragments);
    maker.fill(fragments, grid, view.tiles[t]);
  });

  // Samples that are seen get consecutive places.
  std::vector<std::uint32_t> slot(sampleCount, 0);
  for (std::size_t s = 0; s < sampleCount; ++s) {
    if (!maker.used[s]) continue;
    slot[s] = std::uint32_t(view.samples.size());
    view.samples.push_back(std::uint32_t(s));
  }
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    for (auto& corners : view.tiles[t].slot)
      for (std::uint32_t& corner : corners) corner = slot[corner];
  });
  return view;
}

}  // namespace prt
