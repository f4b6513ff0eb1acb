// GL and CPU draw the same picture: within 1/255 after tone mapping on 99.9 % of the pixels off edges.

#include "libprt/gl/scene_renderer.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/generate.h"
#include "libprt/shade/live_renderer.h"
#include "libprt/shade/render.h"
#include "libprt/transport/transfer_bake.h"
#include "tests/gl/gl_test_support.h"
#include "tests/support/atlases.h"
#include "tests/support/off_edges.h"

#include <algorithm>
#include <cmath>

namespace prt::gl {
namespace {

using AgreementTest = test::GlTest;

constexpr int kWidth = 320, kHeight = 200;
constexpr double kAgreeing = 0.999;

struct TestScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const SampleSet> samples;
  std::shared_ptr<const RayScene> rays;
  LightRig lights;
  ShRgb coefficients;  // of the environment, not turned
  Camera camera;
};

// A vase and a rock on a ground, one glossy, one coarse, one two-sided.
TestScene makeTestScene(bool twoSided) {
  const auto shared = [](TriMesh mesh) { return std::make_shared<const TriMesh>(std::move(mesh)); };
  const auto placed = [](const Vec3& at) {
    Mat4 m(1);
    m[3] = Vec4(at, 1);
    return m;
  };
  const Material clay{.albedo = Rgb(0.7f, 0.4f, 0.3f)};
  const Material glossy{
      .model = MaterialModel::Phong, .albedo = Rgb(0.1f, 0.2f, 0.3f), .specular = Rgb(0.6f), .exponent = 40};
  const Material sharp{.model = MaterialModel::Phong,
                       .albedo = Rgb(0.2f),
                       .specular = Rgb(0.3f, 0.5f, 0.2f),
                       .exponent = 900,
                       .twoSided = twoSided};
  const SceneObject objects[] = {
      {"vase", shared(makeVase({.segments = 24, .rings = 32})), placed(Vec3(-0.4f, 0, 0)), clay},
      {"rock", shared(makeRock({.radius = 0.35f, .subdivisions = 3})), placed(Vec3(0.45f, 0.3f, 0.1f)),
       glossy},
      {"ground", shared(makePlane({.width = 4, .depth = 4, .columns = 12, .rows = 12})), Mat4(1), sharp}};
  TestScene s;
  s.scene = std::make_shared<Scene>(flattenScene(objects));
  s.samples = std::make_shared<SampleSet>(samplesAtVertices(*s.scene));
  s.rays = std::make_shared<RayScene>(*s.scene);
  s.lights.environment = std::make_shared<EnvironmentMap>(clearSky({}, 256, 128));
  s.coefficients = projectEnvironment(*s.lights.environment, 8);
  s.camera.eye = Vec3(1.2f, 1.3f, 2.2f);
  s.camera.target = Vec3(0, 0.35f, 0);
  return s;
}

const TestScene& twoSidedScene() {
  static const TestScene scene = makeTestScene(true);
  return scene;
}

const TestScene& oneSidedScene() {
  static const TestScene scene = makeTestScene(false);
  return scene;
}

ShRgb lightOf(const TestScene& s, const LightRig& rig, int bands) {
  ShRgb environment(bands);
  std::copy_n(s.coefficients.c.begin(), environment.c.size(), environment.c.begin());
  return projectLights(rig, environment);
}

Transfer bake(const TestScene& s, TransferForm form, int bands, int bounces) {
  TransferSettings settings;
  settings.form = form;
  settings.bands = bands;
  settings.rays = 64;
  settings.bounces = bounces;
  settings.shadows = form != TransferForm::None;
  Job job;
  return bakeTransfer(s.scene, s.rays, s.samples, settings, job);
}

void expectAgreement(const TestScene& s, const Transfer& transfer, const LightRig& rig, const char* what) {
  const ShRgb light = lightOf(s, rig, transfer.bands);
  const ToneSettings tone{.exposure = 0.3f, .curve = ToneCurve::Filmic};
  Job job;
  const Image cpu = toDisplay(prt::render({.scene = *s.scene,
                                           .samples = *s.samples,
                                           .transfer = transfer,
                                           .light = light,
                                           .background = &rig},
                                          s.camera, kWidth, kHeight, 1, job),
                              tone);

  static SceneRenderer renderer;
  renderer.setScene(*s.scene, *s.samples);
  if (rig.environment) renderer.setEnvironment(*rig.environment);
  renderer.setLight(surfaceLight(transfer, light, *s.samples));
  Picture picture{.camera = s.camera, .width = kWidth, .height = kHeight, .samples = 1};
  picture.environmentRotation = rig.rotation;
  picture.environmentIntensity = rig.environment ? rig.intensity : 0;
  picture.circles = rig.circles;
  picture.constant = rig.constant;
  picture.tone = tone;
  const Image gl = renderer.renderToned(picture);

  const std::vector<bool> off =
      test::offEdges(s.scene->mesh, s.scene->triangleObject, s.camera, kWidth, kHeight);
  int compared = 0, agreeing = 0;
  float worst = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!off[std::size_t(y * kWidth + x)]) continue;
      const Rgb d = abs(gl.rgb(x, y) - cpu.rgb(x, y));
      const float difference = std::max({d.x, d.y, d.z});
      ++compared;
      agreeing += difference <= 1.0f / 255;
      worst = std::max(worst, difference);
    }
  EXPECT_GT(compared, kWidth * kHeight * 3 / 4);
  EXPECT_GE(double(agreeing) / compared, kAgreeing)
      << what << ": worst difference " << worst * 255 << " / 255";
}

LightRig turned(const TestScene& s, float degreesOfRotation) {
  LightRig rig = s.lights;
  rig.rotation = float(radians(degreesOfRotation));
  rig.intensity = 0.8f;
  return rig;
}

TEST_F(AgreementTest, Unshadowed) {
  const TestScene& s = twoSidedScene();
  expectAgreement(s, bake(s, TransferForm::None, 5, 0), turned(s, 0), "none");
}

TEST_F(AgreementTest, DiffuseVectors) {
  const TestScene& s = twoSidedScene();
  expectAgreement(s, bake(s, TransferForm::Diffuse, 5, 0), turned(s, 0), "diffuse");
  expectAgreement(s, bake(s, TransferForm::Diffuse, 4, 2), turned(s, 130), "diffuse with bounces, turned");
}

TEST_F(AgreementTest, GlossyWithVisibility) {
  const TestScene& s = twoSidedScene();
  expectAgreement(s, bake(s, TransferForm::Visibility, 5, 0), turned(s, 40), "visibility");
}

TEST_F(AgreementTest, GlossyWithMatrices) {
  const TestScene& s = twoSidedScene();
  expectAgreement(s, bake(s, TransferForm::Matrix, 5, 1), turned(s, -75), "matrix");
  expectAgreement(s, bake(s, TransferForm::Matrix, 7, 0), turned(s, 10), "matrix of 7 bands");
}

// A large light and a small one in the picture, over the map and over nothing.
LightRig withCircles(const TestScene& s, LightRig rig) {
  const Vec3 ahead = normalize(s.camera.target - s.camera.eye);
  rig.circles = {{normalize(ahead + Vec3(0.25f, 0.32f, 0)), float(radians(9.0)), Rgb(2, 0.5f, 0.25f)},
                 {normalize(ahead + Vec3(-0.3f, 0.35f, 0)), float(radians(1.2)), Rgb(0, 3, 1)}};
  rig.constant = Rgb(0.1f, 0.05f, 0.2f);
  return rig;
}

TEST_F(AgreementTest, CirclesAndConstantLightBehindTheModel) {
  const TestScene& s = oneSidedScene();
  const Transfer transfer = bake(s, TransferForm::Diffuse, 4, 0);
  LightRig rig = withCircles(s, turned(s, 200));
  expectAgreement(s, transfer, rig, "over a map");
  rig.environment.reset();
  expectAgreement(s, transfer, rig, "over nothing");
}

TEST_F(AgreementTest, ParallelRays) {
  TestScene s = twoSidedScene();
  s.camera.orthographic = true;
  expectAgreement(s, bake(s, TransferForm::Matrix, 5, 1), turned(s, 40), "matrix");
}

// Without back sides coefficients are interpolated on their way to the pixels, as long as they fit.
TEST_F(AgreementTest, GlossyWithoutBackSides) {
  const TestScene& s = oneSidedScene();
  ASSERT_TRUE(s.samples->back.empty());
  expectAgreement(s, bake(s, TransferForm::Matrix, 5, 1), turned(s, 20), "matrix");
  expectAgreement(s, bake(s, TransferForm::Matrix, 3, 0), turned(s, 170), "matrix of 3 bands");
  expectAgreement(s, bake(s, TransferForm::Visibility, 8, 0), turned(s, 0), "visibility of 8 bands");
}

// The same scene with transfer at the texels of its charts.
TestScene atTexels(TestScene s) {
  s.samples = test::texelSamples(*s.scene, 96);
  return s;
}

TEST_F(AgreementTest, AtTexels) {
  const TestScene s = atTexels(twoSidedScene());
  expectAgreement(s, bake(s, TransferForm::None, 5, 0), turned(s, 0), "none at texels");
  expectAgreement(s, bake(s, TransferForm::Diffuse, 5, 1), turned(s, 30), "diffuse at texels");
  expectAgreement(s, bake(s, TransferForm::Visibility, 4, 0), turned(s, 80), "visibility at texels");
  expectAgreement(s, bake(s, TransferForm::Matrix, 3, 1), turned(s, 160), "matrix at texels");
}

TEST_F(AgreementTest, AtTexelsWithoutBackSides) {
  const TestScene s = atTexels(oneSidedScene());
  ASSERT_TRUE(s.samples->back.empty());
  expectAgreement(s, bake(s, TransferForm::Diffuse, 4, 0), turned(s, 30), "diffuse at texels");
  expectAgreement(s, bake(s, TransferForm::Visibility, 5, 0), turned(s, 80), "visibility at texels");
}

// What the studio's two canvases show: grid and smooth background included.
TEST_F(AgreementTest, LiveRendererWithBackgroundAndGrid) {
  TestScene s = oneSidedScene();
  const auto transfer = std::make_shared<const Transfer>(bake(s, TransferForm::Matrix, 5, 1));
  const LightRig rig = withCircles(s, turned(s, 70));
  const ShRgb light = lightOf(s, rig, 5);
  SceneRenderer gl;
  gl.setScene(*s.scene);
  gl.setEnvironment(*rig.environment);
  gl.setLight(surfaceLight(*transfer, light, *s.samples));
  LiveRenderer live;
  for (const bool parallel : {false, true})
    for (const bool plain : {false, true}) {
      s.camera.orthographic = parallel;
      Picture picture{.camera = s.camera, .width = kWidth, .height = kHeight, .samples = 1};
      picture.background = plain ? Background::Black : Background::Environment;
      picture.behind = Rgb(0.16f);
      picture.environmentRotation = rig.rotation;
      picture.environmentIntensity = rig.intensity;
      picture.smoothEnvironment = true;
      picture.circles = rig.circles;
      picture.constant = rig.constant;
      picture.gridSpacing = 0.1f;
      const Image expected = gl.renderToned(picture);
      LiveScene scene{
          s.scene,      s.samples,    transfer, s.scene->materials, light, plain ? nullptr : rig.environment,
          rig.rotation, rig.intensity};
      if (!plain) scene.circles = rig.circles, scene.constant = rig.constant;
      std::vector<std::uint32_t> pixels(std::size_t(kWidth * kHeight));
      Job job;
      live.draw(
          scene,
          {.camera = s.camera, .width = kWidth, .height = kHeight, .behind = Rgb(0.16f), .gridSpacing = 0.1f},
          pixels, job);
      int differ = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          for (int c = 0; c < 3; ++c) {
            const float value = float(pixels[std::size_t(y * kWidth + x)] >> (16 - 8 * c) & 255);
            differ += std::abs(value - 255 * expected.pixel(x, y)[c]) > 2;
          }
      EXPECT_LT(differ, 3 * kWidth * kHeight / 100)
          << (parallel ? "parallel" : "pinhole") << (plain ? ", plain" : ", environment");
    }
}

}  // namespace
}  // namespace prt::gl
