// GL and CPU draw the same patched surface: within 1/255 after tone mapping on 99.5 % of the pixels off
// edges.

#include "libprt/gl/biscale_pass.h"

#include "libprt/core/error.h"
#include "libprt/gl/scene_renderer.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/mesh/generate.h"
#include "libprt/shade/live_renderer.h"
#include "tests/gl/gl_test_support.h"
#include "tests/support/off_edges.h"
#include "tests/support/patch_covers.h"

#include <algorithm>
#include <cmath>

namespace prt::gl {
namespace {

using BiscalePassTest = test::GlTest;
using test::kBands;
using test::matrices;
using test::PatchedWorld;
using test::variedLight;
using test::variedRtt;

constexpr int kWidth = 160, kHeight = 120;
constexpr double kAgreeing = 0.995;

Camera camera() {
  Camera c;
  c.eye = {1.2f, 1.4f, 3.4f};
  return c;
}

struct Case {
  const char* what;
  std::shared_ptr<const BiscaleSurface> surface;
  SampleSet samples;
  Transfer transfer;
  ShRgb light;
  Camera camera;
  bool viewDependent = true;
  int width = kWidth, height = kHeight;
};

Case caseOf(const char* what, const PatchedWorld& world, Transfer transfer) {
  return {what,          std::make_shared<BiscaleSurface>(world.surface()),
          world.samples, std::move(transfer),
          variedLight(), camera()};
}

Image glPicture(const Case& c, const ToneSettings& tone) {
  static SceneRenderer renderer;
  Job job;
  renderer.setScene(*c.surface->scene);
  renderer.setPatch(c.surface);
  renderer.setPatchLight(c.samples, c.transfer, c.light, job);
  Picture picture{.camera = c.camera, .width = c.width, .height = c.height, .samples = 1};
  picture.viewDependent = c.viewDependent;
  picture.tone = tone;
  return renderer.renderToned(picture);
}

void expectAgreement(const Case& c) {
  const ToneSettings tone{.exposure = 0.3f, .curve = ToneCurve::Filmic};
  Job job;
  const Image cpu =
      toDisplay(renderBiscale({*c.surface, c.samples, c.transfer, c.light, nullptr, c.viewDependent},
                              c.camera, c.width, c.height, 1, job),
                tone);
  const Image gl = glPicture(c, tone);
  const Scene& scene = *c.surface->scene;
  const std::vector<bool> off = test::offEdges(scene.mesh, scene.triangleObject, c.camera, c.width, c.height);
  int compared = 0, seen = 0, agreeing = 0;
  float worst = 0;
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      if (!off[std::size_t(y * c.width + x)] || cpu.pixel(x, y)[3] == 0) continue;
      const Rgb a = gl.rgb(x, y), b = cpu.rgb(x, y), d = abs(a - b);
      const float difference = std::max({d.x, d.y, d.z});
      ++compared;
      seen += b != Rgb(0);
      agreeing += difference <= 1.0f / 255;
      worst = std::max(worst, difference);
    }
  EXPECT_GT(compared, c.width * c.height / 8) << c.what;
  EXPECT_GT(seen, compared * 9 / 10) << c.what << ": not black";
  EXPECT_GE(double(agreeing) / compared, kAgreeing)
      << c.what << ": worst difference " << worst * 255 << " / 255";
}

TEST_F(BiscalePassTest, ByAnIdMap) {
  for (const int channels : {1, 3}) {
    const PatchedWorld world(test::sceneOf(test::rock(24)), variedRtt(6, 4, channels), channels == 3);
    Case c = caseOf(channels == 1 ? "id map" : "id map, three channels and turned frames", world,
                    matrices(world.samples.size(), channels));
    expectAgreement(c);
    c.viewDependent = false;
    c.what = "id map, not view dependent";
    expectAgreement(c);
    c.viewDependent = true;
    c.camera.orthographic = true;
    c.what = "id map, parallel rays";
    expectAgreement(c);
  }
}

TEST_F(BiscalePassTest, ByTheMeshsOwnCoordinates) {
  PatchedWorld world(test::sceneOf(makeVase({.segments = 24, .rings = 32})), variedRtt(8, 3, 3));
  const std::shared_ptr<const TriMesh> mesh(world.scene, &world.scene->mesh);
  world.cover = std::make_shared<PatchCover>(mesh, squareRepeat(*mesh, 5));
  Case c = caseOf("vase", world, matrices(world.samples.size(), 1));
  c.camera.target = {0, 0.35f, 0};
  c.camera.eye = {0.5f, 0.9f, 1.4f};
  expectAgreement(c);
  c.transfer = Transfer{};
  c.what = "vase without macro transport";
  expectAgreement(c);
}

TEST_F(BiscalePassTest, LayersOverEachOther) {
  for (const int layers : {1, 3})
    for (const int channels : {1, 3}) {
      PatchedWorld world(test::sceneOf(test::rock(20)), variedRtt(6, 4, channels));
      world.cover = test::coverBy(*world.scene, 128, test::byPlace);
      world.layer(layers);
      Case c = caseOf(layers == 1 ? "a layer" : "three layers", world, matrices(world.samples.size(), 1));
      expectAgreement(c);
      if (channels == 3) continue;
      auto surface = std::make_shared<BiscaleSurface>(*c.surface);
      Job job;
      surface->filter = std::make_shared<PatchFilter>(surface->cover, world.rtt, job);
      c.surface = surface;
      c.what = "layers, filtered";
      c.width = 80, c.height = 60;
      expectAgreement(c);
    }
}

// The compute shader's light is the CPU's: what is left are halfs.
TEST_F(BiscalePassTest, TransferKeptOnTheCardGivesTheSamePicture) {
  for (const int channels : {1, 3}) {
    const PatchedWorld world(test::sceneOf(test::rock(20)), variedRtt(6, 4, channels), true);
    const Transfer transfer = matrices(world.samples.size(), channels);
    const auto surface = std::make_shared<BiscaleSurface>(world.surface());
    SceneRenderer renderer;
    Job job;
    const auto keep = [&](const SampleSet& samples, const Transfer& kept) {
      return renderer.keepPatchTransfer(
          turnedTransfer(*surface, samples, kept, TransferPass::mostBytes(), job));
    };
    EXPECT_FALSE(keep(world.samples, transfer)) << "there is no patch yet";
    renderer.setScene(*world.scene);
    renderer.setPatch(surface);
    const Picture picture{.camera = camera(), .width = 80, .height = 60, .samples = 1};
    const auto differ = [&](const ShRgb& light) {
      renderer.setPatchLight(world.samples, transfer, light, job);
      const Image expected = renderer.render(picture);
      renderer.setPatchLight(ShRgb(kBands));  // black
      EXPECT_EQ(renderer.render(picture).rgb(40, 30), Rgb(0));
      renderer.setPatchLight(light);
      const Image got = renderer.render(picture);
      float most = 0;
      for (std::size_t i = 0; i < got.data.size(); ++i)
        most = std::max(most, std::abs(got.data[i] - expected.data[i]));
      EXPECT_GT(expected.rgb(40, 30).x, 0.1f);
      return most;
    };
    ASSERT_TRUE(keep(world.samples, transfer));
    EXPECT_LT(differ(variedLight()), 5e-3f);
    ShRgb fewer(3);  // bands that light lacks are dark
    std::copy_n(variedLight().c.begin(), 9, fewer.c.begin());
    EXPECT_LT(differ(fewer), 5e-3f);
    Transfer none;
    EXPECT_FALSE(keep(world.samples, none));
    EXPECT_TRUE(turnedTransfer(*surface, world.samples, transfer, 1000, job).empty()) << "more than may be";
    EXPECT_THROW(keep(world.samples, matrices(3, 1)), ValueError);
  }
}

Scene rockOnGround() {
  const auto shared = [](TriMesh mesh) { return std::make_shared<const TriMesh>(std::move(mesh)); };
  Mat4 lower(1);
  lower[3] = Vec4(0, -1, 0, 1);
  const SceneObject objects[] = {{"rock", shared(test::rock(20)), Mat4(1), test::lambert(Rgb(0.5f))},
                                 {"ground", shared(test::grid({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 8, 8)),
                                  lower, test::lambert(Rgb(0.5f))}};
  return flattenScene(objects);
}

TEST_F(BiscalePassTest, OnAGroundAndInOneView) {
  const PatchedWorld ground(rockOnGround(), variedRtt(5, 1, 1));
  expectAgreement(caseOf("rock on a ground", ground, matrices(ground.samples.size(), 1)));
}

TEST_F(BiscalePassTest, ObjectsWithoutThePatchShowTheirMaterial) {
  for (const int channels : {1, 3})
    for (const bool glossy : {false, true}) {
      Scene scene = rockOnGround();
      scene.materials[1].albedo = Rgb(0.7f, 0.4f, 0.2f);
      if (glossy)
        scene.materials[1].model = MaterialModel::Phong, scene.materials[1].specular = Rgb(0.2f, 0.3f, 0.1f);
      const Rtt rtt = variedRtt(5, 2, channels);
      PatchedWorld world(std::move(scene), rtt);
      world.cover = test::coverBy(*world.scene, 128, test::byPlace);
      world.carry({true, false});
      Case c = caseOf(glossy ? "a glossy ground without the patch" : "a matte ground without the patch",
                      world, matrices(world.samples.size(), 1));
      expectAgreement(c);
      c.viewDependent = false;
      expectAgreement(c);
      c.viewDependent = true;
      auto surface = std::make_shared<BiscaleSurface>(*c.surface);
      Job job;
      surface->filter = std::make_shared<PatchFilter>(surface->cover, rtt, job);
      c.surface = surface;
      c.what = "a ground without the patch, filtered";
      c.width = 80, c.height = 60;
      expectAgreement(c);
    }
}

// The next surface of the same scene: only the materials beside the patch are another.
TEST_F(BiscalePassTest, FollowsTheMaterialsBesideThePatch) {
  PatchedWorld world(rockOnGround(), variedRtt(5, 1, 1));
  SceneRenderer renderer;
  Job job;
  renderer.setScene(*world.scene);
  auto surface = std::make_shared<BiscaleSurface>(world.surface());
  const Transfer transfer = matrices(world.samples.size(), 1);
  Picture picture{.camera = camera(), .width = 40, .height = 30, .samples = 1};
  picture.camera.eye = {1.2f, 2.4f, 6.0f};  // with ground before the rock
  const auto ground = [&](const std::shared_ptr<const PlainObjects>& plain) {
    surface = std::make_shared<BiscaleSurface>(*surface);
    surface->plain = plain;
    renderer.setPatch(surface);
    renderer.setPatchLight(world.samples, transfer, variedLight(), job);
    return renderer.render(picture).rgb(20, 27);
  };
  std::vector<Material> materials = world.scene->materials;
  const auto plainOf = [&](Rgb albedo) {
    materials[1].albedo = albedo;
    return std::make_shared<PlainObjects>(*world.scene, std::vector<bool>{true, false}, materials,
                                          world.rtt.bands);
  };
  const Rgb patched = ground(nullptr), bright = ground(plainOf(Rgb(0.8f))), dark = ground(plainOf(Rgb(0.2f)));
  EXPECT_GT(dark.x, 0.01f);
  EXPECT_GT(distance(patched, bright), 0.01f);
  EXPECT_NEAR(bright.x / dark.x, 4, 0.02);
  EXPECT_EQ(ground(nullptr), patched);
}

TEST_F(BiscalePassTest, FilteredInSpace) {
  const Rtt rtt = test::contrastedRtt();
  PatchedWorld rock(test::sceneOf(test::rock(20)), rtt);
  rock.cover = test::coverBy(*rock.scene, 256, test::byPlace);
  PatchedWorld vase(test::sceneOf(makeVase({.segments = 24, .rings = 32})), test::variedRtt(6, 2, 3));
  const std::shared_ptr<const TriMesh> mesh(vase.scene, &vase.scene->mesh);
  vase.cover = std::make_shared<PatchCover>(mesh, squareRepeat(*mesh, 12));
  for (const PatchedWorld* world : {&rock, &vase}) {
    Case c = caseOf(world == &rock ? "filtered by an id map" : "filtered by coordinates", *world,
                    matrices(world->samples.size(), 1));
    auto surface = std::make_shared<BiscaleSurface>(*c.surface);
    Job job;
    surface->filter = std::make_shared<PatchFilter>(surface->cover, world->rtt, job);
    c.surface = surface;
    c.width = 80, c.height = 60;
    if (world == &vase) c.camera.target = {0, 0.35f, 0}, c.camera.eye = {0.5f, 0.9f, 1.4f};
    expectAgreement(c);
    if (world == &vase) continue;
    c.camera.eye = {0.3f, 0.3f, 1.6f};  // magnified here, minified towards the outline
    c.camera.orthographic = true;
    c.what = "filtered, near, parallel rays";
    expectAgreement(c);
  }
}

// What the studio's two canvases show: background and ground grid included, over and over.
TEST_F(BiscalePassTest, TheLiveRenderersShowTheSame) {
  const PatchedWorld world(test::sceneOf(test::rock(20)), variedRtt(6, 4, 3), true);
  Case c = caseOf("live", world, matrices(world.samples.size(), 1));
  const auto map = std::make_shared<const EnvironmentMap>(clearSky({}, 128, 64));
  SceneRenderer gl;
  gl.setScene(*c.surface->scene);
  gl.setEnvironment(*map);
  gl.setPatch(c.surface);
  LiveRenderer live;
  LiveScene scene;
  scene.scene = c.surface->scene, scene.samples = std::make_shared<SampleSet>(c.samples);
  scene.transfer = std::make_shared<Transfer>(c.transfer), scene.materials = c.surface->scene->materials;
  scene.environment = map, scene.patch = c.surface;
  Job job;
  for (const bool viewDependent : {true, false}) {
    scene.light = variedLight();
    scene.light.c[0] *= viewDependent ? 1.0f : 0.5f;
    scene.viewDependent = viewDependent;
    gl.setPatchLight(c.samples, c.transfer, scene.light, job);
    Picture picture{.camera = c.camera, .width = kWidth, .height = kHeight, .samples = 1};
    picture.smoothEnvironment = true;
    picture.gridSpacing = 0.1f;
    picture.viewDependent = viewDependent;
    const Image drawn = gl.renderToned(picture);
    std::vector<std::uint32_t> pixels(std::size_t(kWidth * kHeight));
    live.draw(scene, {.camera = c.camera, .width = kWidth, .height = kHeight, .gridSpacing = 0.1f}, pixels,
              job);
    int differ = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int k = 0; k < 3; ++k) {
          const float value = float(pixels[std::size_t(y * kWidth + x)] >> (16 - 8 * k) & 255);
          differ += std::abs(value - 255 * drawn.pixel(x, y)[k]) > 2;
        }
    EXPECT_LT(differ, 3 * kWidth * kHeight / 100) << viewDependent;
  }
}

TEST_F(BiscalePassTest, WithoutAPatchTheMeshIsDrawnAndWithoutLightNothingShines) {
  const PatchedWorld world(test::sceneOf(test::rock(12)), variedRtt(4, 2, 1));
  const Case c = caseOf("", world, matrices(world.samples.size(), 1));
  SceneRenderer renderer;
  Job job;
  renderer.setScene(*c.surface->scene);
  renderer.setIrradiance(std::vector<Rgb>(c.samples.size(), Rgb(kPiF)));
  const Picture picture{.camera = c.camera, .width = 40, .height = 30, .samples = 1};
  const auto middle = [&] { return renderer.render(picture).rgb(20, 15); };
  EXPECT_NEAR(middle().x, 0.5f, 1e-3f);
  renderer.setPatch(c.surface);
  EXPECT_EQ(middle(), Rgb(0));
  renderer.setPatchLight(c.samples, c.transfer, c.light, job);
  EXPECT_GT(middle().x, 0.1f);
  renderer.setPatch(nullptr);
  EXPECT_NEAR(middle().x, 0.5f, 1e-3f);
}

TEST_F(BiscalePassTest, RefusesWhatHoldsTooLittle) {
  const PatchedWorld world(test::sceneOf(test::rock(8)), variedRtt(4, 2, 1));
  BiscalePass pass;
  pass.setSurface(std::make_shared<BiscaleSurface>(world.surface()));
  Transfer diffuse;
  diffuse.form = TransferForm::Diffuse, diffuse.samples = world.samples.size();
  Job job;
  EXPECT_THROW(pass.setLight(world.samples, diffuse, variedLight(), job), ValueError);
}

}  // namespace
}  // namespace prt::gl
