#include "libprt/shade/biscale_view.h"

#include "libprt/core/half.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/half_lanes.h"
#include "libprt/synthesis/orientation_field.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

namespace prt {
namespace {

using sh_kernel::Lanes;
constexpr std::size_t kLanes = std::size_t(sh_kernel::kLanes);

/// A fragment's response, summed up.
class ResponseSum {
 public:
  ResponseSum(const ResponseTable& table, const BiscaleFragment& fragment)
      : table_(table), fragment_(fragment), lanes_(table.blockSize() / kLanes) {
    std::fill_n(sums_.begin(), lanes_, Lanes{});
  }

  /// Of a texel of `table`, between the views around the fragment's.
  void add(const ResponseTable& table, std::uint32_t texel, float weight) {
    for (std::size_t i = 0; i < 4; ++i) {
      const float share = weight * fragment_.viewWeight[int(i)];
      const std::uint16_t* block = table.block(texel, fragment_.view[i]);
      for (std::size_t n = 0; n < lanes_; ++n) sums_[n] += share * loadHalfs(block + n * kLanes);
    }
  }
  void add(const PatchFilter::Coefficients& coefficients, const ResponseTable& terms) {
    for (std::size_t t = 0; t < coefficients.size(); ++t) add(terms, std::uint32_t(t), coefficients[t]);
  }
  /// Appends it as halfs.
  void store(std::vector<std::uint16_t>& to) const {
    std::array<float, kLanes> values;
    const std::size_t first = to.size();
    to.resize(first + lanes_ * kLanes);
    for (std::size_t n = 0; n < lanes_; ++n) {
      sh_kernel::store(sums_[n], values.data());
      for (float& v : values) v = std::clamp(v, -kLargestHalf, kLargestHalf);
      toHalf(values, std::span(to).subspan(first + n * kLanes, kLanes));
    }
  }
  const ResponseTable& table() const { return table_; }

 private:
  const ResponseTable& table_;
  const BiscaleFragment& fragment_;
  std::size_t lanes_;
  std::array<Lanes, 3 * 104 / kLanes> sums_;  // ten bands in three channels
};

/// All samples of a footprint: exact texels below level 1, coefficients from there on. False where neither
/// knows anything.
bool addFiltered(const PatchFilter& filter, const FilterPlace& middle, const Footprint& print,
                 ResponseSum& sum) {
  const float level = filter.holds(middle.chart) ? filter.levelOf(print.width) : 0.0f,
              part = 1 / float(print.taps);
  const FilterTexels here = filter.texelsAround(middle);
  const float coarse = here.empty() && level > 0 ? 1.0f : std::min(level, 1.0f);
  if (coarse == 0 && here.empty()) return false;
  PatchFilter::Coefficients coefficients{};
  for (int i = 0; i < print.taps; ++i) {
    FilterPlace place = middle;
    place.at += (float(i) - 0.5f * float(print.taps - 1)) * print.step;
    if (coarse < 1) {
      FilterTexels around = filter.texelsAround(place);
      if (around.empty()) around = here;  // beyond the chart
      for (std::size_t k = 0; k < around.count; ++k)
        if (const float weight = around.weight[k] * part * (1 - coarse); weight > 0)
          sum.add(sum.table(), around.texel[k], weight);
    }
    if (coarse > 0) filter.add(place, level, part * coarse, coefficients);
  }
  if (coarse > 0) sum.add(coefficients, filter.terms());
  return true;
}

class Maker {
 public:
  Maker(const BiscaleSurface& surface, const Camera& camera, int width, int height,
        const BiscaleViewOptions& options)
      : surface_(surface),
        mesh_(surface.scene->mesh),
        camera_(camera),
        options_(options),
        steps_(camera, width, height),
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
    BiscaleFragment out;
    out.pixel = pixel, out.share = share;
    out.weight = {1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y};
    if (surface_.plain) out.texel = surface_.plain->texelOf(f.triangle);
    out.plain = surface_.plain && out.texel != PlainObjects::kPatched;
    const ResponseTable& table = out.plain ? surface_.plain->responses() : *surface_.responses;
    const bool fromAbove = !options_.viewDependent && !out.plain;
    const auto views = table.views().bilinear(fromAbove ? Vec3(0, 0, 1) : localView(f));
    for (std::size_t i = 0; i < 4; ++i) {
      out.view[i] = std::uint16_t(views[i].index);
      out.viewWeight[int(i)] = views[i].weight;
    }
    if (!out.plain && !(surface_.filter && filter(f, out, tile)) && !look(f, out, tile)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      out.corner[i] = surface_.shading.corner[3 * std::size_t(f.triangle) + i];
      std::atomic_ref(used_[out.corner[i]]).store(1, std::memory_order_relaxed);
    }
    tile.fragments.push_back(out);
  }

  /// The texel that is shown; false where there is none.
  bool look(const Fragment& f, BiscaleFragment& out, BiscaleTile& tile) const {
    const Vec2 patch = surface_.cover->at(f.triangle, f.barycentric);
    if (patch.x < 0) return false;
    const ResponseTable& table = *surface_.responses;
    const LayerShares shares = surface_.cover->sharesAt(f.triangle, f.barycentric);
    const std::uint32_t texel = table.texelAt(patch);
    if (shares.count > 1) {
      ResponseSum sum(table, out);
      for (std::size_t n = 0; n < shares.count; ++n)
        sum.add(table, texel + shares.layer[n] * table.texelCount(), shares.weight[n]);
      keep(sum, out, tile);
    } else {
      out.texel = texel + shares.layer[0] * table.texelCount();
    }
    return true;
  }

  /// The fragment's response is what was summed up.
  void keep(const ResponseSum& sum, BiscaleFragment& out, BiscaleTile& tile) const {
    out.filtered = true;
    out.texel = std::uint32_t(tile.responses.size() / surface_.responses->blockSize());
    sum.store(tile.responses);
  }

  /// The response of all that the pixel covers; false where nothing can be told.
  bool filter(const Fragment& f, BiscaleFragment& out, BiscaleTile& tile) const {
    const PatchFilter& filter = *surface_.filter;
    const UVec3& t = mesh_.triangles[f.triangle];
    const Vec3& a = mesh_.positions[t.x];
    const Vec3 e1 = mesh_.positions[t.y] - a, e2 = mesh_.positions[t.z] - a;
    const PlaneSteps steps = planeSteps(steps_, a + f.barycentric.x * e1 + f.barycentric.y * e2, e1, e2);
    const Footprint print = footprintOf(filter.placeStep(f.triangle, weightStep(steps.right, e1, e2)),
                                        filter.placeStep(f.triangle, weightStep(steps.down, e1, e2)));
    ResponseSum sum(*surface_.responses, out);
    if (!addFiltered(filter, filter.place(f.triangle, f.barycentric), print, sum)) return false;
    keep(sum, out, tile);
    return true;
  }

  /// Towards the viewer, in the patch's frame there.
  Vec3 localView(const Fragment& f) const {
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
  PixelSteps steps_;
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
  const Rasterizer rasterizer(surface.scene->mesh, camera, width, height, options.grid, job,
                              options.occluder);
  Maker maker(surface, camera, width, height, options);
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
