// Pictures: what is left when the values at the vertices are right is interpolation. Its size is measured
// with the same renderer fed with path-traced values (the interpolation floor); baked pictures must stay
// close.

#include "libprt/mesh/generate.h"
#include "libprt/shade/reference.h"
#include "libprt/shade/render.h"
#include "tests/accuracy/cases.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <set>

namespace prt {
namespace {

using test::fullRun;
using test::Light;
using test::Model;

constexpr double kBound = 1.2;  // times the interpolation floor

/// Vertices of the triangles in view.
std::vector<std::uint32_t> visibleVertices(const Model& model, const FragmentImage& view) {
  std::set<std::uint32_t> vertices;
  for (const FragmentTile& tile : view.tiles)
    for (const Fragment& f : tile.fragments)
      for (int k = 0; k < 3; ++k) vertices.insert(model.scene->mesh.triangles[f.triangle][k]);
  return {vertices.begin(), vertices.end()};
}

/// Two independent path-traced pictures.
struct References {
  Image first, second;
  PixelMask inside;  // covered whole
};
References trace(const PathTracer& tracer, const Camera& camera, int size, int samples, int bounces,
                 Job& job) {
  Image images[2];
  for (std::uint64_t i : {0, 1}) {
    PathOptions options;
    options.bounces = bounces, options.seed = 11 + i;
    ReferenceImage image(tracer, camera, size, size, options);
    image.add(samples, job);
    images[i] = image.radiance();
  }
  return {images[0], images[1], bothMasks(coveredPixels(images[0]), coveredPixels(images[1]))};
}

struct Case {
  std::string mesh;
  int samples;  ///< per pixel of each reference: the smaller the floor, the more
  bool always;  ///< also without PRT_FULL
};
class InterpolatedPictures : public testing::TestWithParam<Case> {};

TEST_P(InterpolatedPictures, StayWithinTheInterpolationFloor) {
  PRT_NEEDS_SHARED_DATA();
  if (!GetParam().always && !fullRun()) GTEST_SKIP() << "part of the full run: set PRT_FULL=1";
  Job job;
  const Model model = test::loadModel(GetParam().mesh);
  const int size = fullRun() ? 384 : 192;
  const Camera camera = frameBox(model.scene->mesh.bounds());
  const FragmentImage view = rasterize(model.scene->mesh, camera, size, size, 4, job);
  const std::vector<std::uint32_t> visible = visibleVertices(model, view);

  for (const int bounces : {0, 3}) {
    TransferSettings settings;
    settings.bounces = bounces, settings.rays = 2048;
    const Transfer transfer = bakeTransfer(model.scene, model.rays, model.samples, settings, job);
    ASSERT_EQ(transfer.form, TransferForm::Diffuse);
    for (const char* probe : {"uffizi_256.hdr", "kloppenheim_05_1k.hdr"}) {
      const Light light = test::loadLight(probe);
      const PathTracer tracer(*model.scene, light.rig, job);
      PathOptions options;
      options.bounces = bounces;
      const std::vector<Rgb> traced =
          irradianceAtSamples(tracer, *model.samples, visible, fullRun() ? 2048 : 1024, options, job).mean;
      std::vector<Rgb> atVertices(model.samples->size(), Rgb(0));
      for (std::size_t i = 0; i < visible.size(); ++i) atVertices[visible[i]] = traced[i];

      const References truth =
          trace(tracer, camera, size, (fullRun() ? 2 : 1) * GetParam().samples, bounces, job);
      RenderInput input{*model.scene, *model.samples, transfer, light.coefficients};
      const Image baked = shade(input, view, camera, job);
      input.irradiance = atVertices;
      const Image ideal = shade(input, view, camera, job);
      const PixelMask inside = bothMasks(truth.inside, coveredPixels(baked));
      const NoiseFreeError floor = noiseFreeError(ideal, truth.first, truth.second, inside);
      const NoiseFreeError error = noiseFreeError(baked, truth.first, truth.second, inside);
      const std::string what = model.name + ", " + light.name + ", " + std::to_string(bounces) + " bounces";
      test::report(what + ", interpolation floor", floor);
      test::report(what + ", picture", error);
      EXPECT_GT(floor.relativeLow(), 0) << what << ": too noisy to tell";
      EXPECT_LE(error.relative(), kBound * floor.relative()) << what;
    }
  }
}

/// On a convex body without bounces nothing is left out: 5 bands of light meet 5 bands of the response, per
/// pixel.
TEST(Pictures, GlossyConvexBodiesAreThePathTracers) {
  PRT_NEEDS_SHARED_DATA();
  Job job;
  const Light light = test::loadLight("kloppenheim_05_1k.hdr");
  for (const float exponent : {3.0f, 40.0f, 1000.0f}) {
    Material material;
    material.model = MaterialModel::Phong;
    material.albedo = {0.2f, 0.1f, 0.05f}, material.specular = Rgb(0.6f, 0.7f, 0.8f),
    material.exponent = exponent;
    const SceneObject object{"ball", std::make_shared<TriMesh>(makeIcosphere({1, 5})), Mat4(1), material};
    const Scene scene = flattenScene({&object, 1});
    const PathTracer tracer(scene, light.rig, job);
    const Camera camera = frameBox(scene.mesh.bounds());
    const References truth = trace(tracer, camera, 128, 128, 0, job);
    Transfer transfer;  // no shadows: light arrives unchanged
    transfer.samples = scene.mesh.vertexCount();
    const SampleSet samples = samplesAtVertices(scene);
    const Image picture = render({scene, samples, transfer, light.coefficients}, camera, 128, 128, 4, job);
    const NoiseFreeError e = noiseFreeError(picture, truth.first, truth.second, truth.inside);
    test::report("ball, exponent " + std::to_string(int(exponent)), e);
    EXPECT_LT(e.relative(), 0.003) << exponent;
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, InterpolatedPictures,
                         testing::Values(Case{"bunny_3k.off", 48, true}, Case{"spot.obj", 64, true},
                                         Case{"blobby.off", 192, true}, Case{"armadillo.off", 64, false},
                                         Case{"happy_buddha.obj", 64, false},
                                         Case{"stanford-bunny.obj", 128, false}),
                         [](const auto& one) { return test::caseName(one.param.mesh); });

}  // namespace
}  // namespace prt
