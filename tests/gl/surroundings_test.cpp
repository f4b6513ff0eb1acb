// Objects around a model: GL and CPU draw the same picture of them, within 1/255 after tone mapping on 99.5 %
// of the pixels off edges.

#include "libprt/shade/surroundings.h"

#include "libprt/gl/scene_renderer.h"
#include "libprt/light/projection.h"
#include "libprt/shade/render.h"
#include "tests/gl/gl_test_support.h"
#include "tests/support/off_edges.h"
#include "tests/support/patched_world.h"

#include <algorithm>

namespace prt::gl {
namespace {

using SurroundingsTest = test::GlTest;

constexpr int kWidth = 240, kHeight = 160;

std::shared_ptr<const TriMesh> shared(TriMesh mesh) {
  return std::make_shared<const TriMesh>(std::move(mesh));
}

/// A glossy ball in front and a two-sided sheet that cuts through the model.
std::vector<SceneObject> around() {
  Material gloss = test::lambert(Rgb(0.4f, 0.5f, 0.6f));
  gloss.model = MaterialModel::Phong, gloss.specular = Rgb(0.4f), gloss.exponent = 20;
  Material sheet = test::lambert(Rgb(0.7f, 0.2f, 0.2f));
  sheet.twoSided = true;
  return {{"ball", shared(test::sphere(24, 48, 0.6f, {0.7f, 0.5f, 0.9f})), Mat4(1), gloss},
          {"sheet", shared(test::grid({-1.5f, -1, -0.8f}, {3, 0, 0.5f}, {0, 2, 0}, 5, 5)), Mat4(1), sheet}};
}

Surroundings litSurroundings(std::vector<Rgb> emission, const ShRgb& light) {
  Surroundings s{std::make_shared<const Scene>(flattenScene(around()))};
  s.samples = bareSamples(*s.scene);
  s.emission = std::move(emission), s.light = light;
  return s;
}

void expectAgreement(const Image& cpu, const Image& gl, const Scene& all, const Camera& camera,
                     const char* what) {
  const std::vector<bool> off = test::offEdges(all.mesh, all.triangleObject, camera, kWidth, kHeight);
  int compared = 0, agreeing = 0, around = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!off[std::size_t(y * kWidth + x)]) continue;
      const Rgb d = abs(gl.rgb(x, y) - cpu.rgb(x, y));
      ++compared;
      agreeing += std::max({d.x, d.y, d.z}) <= 1.0f / 255;
      around += cpu.rgb(x, y).x > 0;
    }
  EXPECT_GT(compared, kWidth * kHeight / 2) << what;
  EXPECT_GT(around, kWidth * kHeight / 12) << what;
  EXPECT_GE(double(agreeing) / compared, 0.995) << what;
}

TEST_F(SurroundingsTest, BesideAModelAndBesideAPatch) {
  const test::PatchedWorld world(test::sceneOf(test::rock(32)), test::variedRtt(6, 4, 3));
  const Scene& model = *world.scene;
  std::vector<SceneObject> both = around();
  both.push_back({"model", shared(model.mesh), Mat4(1), model.materials[0]});
  const Scene all = flattenScene(both);
  const ShRgb light = test::variedLight();
  const Surroundings near = litSurroundings({Rgb(0.1f, 0.3f, 0), Rgb(0)}, light);
  const Transfer transfer = test::matrices(world.samples.size(), 1);
  const auto surface = std::make_shared<BiscaleSurface>(world.surface());
  Camera front = frameBox(all.mesh.bounds()), parallel = front, behind = front;
  parallel.orthographic = true;
  behind.eye = behind.target - Vec3(0.6f, -0.3f, 1) * length(front.eye - front.target);
  SceneRenderer renderer;
  Job job;
  const ToneSettings tone;
  for (const Camera& camera : {front, parallel, behind}) {
    Picture picture{.camera = camera, .width = kWidth, .height = kHeight, .samples = 1};
    renderer.setScene(model, world.samples);
    renderer.setLight(surfaceLight(transfer, light, world.samples));
    renderer.setSurroundings(near);
    RenderInput input{model, world.samples, transfer, light};
    input.surroundings = &near;
    expectAgreement(toDisplay(render(input, camera, kWidth, kHeight, 1, job), tone),
                    renderer.renderToned(picture), all, camera, "model");
    renderer.setPatch(surface);
    renderer.setPatchLight(world.samples, transfer, light, job);
    const BiscaleInput biscale{*surface, world.samples, transfer, light, nullptr, true, &near};
    expectAgreement(toDisplay(renderBiscale(biscale, camera, kWidth, kHeight, 1, job), tone),
                    renderer.renderToned(picture), all, camera, "patch");
    renderer.setPatch(nullptr);
  }
}

TEST_F(SurroundingsTest, AreFollowed) {
  const Scene model = test::sceneOf(test::rock(16));
  const ShRgb light = test::variedLight();
  const Camera camera = frameBox(model.mesh.bounds());
  const Picture picture{.camera = camera, .width = 60, .height = 40, .samples = 1};
  SceneRenderer kept;
  kept.setScene(model);
  kept.setLight(light);
  const Image alone = kept.render(picture);
  ShRgb other = light;
  for (Rgb& c : other.c) c *= 0.5f;
  Surroundings glowing = litSurroundings({Rgb(1), Rgb(0)}, light);
  Image before = alone;
  for (int step = 0; step < 3; ++step) {
    if (step == 1) glowing.emission[0] = Rgb(0, 1, 0);
    if (step == 2) glowing.light = other;
    kept.setSurroundings(glowing);
    SceneRenderer fresh;
    fresh.setScene(model);
    fresh.setLight(light);
    fresh.setSurroundings(glowing);
    const Image image = kept.render(picture);
    EXPECT_EQ(image.data, fresh.render(picture).data) << step;
    EXPECT_NE(image.data, before.data) << step;
    before = image;
  }
  kept.setSurroundings({});
  EXPECT_EQ(kept.render(picture).data, alone.data) << "and they are gone";
}

}  // namespace
}  // namespace prt::gl
