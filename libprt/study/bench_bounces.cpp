// Three diffuse bounces against the direct diffuse bake that they start from: they may cost at most as much
// again.

#include "libprt/study/bench_list.h"
#include "libprt/transport/transfer_bake.h"

namespace prt {
namespace {

constexpr int kRays = 1024;

Transfer bake(const BenchScene& bench, int bounces, Job& job) {
  TransferSettings settings;
  settings.rays = kRays;
  settings.bounces = bounces;
  settings.stopThreshold = 0;
  InnerJob inner(job);
  return bakeTransfer(bench.scene, bench.rays, bench.samples, settings, inner.job);
}

}  // namespace

BenchResult benchBounces(Job& job, int repetitions) {
  constexpr int kBounces = 3;
  const BenchScene bench = benchScene();
  std::vector<double> direct, all, ratios;
  job.begin("bench bounces", repetitions + 1, "repetitions");
  for (int i = 0; i <= repetitions; ++i) {
    const double without = secondsOf([&] { bake(bench, 0, job); });
    const double with = secondsOf([&] { bake(bench, kBounces, job); });
    job.advance(1);
    if (i == 0) continue;  // warms caches and threads
    direct.push_back(without), all.push_back(with);
    ratios.push_back(without / std::max(with - without, 1e-3 * without));
  }
  BenchResult result;
  result.ratio = median(ratios);
  result.ours = {median(all) - median(direct), "s"};
  result.againstWhat = "the direct diffuse bake itself";
  result.against = {median(direct), "s"};
  result.details = {{"vertices", double(bench.samples->size())},
                    {"rays_per_vertex", kRays},
                    {"bounces", kBounces},
                    {"seconds_with_bounces", median(all)}};
  return result;
}

}  // namespace prt
