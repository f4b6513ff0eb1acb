// Baked transfer against the path tracer, which shares nothing with it but rays and materials, on real meshes
// under real probes.

#include "libprt/core/sampling.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/repair.h"
#include "libprt/transport/path_tracer.h"
#include "tests/support/shared_data.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

/// A band-limited light that is nowhere negative, as a rig for the path tracer and as coefficients.
struct BandLimitedLight {
  LightRig rig;
  ShRgb coefficients;

  explicit BandLimitedLight(const std::string& probe) {
    const ShRgb light =
        nonNegativeLight(projectEnvironment(loadEnvironment(test::sharedData("probes/" + probe)), 5));
    rig.environment = std::make_shared<EnvironmentMap>(bandLimitedMap(light, 512, 256));
    coefficients = projectEnvironment(*rig.environment, 5);
  }
};

/// Transfer at some vertices with 4096 rays, which keep the bake's own noise near 0.1 %, so that what is left
/// to see is bias; light bounces between vertices that have 1024.
Transfer transferAt(const test::BakeInput& input, const std::vector<std::uint32_t>& indices, int bounces) {
  TransferSettings settings;
  settings.rays = 1024, settings.bounces = bounces, settings.stopThreshold = 0;
  const Transfer vertices = input.transfer(settings);
  settings.rays = 4096;
  const test::BakeInput some = input.only(indices);
  Job job;
  return finishTransfer(*input.scene, *input.rays, *some.samples,
                        some.direct(directSettings(settings, TransferForm::Diffuse)), settings,
                        TransferForm::Diffuse, job, &vertices);
}

/// Relative RMS error of baked irradiance at the samples themselves; the references' noise cancels between
/// them.
double errorAtSamples(const test::BakeInput& input, const BandLimitedLight& light,
                      const std::vector<std::uint32_t>& indices, int bounces) {
  constexpr int kPaths = 4096;
  Job job;
  const PathTracer tracer(*input.scene, light.rig, job);
  PathOptions one, two;
  one.bounces = two.bounces = bounces;
  one.seed = 1, two.seed = 2;
  const std::vector<Rgb> r1 = irradianceAtSamples(tracer, *input.samples, indices, kPaths, one, job).mean,
                         r2 = irradianceAtSamples(tracer, *input.samples, indices, kPaths, two, job).mean,
                         a = irradiance(transferAt(input, indices, bounces), light.coefficients, {});
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    error += dot(DVec3(a[i] - r1[i]), DVec3(a[i] - r2[i]));
    norm += dot(DVec3(r1[i]), DVec3(r2[i]));
  }
  return std::sqrt(std::max(0.0, error) / norm);
}

class BakeReference : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(BakeReference, SamplesAgreeWithThePathTracerWithin3PerMille) {
  PRT_NEEDS_SHARED_DATA();
  Job job;
  const test::BakeInput input(loadMesh(test::sharedData("meshes/" + GetParam().first), {}, job),
                              {0.7f, 0.5f, 0.3f});
  const BandLimitedLight light(GetParam().second);
  std::vector<std::uint32_t> indices;
  for (std::uint64_t i = 0; i < 100; ++i)
    indices.push_back(std::uint32_t(hashUniform(3, i) * float(input.samples->size())));
  for (const int bounces : {0, 3})
    EXPECT_LT(errorAtSamples(input, light, indices, bounces), 0.003) << bounces << " bounces";
}

INSTANTIATE_TEST_SUITE_P(RealMeshes, BakeReference,
                         testing::Values(std::pair{"bunny_3k.off", "grace_latlong.exr"},
                                         std::pair{"spot.obj", "uffizi_256.hdr"}));

}  // namespace
}  // namespace prt
