#include "libprt/shade/biscale_view.h"

#include "libprt/core/parallel.h"
#include "libprt/synthesis/orientation_field.h"
#include "libprt/synthesis/surface_point.h"

#include <atomic>

namespace prt {
namespace {

class Maker {
 public:
  Maker(const BiscaleSurface& surface, const Camera& camera, const BiscaleViewOptions& options)
      : surface_(surface),
        mesh_(surface.scene->mesh),
        camera_(camera),
        options_(options),
        used_(surface.shading.size(), 0) {}

  void fill(const FragmentTile& seen, BiscaleTile& tile) {
    tile.fragments.reserve(seen.fragments.size());
    coverTile(tile, seen, options_.grid,
              [&](const Fragment& f, std::uint32_t pixel, float share) { add(f, pixel, share, tile); });
  }

  /// Frames that are seen get consecutive places.
  void renumber(BiscaleView& view, Job& job) {
    std::vector<std::uint32_t> slot(used_.size(), 0);
    for (std::size_t r = 0; r < used_.size(); ++r) {
      if (!used_[r]) continue;
      slot[r] = std::uint32_t(view.frames.size());
      view.frames.push_back(std::uint32_t(r));
    }
    parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
      for (BiscaleFragment& f : view.tiles[t].fragments)
        for (std::uint32_t& corner : f.corner) corner = slot[corner];
    });
  }

 private:
  void add(const Fragment& f, std::uint32_t pixel, float share, BiscaleTile& tile) {
    if (f.back) return;
    const Vec2 patch = surface_.cover->at(f.triangle, f.barycentric);
    if (patch.x < 0) return;
    BiscaleFragment out;
    out.pixel = pixel, out.share = share;
    out.weight = {1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y};
    out.texel = surface_.responses->texelAt(patch);
    for (std::size_t i = 0; i < 3; ++i) {
      out.corner[i] = surface_.shading.corner[3 * std::size_t(f.triangle) + i];
      std::atomic_ref(used_[out.corner[i]]).store(1, std::memory_order_relaxed);
    }
    const auto views = surface_.responses->views().bilinear(localView(f));
    for (std::size_t i = 0; i < 4; ++i) {
      out.view[i] = std::uint16_t(views[i].index);
      out.viewWeight[int(i)] = views[i].weight;
    }
    tile.fragments.push_back(out);
  }

  /// Towards the viewer, in the patch's frame there.
  Vec3 localView(const Fragment& f) const {
    if (!options_.viewDependent) return {0, 0, 1};
    const UVec3& t = mesh_.triangles[f.triangle];
    const auto at = [&](const std::vector<Vec3>& v) {
      return interpolated(v[t.x], v[t.y], v[t.z], f.barycentric);
    };
    const Vec3 smooth = at(mesh_.normals);
    const Vec3 normal = dot(smooth, smooth) > 1e-12f ? normalize(smooth) : mesh_.normals[t.x];
    const Vec3 tangent = tangentAt(*surface_.frames, f.triangle, f.barycentric, normal);
    const Vec3 view = camera_.towardsViewer(at(mesh_.positions));
    return Frame{tangent, cross(normal, tangent), normal}.toLocal(view);
  }

  const BiscaleSurface& surface_;
  const TriMesh& mesh_;
  const Camera& camera_;
  BiscaleViewOptions options_;
  std::vector<std::uint8_t> used_;  // [R]
};

}  // namespace

BiscaleSurface::BiscaleSurface(std::shared_ptr<const Scene> sceneOf,
                               std::shared_ptr<const TangentFrames> framesOf,
                               std::shared_ptr<const PatchCover> coverOf,
                               std::shared_ptr<const ResponseTable> responsesOf)
    : scene(std::move(sceneOf)),
      frames(std::move(framesOf)),
      cover(std::move(coverOf)),
      responses(std::move(responsesOf)),
      shading(shadingFrames(scene->mesh, *frames)) {}

BiscaleView makeBiscaleView(const BiscaleSurface& surface, const Camera& camera, int width, int height,
                            const BiscaleViewOptions& options, Job& job) {
  const Rasterizer rasterizer(surface.scene->mesh, camera, width, height, options.grid, job);
  Maker maker(surface, camera, options);
  BiscaleView view;
  view.width = width, view.height = height;
  view.tiles.resize(rasterizer.tileCount());
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    thread_local SampleTile samples;
    thread_local FragmentTile fragments;
    rasterizer.drawFragments(t, samples, fragments);
    maker.fill(fragments, view.tiles[t]);
  });
  maker.renumber(view, job);
  return view;
}

}  // namespace prt
