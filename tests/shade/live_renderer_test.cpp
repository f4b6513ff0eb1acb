// The live renderer against the one it stands for, pixel by pixel.

#include "libprt/shade/live_renderer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/generate.h"
#include "libprt/shade/render.h"
#include "libprt/transport/transfer_bake.h"
#include "tests/support/atlases.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace prt {
namespace {

constexpr int kWidth = 150, kHeight = 140;  // several tiles, not a multiple of the lanes

struct World {
  LiveScene live;
  std::shared_ptr<const RayScene> rays;
  LivePicture picture;
};

/// A glossy vase before a ground whose back side, seen at the left, reflects or not.
World makeWorld(bool twoSided) {
  const Material clay{.model = MaterialModel::Phong,
                      .albedo = Rgb(0.7f, 0.4f, 0.3f),
                      .specular = Rgb(0.3f, 0.5f, 0.2f),
                      .exponent = 30};
  const Material plain{.albedo = Rgb(0.5f, 0.6f, 0.7f), .twoSided = twoSided};
  Mat4 upright(1);
  upright[3] = Vec4(0, 0, 0, 1);
  const auto shared = [](TriMesh mesh) { return std::make_shared<const TriMesh>(std::move(mesh)); };
  Mat4 tilted(Vec4(0, 1, 0, 0), Vec4(-1, 0, 0, 0), Vec4(0, 0, 1, 0), Vec4(-0.5f, 0.4f, 0, 1));
  const SceneObject objects[] = {
      {"vase", shared(makeVase({.segments = 20, .rings = 24})), upright, clay},
      {"wall", shared(makePlane({.width = 1, .depth = 1, .columns = 5, .rows = 5})), tilted, plain}};
  World w;
  const auto scene = std::make_shared<Scene>(flattenScene(objects));
  w.live.scene = scene;
  w.live.samples = std::make_shared<SampleSet>(samplesAtVertices(*scene));
  w.live.materials = scene->materials;
  w.live.light = projectEnvironment(clearSky({}, 128, 64), 8);
  w.rays = std::make_shared<RayScene>(*scene);
  w.picture = {.camera = frameBox(scene->mesh.bounds()), .width = kWidth, .height = kHeight, .grid = 1};
  w.picture.tone = {.exposure = 0.4f, .curve = ToneCurve::Filmic};
  return w;
}

std::shared_ptr<const Transfer> bake(const World& w, TransferForm form, int bands, int bounces) {
  TransferSettings settings;
  settings.form = form;
  settings.bands = bands;
  settings.rays = 64;
  settings.bounces = bounces;
  settings.shadows = form != TransferForm::None;
  Job job;
  return std::make_shared<Transfer>(bakeTransfer(w.live.scene, w.rays, w.live.samples, settings, job));
}

std::vector<std::uint32_t> drawn(LiveRenderer& renderer, const World& w) {
  std::vector<std::uint32_t> pixels(std::size_t(w.picture.width) * std::size_t(w.picture.height), 1);
  Job job;
  renderer.draw(w.live, w.picture, pixels, job);
  return pixels;
}

int channel(std::uint32_t pixel, int c) {
  return int(pixel >> (16 - 8 * c) & 255);
}

/// Pixels that differ by more than 1/255 from render().
int differing(const World& w, const std::vector<std::uint32_t>& pixels) {
  Scene scene = *w.live.scene;
  scene.materials = w.live.materials;
  Job job;
  const RenderInput input{
      .scene = scene, .samples = *w.live.samples, .transfer = *w.live.transfer, .light = w.live.light};
  const Image expected =
      toDisplay(render(input, w.picture.camera, kWidth, kHeight, w.picture.grid, job), w.picture.tone);
  int count = 0, lit = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint32_t pixel = pixels[std::size_t(y * kWidth + x)];
      bool same = true;
      for (int c = 0; c < 3; ++c)
        same = same && std::abs(float(channel(pixel, c)) - 255 * expected.pixel(x, y)[c]) <= 1;
      count += !same;
      lit += channel(pixel, 1) > 20;
    }
  EXPECT_GT(lit, kWidth * kHeight / 10) << "there is something to compare";
  return count;
}

struct Case {
  TransferForm form;
  int bands, bounces;
};

TEST(LiveRenderer, DrawsWhatTheRendererDraws) {
  for (const bool twoSided : {false, true}) {
    World w = makeWorld(twoSided);
    LiveRenderer renderer;
    for (const Case& c : {Case{TransferForm::None, 5, 0}, Case{TransferForm::Diffuse, 5, 0},
                          Case{TransferForm::Visibility, 5, 0}, Case{TransferForm::Matrix, 5, 1},
                          Case{TransferForm::Matrix, 3, 0}, Case{TransferForm::Matrix, 6, 0},
                          Case{TransferForm::Matrix, 8, 0}}) {
      w.live.transfer = bake(w, c.form, c.bands, c.bounces);
      EXPECT_EQ(differing(w, drawn(renderer, w)), 0)
          << int(c.form) << " " << c.bands << (twoSided ? " two-sided" : "");
    }
  }
}

TEST(LiveRenderer, DrawsWhatTheRendererDrawsAtTexels) {
  for (const bool twoSided : {false, true}) {
    World w = makeWorld(twoSided);
    w.live.samples = test::texelSamples(*w.live.scene, 64);
    LiveRenderer renderer;
    for (const Case& c : {Case{TransferForm::None, 5, 0}, Case{TransferForm::Diffuse, 5, 1},
                          Case{TransferForm::Visibility, 4, 0}, Case{TransferForm::Matrix, 3, 0}}) {
      w.live.transfer = bake(w, c.form, c.bands, c.bounces);
      EXPECT_EQ(differing(w, drawn(renderer, w)), 0)
          << int(c.form) << " " << c.bands << (twoSided ? " two-sided" : "");
    }
  }
}

TEST(LiveRenderer, FollowsEveryChange) {
  World w = makeWorld(true);
  w.live.transfer = bake(w, TransferForm::Matrix, 5, 0);
  LiveRenderer kept;
  const auto expectFresh = [&](const char* what) {
    LiveRenderer fresh;
    const auto now = drawn(kept, w);
    EXPECT_EQ(now, drawn(fresh, w)) << what;
    return now;
  };
  const auto first = expectFresh("the first");
  const auto changes = [&](const char* what, auto change) {
    change();
    EXPECT_NE(expectFresh(what), first) << what;
  };
  changes("light", [&] {
    for (Rgb& c : w.live.light.c) c *= 0.5f;
  });
  changes("exponent", [&] { w.live.materials[0].exponent = 400; });
  changes("one side", [&] { w.live.materials[1].twoSided = false; });
  changes("camera", [&] { w.picture.camera.eye.x += 0.2f; });
  changes("parallel rays", [&] { w.picture.camera.orthographic = true; });
  changes("transfer", [&] { w.live.transfer = bake(w, TransferForm::Matrix, 4, 1); });
  changes("exposure", [&] { w.picture.tone.exposure = 1; });
  changes("curve", [&] { w.picture.tone.curve = ToneCurve::Linear; });
  changes("behind", [&] { w.picture.behind = Rgb(0.5f); });
  changes("size", [&] { w.picture.width = 64; });
  changes("grid", [&] { w.picture.grid = 4; });
  changes("no transfer", [&] { w.live.transfer = nullptr; });
}

TEST(LiveRenderer, ManySamplesSmoothOnlyEdges) {
  World w = makeWorld(false);
  w.live.transfer = bake(w, TransferForm::Matrix, 5, 0);
  LiveRenderer renderer;
  w.picture.behind = Rgb(1);
  const auto one = drawn(renderer, w);
  w.picture.grid = 4;
  const auto many = drawn(renderer, w);
  int far = 0, between = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    far += std::abs(channel(one[i], 0) - channel(many[i], 0)) > 12;
    between += one[i] != many[i];
  }
  EXPECT_GT(between, 0);
  EXPECT_LT(far, int(one.size()) / 20);
}

TEST(LiveRenderer, TheEnvironmentStandsBehindAndTurns) {
  World w = makeWorld(false);
  w.live.scene = nullptr;
  w.live.environment = std::make_shared<EnvironmentMap>(clearSky({}, 1024, 512));
  w.live.environmentRotation = 0.7f;
  w.live.environmentIntensity = 1.5f;
  w.picture.camera.verticalFov = 1.5f;
  LiveRenderer renderer;
  const auto pixels = drawn(renderer, w);
  LightRig rig;
  rig.environment = w.live.environment;
  rig.rotation = 0.7f;
  rig.intensity = 1.5f;
  const CameraRays rays(w.picture.camera, kWidth, kHeight);
  int differ = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Rgb expected =
          toDisplay(radiance(rig, rays.direction(float(x) + 0.5f, float(y) + 0.5f)), w.picture.tone);
      for (int c = 0; c < 3; ++c)
        differ += std::abs(float(channel(pixels[std::size_t(y * kWidth + x)], c)) - 255 * expected[c]) > 3;
    }
  EXPECT_LT(differ, 3 * kWidth * kHeight / 100) << "a sky is smooth but at the sun";
}

TEST(LiveRenderer, BitsDoNotDependOnThreads) {
  World w = makeWorld(true);
  w.live.transfer = bake(w, TransferForm::Matrix, 5, 0);
  LiveRenderer one, many;
  setThreadCount(1);
  const auto alone = drawn(one, w);
  setThreadCount(5);
  EXPECT_EQ(alone, drawn(many, w));
  setThreadCount(0);
}

TEST(LiveRenderer, RefusesTransferOfAnotherScene) {
  World w = makeWorld(false);
  auto other = std::make_shared<Transfer>(*bake(w, TransferForm::Diffuse, 5, 0));
  other->samples -= 1;
  w.live.transfer = other;
  LiveRenderer renderer;
  std::vector<std::uint32_t> pixels(std::size_t(kWidth * kHeight));
  Job job;
  EXPECT_THROW(renderer.draw(w.live, w.picture, pixels, job), ValueError);
  EXPECT_THROW(renderer.draw(w.live, w.picture, std::span(pixels).first(5), job), ValueError);
}

TEST(DisplayTable, IsTheToneCurveInEightBits) {
  for (const ToneCurve curve : {ToneCurve::Linear, ToneCurve::Filmic}) {
    const ToneSettings tone{.exposure = -0.7f, .curve = curve};
    const DisplayTable table(tone);
    for (float x = 1e-6f; x < 1e4f; x *= 1.0007f)
      ASSERT_NEAR(float(table(x)), 255 * toDisplay(Rgb(x), tone).x, 0.65f) << x;
    EXPECT_EQ(table(-1), 0);
    EXPECT_EQ(table(0), 0);
    EXPECT_EQ(table(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(table(std::numeric_limits<float>::infinity()), 255);
  }
}

}  // namespace
}  // namespace prt
