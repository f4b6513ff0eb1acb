#include "libprt/meso/rtt_bake.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/meso/patch_lobe.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

void check(const RttSettings& s) {
  if (s.supersamples < 1 || s.supersamples > 16)
    throw ValueError("cannot take " + std::to_string(s.supersamples) + " samples a side", "rtt.supersamples",
                     "use 1 to 16");
  if (s.lobeRays < 1 || s.lobeRays > 1024)
    throw ValueError("cannot send " + std::to_string(s.lobeRays) + " rays along a lobe", "rtt.lobeRays",
                     "use 1 to 1024");
}

/// What the numbers of a table mean for a patch: how many channels, and whether a common albedo stays
/// outside.
struct Layout {
  int channels = 3;
  Rgb colour{1};

  Layout(const Patch& patch, const PatchLight& light) {
    const auto grey = [](const Rgb& c) { return c.x == c.y && c.y == c.z; };
    bool uniform = !patch.albedoTexture, allGrey = !patch.albedoTexture || patch.albedoTexture->channels < 3;
    for (const Rgb& c : patch.albedo)
      uniform = uniform && c == patch.albedo.front(), allGrey = allGrey && grey(c);
    const bool greyGloss = !patch.glossy() || (grey(patch.specular) && !patch.glossTexture);
    if (light.channels == 1 && uniform && !patch.glossy())
      channels = 1, colour = patch.albedo.front();
    else if (light.channels == 1 && allGrey && greyGloss)
      channels = 1;
  }
};

/// Pictures of a patch, row by row.
class ViewPass {
 public:
  ViewPass(const PatchScene& patch, const PatchLight& light, const RttSettings& settings, Rtt& rtt,
           bool factored)
      : patch_(patch),
        light_(light),
        settings_(settings),
        rtt_(rtt),
        factored_(factored),
        places_(texelSamples(settings.supersamples, settings.seed)) {}

  /// Texels of row `v` towards one view.
  void row(int v, int view, const Vec3& direction) {
    const std::size_t perTexel = places_.size(), all = perTexel * std::size_t(rtt_.texels);
    rays_.clear();
    for (int u = 0; u < rtt_.texels; ++u)
      for (const Vec2& place : places_)
        rays_.push_back(
            viewRay(*patch_.patch, (Vec2(float(u), float(v)) + place) / float(rtt_.texels), direction));
    hits_.resize(all);
    patch_.rays->intersectRays(rays_, hits_);
    for (int u = 0; u < rtt_.texels; ++u) {
      float* block = rtt_.block(u, v, view);
      for (std::size_t i = 0; i < perTexel; ++i) {
        const std::size_t at = std::size_t(u) * perTexel + i;
        if (hits_[at].valid() && !hits_[at].back) add(hits_[at], direction, key(v, u, view, i), block);
      }
      for (std::size_t k = 0; k < rtt_.blockSize(); ++k) block[k] /= float(perTexel);
    }
  }

 private:
  static std::uint64_t key(int v, int u, int view, std::size_t sample) {
    return ((std::uint64_t(v) << 12 | std::uint64_t(u)) << 20 | std::uint64_t(view)) << 10 | sample;
  }

  void add(const Hit& hit, const Vec3& view, std::uint64_t key, float* block) {
    const Patch& patch = *patch_.patch;
    const Rgb albedo = (factored_ ? Rgb(1) : patch.albedoAt(hit.triangle, hit.barycentric)) / kPiF;
    addDiffuse(hit, albedo, block);
    if (patch.glossy())
      addLobe(patch_, light_, settings_.bands, hit, view, settings_.lobeRays,
              hashBits(settings_.seed, key, 7), rtt_.channels, lobe_, block);
  }

  /// block += albedo/pi e(hit).
  void addDiffuse(const Hit& hit, const Rgb& factor, float* block) const {
    const UVec3& t = patch_.patch->mesh.triangles[hit.triangle];
    const Vec2& b = hit.barycentric;
    const float *r0 = light_.rows.row(t.x), *r1 = light_.rows.row(t.y), *r2 = light_.rows.row(t.z);
    const float w0 = 1 - b.x - b.y, w1 = b.x, w2 = b.y;
    const std::size_t n = rtt_.blockSize();
    if (rtt_.channels == 1) {
      for (std::size_t i = 0; i < n; ++i) block[i] += factor.x * (w0 * r0[i] + w1 * r1[i] + w2 * r2[i]);
    } else if (light_.channels == 3) {
      for (std::size_t i = 0; i < n; i += 3)
        for (std::size_t c = 0; c < 3; ++c)
          block[i + c] += factor[int(c)] * (w0 * r0[i + c] + w1 * r1[i + c] + w2 * r2[i + c]);
    } else {
      for (std::size_t i = 0; 3 * i < n; ++i) {
        const float e = w0 * r0[i] + w1 * r1[i] + w2 * r2[i];
        for (std::size_t c = 0; c < 3; ++c) block[3 * i + c] += factor[int(c)] * e;
      }
    }
  }

  const PatchScene& patch_;
  const PatchLight& light_;
  const RttSettings& settings_;
  Rtt& rtt_;
  bool factored_;
  std::vector<Vec2> places_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  LobeScratch lobe_;
};

}  // namespace

std::vector<Vec2> texelSamples(int supersamples, std::uint64_t seed) {
  std::vector<Vec2> places;
  for (int j = 0; j < supersamples; ++j)
    for (int i = 0; i < supersamples; ++i) {
      const auto index = std::uint64_t(j * supersamples + i);
      places.push_back(
          (Vec2(float(i), float(j)) + Vec2(hashUniform(seed, index, 101), hashUniform(seed, index, 102))) /
          float(supersamples));
    }
  return places;
}

Rtt picturesOfPatch(const PatchScene& patch, const PatchLight& light, const RttSettings& settings,
                    std::span<const Vec3> directions, int everyRow, Job& job,
                    const std::function<void(const RttPreview&)>& preview) {
  check(settings);
  const Layout layout(*patch.patch, light);
  const int side = int(std::ceil(std::sqrt(double(directions.size()))));
  Rtt rtt(settings.texels, side, settings.bands, layout.channels);
  rtt.colour = layout.colour;
  rtt.bounces = light.bounces;
  rtt.rays = light.rays;
  const bool factored = layout.channels == 1 && layout.colour == patch.patch->albedo.front() &&
                        !patch.patch->albedoTexture && !patch.patch->glossy() && light.channels == 1;
  const int count = int(directions.size());
  const auto rows = std::size_t((rtt.texels + everyRow - 1) / everyRow);
  job.begin("images of the patch", count, "images");
  for (int view = 0; view < count; ++view) {
    parallelFor(job, 0, rows, 1, [&](std::size_t row, std::size_t) {
      ViewPass(patch, light, settings, rtt, factored)
          .row(int(row) * everyRow, view, directions[std::size_t(view)]);
    });
    job.advance(1);
    if (preview) preview({rtt, view + 1, count, false});
  }
  return rtt;
}

Rtt viewsOfPatch(const PatchScene& patch, const PatchLight& light, const RttSettings& settings, Job& job,
                 const std::function<void(const RttPreview&)>& preview) {
  const Rtt empty(1, settings.views, 1, 1);  // refuses what is out of range
  const ViewSquare square(settings.views);
  std::vector<Vec3> centres;
  for (int view = 0; view < square.count(); ++view) centres.push_back(square.centre(view));
  return picturesOfPatch(patch, light, settings, centres, 1, job, preview);
}

PatchLight bakePatchLight(const PatchScene& patch, const RttSettings& settings, Job& job,
                          const std::function<void(const RttPreview&)>& preview) {
  check(settings);
  PatchTransferBake bake(patch, settings.transfer());
  while (!bake.done()) {
    bake.advance(job);
    if (!preview || bake.done() || bake.level() > 1) continue;
    RttSettings coarse = settings;
    coarse.supersamples = 1, coarse.lobeRays = 1;
    const Rtt first = viewsOfPatch(patch, bake.basisLight(job), coarse, job);
    preview({first, 0, first.viewCount(), true});
  }
  return bake.basisLight(job);
}

Rtt bakeRtt(const PatchScene& patch, const RttSettings& settings, Job& job,
            const std::function<void(const RttPreview&)>& preview) {
  return viewsOfPatch(patch, bakePatchLight(patch, settings, job, preview), settings, job, preview);
}

}  // namespace prt
