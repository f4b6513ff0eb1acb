// At the samples themselves there is no interpolation to hide behind: baked irradiance must be the path
// tracer's. Two independent references cancel each other's noise (shade/metrics.h).

#include "tests/accuracy/cases.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <array>

namespace prt {
namespace {

using test::fullRun;
using test::Light;
using test::Model;

constexpr double kBound = 0.003;

const std::vector<std::string> kProbes{"uffizi_256.hdr", "stpeters_cross.hdr", "kloppenheim_05_1k.hdr",
                                       "rnl_probe.hdr"};

/// So many that what is left is no sampling noise: the default must hold the bound too.
constexpr int kManyRays = 16384;

/// Irradiance at `indices`, path traced twice.
using References = std::array<std::vector<float>, 2>;
References pathTraced(const Model& model, const Light& light, const std::vector<std::uint32_t>& indices,
                      int bounces, int paths) {
  Job job;
  const PathTracer tracer(*model.scene, light.rig, job);
  References references;
  for (std::uint64_t seed : {0, 1}) {
    PathOptions options;
    options.bounces = bounces, options.seed = 100 + seed;
    references[seed] =
        test::flatten(irradianceAtSamples(tracer, *model.samples, indices, paths, options, job).mean);
  }
  return references;
}

TransferSettings settings(int bounces, int rays, std::uint64_t seed) {
  TransferSettings s;
  s.form = TransferForm::Diffuse, s.bounces = bounces, s.stopThreshold = 0;
  s.rays = rays, s.seed = seed;
  return s;
}

/// What bounces are gathered from: transfer at every vertex.
Transfer coarseSurface(const Model& model, int bounces, int rays) {
  Job job;
  return bakeTransfer(model.scene, model.rays, model.samples, settings(bounces, rays, 2), job);
}

Transfer transferAt(const Model& model, const std::shared_ptr<const SampleSet>& some, int bounces, int rays,
                    const Transfer* surface) {
  Job job;
  const TransferSettings s = settings(bounces, rays, 1);
  DirectBake bake(model.scene, model.rays, some, directSettings(s, TransferForm::Diffuse));
  while (!bake.done()) bake.advance(job);
  return finishTransfer(*model.scene, *model.rays, *some, bake.product(job), s, TransferForm::Diffuse, job,
                        surface);
}

struct Case {
  std::string mesh;
  int surfaceRays;  ///< at every vertex, for bounces; the full run takes the default
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
    const int surfaceRays = fullRun() ? TransferSettings{}.rays : GetParam().surfaceRays;
    const Transfer surface = bounces > 0 ? coarseSurface(model, bounces, surfaceRays) : Transfer{};
    for (const std::string& probe : kProbes) {
      if (!fullRun() && probe != kProbes[0] && probe != kProbes[2]) continue;
      const Light light = test::loadLight(probe);
      const References truth = pathTraced(model, light, indices, bounces, fullRun() ? 4096 : 2048);
      for (const int rays : {kManyRays, TransferSettings{}.rays}) {
        const Transfer transfer = transferAt(model, some, bounces, rays, bounces > 0 ? &surface : nullptr);
        const std::vector<float> baked =
            test::flatten(irradiance(transfer, light.coefficients, some->shadingNormal));
        const NoiseFreeError e = noiseFreeError(baked, truth[0], truth[1], 12);
        test::report(model.name + ", " + light.name + ", " + std::to_string(bounces) + " bounces, " +
                         std::to_string(rays) + " rays, at samples",
                     e);
        EXPECT_LT(e.relative(), kBound) << model.name << " " << probe << " " << bounces << " " << rays;
      }
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
