// The default weave's radiance transfer texture with two bounces, from the patch to the finished table,
// against its own rays traced and thrown away: everything besides tracing may cost as much as 0.4 of the
// time. (The paper rendered 8192 images at 0.7 to 3 seconds each.)

#include "libprt/core/parallel.h"
#include "libprt/meso/patch_build.h"
#include "libprt/meso/rtt_bake.h"
#include "libprt/study/bench_list.h"
#include "libprt/transport/bake_rays.h"

#include <atomic>

namespace prt {
namespace {

constexpr double kLimit = 0.6;  // share of the bare ray rate

/// Rays from the surface, as the bake of light on it sends them.
std::size_t traceSurface(const PatchScene& patch, const RttSettings& settings, Job& job) {
  std::atomic<std::size_t> met{0};
  int begin = 0;
  for (const int end : bakeLevels(settings.rays)) {
    for (int chunk = begin; chunk < end; chunk += kChunkRays) {
      const RayTable table(RaySpread::Cosine, 1, chunk, std::min(end, chunk + kChunkRays), settings.seed,
                           job);
      parallelFor(job, 0, patch.samples->size(), kBakeTile, [&](std::size_t first, std::size_t last) {
        WorldRays directions;
        std::vector<Hit> hits(std::size_t(table.size()));
        std::size_t count = 0;
        for (std::size_t s = first; s < last; ++s) {
          directions.turn(table, bakeScramble(*patch.samples, s, settings.seed),
                          bakeFrame(*patch.samples, s, RaySpread::Cosine, settings.seed));
          patch.rays->intersectFrom(patch.samples->origin[s], directions.x, directions.y, directions.z, hits);
          for (const Hit& hit : hits) count += hit.valid();
        }
        met += count;
      });
    }
    begin = end;
  }
  return met;
}

/// Rays of the pictures.
std::size_t traceViews(const PatchScene& patch, const RttSettings& settings, Job& job) {
  const ViewSquare square(settings.views);
  const std::vector<Vec2> places = texelSamples(settings.supersamples, settings.seed);
  const std::size_t perRow = places.size() * std::size_t(settings.texels);
  std::atomic<std::size_t> met{0};
  for (int view = 0; view < square.count(); ++view)
    parallelFor(job, 0, std::size_t(settings.texels), 1, [&](std::size_t v, std::size_t) {
      std::vector<Ray> rays;
      std::vector<Hit> hits(perRow);
      for (int u = 0; u < settings.texels; ++u)
        for (const Vec2& place : places)
          rays.push_back(viewRay(*patch.patch, (Vec2(float(u), float(v)) + place) / float(settings.texels),
                                 square.centre(view)));
      patch.rays->intersectRays(rays, hits);
      std::size_t count = 0;
      for (const Hit& hit : hits) count += hit.valid();
      met += count;
    });
  return met;
}

}  // namespace

BenchResult benchRtt(Job& job, int repetitions) {
  PatchOptions options;
  options.model = PatchModel::Weave;
  InnerJob building(job);
  const PatchScene patch =
      makePatchScene(std::make_shared<Patch>(buildPatch(options, {}, building.job)), building.job);
  const RttSettings settings;
  const double surfaceRays = double(patch.samples->size()) * settings.rays,
               viewRays = double(settings.texels * settings.texels) * settings.views * settings.views *
                          settings.supersamples * settings.supersamples;
  std::vector<double> ours, bare, ratios;
  std::size_t met = 0;
  job.begin("bench rtt", repetitions, "repetitions");
  for (int i = 0; i < repetitions; ++i) {
    InnerJob inner(job);
    const double without = secondsOf(
        [&] { met = traceSurface(patch, settings, inner.job) + traceViews(patch, settings, inner.job); });
    const double with = secondsOf([&] { bakeRtt(patch, settings, inner.job); });
    ours.push_back(with), bare.push_back(without), ratios.push_back(without / with);
    job.advance(1);
  }
  const double rays = surfaceRays + viewRays;
  BenchResult result;
  result.ratio = median(ratios) / kLimit;
  result.ours = {rays / median(ours) * 1e-6, "Mray/s"};
  result.againstWhat = "0.6 of the rate of the same rays traced and thrown away";
  result.against = {kLimit * rays / median(bare) * 1e-6, "Mray/s"};
  result.details = {{"points", double(patch.samples->size())},
                    {"surface_rays", surfaceRays},
                    {"view_rays", viewRays},
                    {"seconds", median(ours)},
                    {"trace_only_seconds", median(bare)},
                    {"hit_share", double(met) / rays}};
  return result;
}

}  // namespace prt
