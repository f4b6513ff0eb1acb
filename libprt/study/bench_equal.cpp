// How much longer path tracing takes for the same picture at equal error: stucco on a rock as the bench
// "biscale" draws it, against its displaced surface. The error of the bi-scale picture is measured against
// the truth; a path tracer that is only noisy gets there with so many paths per pixel as bring its variance
// down to that error's square.

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/project/products.h"
#include "libprt/study/bench_list.h"
#include "libprt/study/biscale_stage.h"
#include "libprt/study/biscale_truth.h"
#include "libprt/study/figure_kit.h"

#include <cmath>

namespace prt {
namespace {

constexpr double kAim = 5000;

TruthCase stuccoRock(int paths, Job& job) {
  TruthCase of;
  of.recipe = biscaleBenchRecipe();
  of.recipe.patch.model = PatchModel::HeightField;
  of.recipe.patch.depth = 0.1f;
  of.recipe.rtt.rays = 512;
  of.recipe.transfer.rays = 1024;
  of.recipe.synthesis.scale = 0.05f;
  of.light = nonNegativeLight(projectLights(figureLamp(), 5));
  of.grid = 4, of.paths = paths;
  Pipeline pipeline(nullptr, {});
  of.camera =
      frameBox(pipeline.run(of.recipe, {"scene"}, job).get<SceneProduct>("scene")->scene->mesh.bounds());
  return of;
}

}  // namespace

BenchResult benchEqual(Job& job, int repetitions) {
  InnerJob inner(job);
  job.begin("bench equal", 2, "parts");
  const TruthCase of = stuccoRock(repetitions, inner.job);
  const BiscaleTruth truth(of, inner.job);
  job.advance(1);
  const double frame = biscaleFrame(of.recipe, truth.products(), repetitions, inner.job).whole;
  job.advance(1);
  const NoiseFreeError& error = truth.both().error;
  if (!(error.meanSquare > 0))
    throw ResourceError("the error drowns in the path tracer's noise", "bench equal", "use more repetitions");
  const double pixels = double(of.width) * of.height, perPath = truth.secondsPerPath() * pixels;
  const double paths = truth.noiseOfOnePath() / error.meanSquare;
  const double pathsOfOnePercent = truth.noiseOfOnePath() / (1e-4 * error.signal);
  BenchResult result;
  result.name = "equal";
  result.ours = {paths * perPath / frame, "times"};
  result.againstWhat = "the aim";
  result.against = {kAim, "times"};
  result.ratio = result.ours.value / kAim;
  result.details = {{"error", error.relative()},
                    {"ms_frame", 1e3 * frame},
                    {"paths_a_pixel", paths},
                    {"seconds_traced", paths * perPath},
                    {"times_for_one_percent", pathsOfOnePercent * perPath / frame},
                    {"triangles", double(truth.triangles())}};
  return result;
}

}  // namespace prt
