// At the samples themselves there is no interpolation to hide behind: baked irradiance must be the path
// tracer's. Two independent references cancel each other's noise (shade/metrics.h).

#include "tests/accuracy/cases.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <chrono>

namespace prt {
namespace {

using test::fullRun;
using test::Light;
using test::Model;

constexpr double kBound = 0.003;

const std::vector<std::string> kProbes{"uffizi_256.hdr", "stpeters_cross.hdr", "kloppenheim_05_1k.hdr",
                                       "rnl_probe.hdr"};

/// Error of baked irradiance at `indices` (rows of `baked` are in that order).
NoiseFreeError measure(const Model& model, const Light& light, const std::vector<Rgb>& baked,
                       const std::vector<std::uint32_t>& indices, int bounces, int paths) {
  Job job;
  const PathTracer tracer(*model.scene, light.rig, job);
  std::vector<float> references[2];
  for (std::uint64_t seed : {0, 1}) {
    PathOptions options;
    options.bounces = bounces, options.seed = 100 + seed;
    references[seed] =
        test::flatten(irradianceAtSamples(tracer, *model.samples, indices, paths, options, job).mean);
  }
  return noiseFreeError(test::flatten(baked), references[0], references[1], 12);
}

struct Case {
  std::string mesh;
  int surfaceRays;  ///< at every vertex, for bounces
  bool always;      ///< also without PRT_FULL
};
class AtSamples : public testing::TestWithParam<Case> {};

TEST_P(AtSamples, BakedIrradianceIsThePathTracers) {
  PRT_NEEDS_SHARED_DATA();
  if (!GetParam().always && !fullRun()) GTEST_SKIP() << "part of the full run: set PRT_FULL=1";
  Job job;
  const Model model = test::loadModel(GetParam().mesh);
  const std::vector<std::uint32_t> indices =
      test::pick(model.scene->mesh.vertexCount(), fullRun() ? 400 : 300, 7);
  const auto some = std::make_shared<SampleSet>(test::subset(*model.samples, indices));

  for (const int bounces : {0, 3}) {
    TransferSettings settings;
    settings.form = TransferForm::Diffuse, settings.bounces = bounces, settings.stopThreshold = 0;
    settings.rays = 16384;
    const DirectSettings direct = directSettings(settings, TransferForm::Diffuse);
    DirectBake bake(model.scene, model.rays, some, direct);
    while (!bake.done()) bake.advance(job);
    Transfer surface;
    if (bounces > 0) {
      TransferSettings coarse = settings;
      coarse.rays = GetParam().surfaceRays, coarse.seed = 2;
      surface = bakeTransfer(model.scene, model.rays, model.samples, coarse, job);
    }
    const Transfer transfer = finishTransfer(*model.scene, *model.rays, *some, bake.product(job), settings,
                                             TransferForm::Diffuse, job, bounces > 0 ? &surface : nullptr);
    for (const std::string& probe : kProbes) {
      if (!fullRun() && probe != kProbes[0] && probe != kProbes[2]) continue;
      const Light light = test::loadLight(probe);
      const std::vector<Rgb> baked = irradiance(transfer, light.coefficients, some->shadingNormal);
      const NoiseFreeError e = measure(model, light, baked, indices, bounces, fullRun() ? 4096 : 2048);
      test::report(model.name + ", " + light.name + ", " + std::to_string(bounces) + " bounces, at samples",
                   e);
      EXPECT_LT(e.relative(), kBound) << model.name << " " << probe << " " << bounces;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, AtSamples,
                         testing::Values(Case{"bunny_3k.off", 1024, true}, Case{"spot.obj", 1024, true},
                                         Case{"blobby.off", 1024, true}, Case{"armadillo.off", 256, true},
                                         Case{"happy_buddha.obj", 256, true},
                                         Case{"stanford-bunny.obj", 1024, false},
                                         Case{"lucy.ply", 1024, false}),
                         [](const auto& one) { return test::caseName(one.param.mesh); });

}  // namespace
}  // namespace prt
