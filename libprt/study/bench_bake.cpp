// The direct bake of matrices against its own rays, traced and thrown away: what the bake does besides
// tracing (making directions, projecting visibility, rotating) may cost a fifth of the rate.

#include "libprt/core/parallel.h"
#include "libprt/study/bench_list.h"
#include "libprt/transport/bake_rays.h"
#include "libprt/transport/direct_transfer.h"

#include <atomic>

namespace prt {
namespace {

constexpr int kRays = 1024;
constexpr double kLimit = 0.8;  // share of the bare ray rate

DirectSettings bakeSettings() {
  DirectSettings settings;
  settings.bands = 5;
  settings.rays = kRays;
  settings.visibility = true;
  return settings;
}

/// The bake's rays, in the bake's order, from the same origins; returns how many were blocked, so that
/// nothing is optimised away.
std::size_t traceOnly(const BenchScene& bench, Job& job) {
  const std::uint64_t seed = bakeSettings().seed;
  std::atomic<std::size_t> blockedCount{0};
  int begin = 0;
  for (const int end : bakeLevels(kRays)) {
    const RayTable table(RaySpread::Uniform, 1, begin, end, seed, job);
    parallelFor(job, 0, bench.samples->size(), kBakeTile, [&](std::size_t first, std::size_t last) {
      WorldRays directions;
      std::vector<std::uint8_t> blocked(std::size_t(table.size()));
      std::size_t count = 0;
      for (std::size_t s = first; s < last; ++s) {
        directions.turn(table, bakeScramble(*bench.samples, s, seed),
                        bakeFrame(*bench.samples, s, RaySpread::Uniform, seed));
        bench.rays->occludedFrom(bench.samples->origin[s], directions.x, directions.y, directions.z, blocked);
        for (const std::uint8_t b : blocked) count += b;
      }
      blockedCount += count;
    });
    begin = end;
  }
  return blockedCount;
}

void bake(const BenchScene& bench, Job& job) {
  InnerJob inner(job);
  DirectBake direct(bench.scene, bench.rays, bench.samples, bakeSettings());
  while (!direct.done()) direct.advance(inner.job);
  direct.product(inner.job);
}

}  // namespace

BenchResult benchBake(Job& job, int repetitions) {
  const BenchScene bench = benchScene();
  const double rays = double(bench.samples->size()) * kRays;
  std::vector<double> ours, bare, ratios;
  std::size_t blocked = 0;
  job.begin("bench bake", repetitions + 1, "repetitions");
  for (int i = 0; i <= repetitions; ++i) {
    const double without = secondsOf([&] { blocked = traceOnly(bench, job); });
    const double with = secondsOf([&] { bake(bench, job); });
    job.advance(1);
    if (i == 0) continue;  // warms caches and threads
    ours.push_back(with), bare.push_back(without), ratios.push_back(without / with);
  }
  BenchResult result;
  result.ratio = median(ratios) / kLimit;
  result.ours = {rays / median(ours) * 1e-6, "Mray/s"};
  result.againstWhat = "0.8 of the rate of the same rays traced and thrown away";
  result.against = {kLimit * rays / median(bare) * 1e-6, "Mray/s"};
  result.details = {{"vertices", double(bench.samples->size())},
                    {"rays_per_vertex", kRays},
                    {"seconds", median(ours)},
                    {"trace_only_seconds", median(bare)},
                    {"blocked_share", double(blocked) / rays}};
  return result;
}

}  // namespace prt
