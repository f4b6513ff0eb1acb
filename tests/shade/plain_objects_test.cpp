#include "libprt/shade/plain_objects.h"

#include "libprt/core/error.h"
#include "libprt/shade/live_renderer.h"
#include "libprt/shade/render.h"
#include "tests/support/patch_covers.h"
#include "tests/support/patched_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::kBands;
using test::matrices;
using test::variedLight;
using test::variedRtt;
using World = test::PatchedWorld;

constexpr int kWidth = 64, kHeight = 48;

Material coloured(bool glossy) {
  Material m = test::lambert(Rgb(0.7f, 0.4f, 0.2f));
  if (glossy) m.model = MaterialModel::Phong, m.specular = Rgb(0.2f, 0.3f, 0.1f), m.exponent = 12;
  return m;
}

/// Two floors side by side, the right one higher. On planes frames do not turn from vertex to vertex.
Scene floors(const Material& left, const Material& right) {
  const auto floor = [](float x, float y) {
    return std::make_shared<const TriMesh>(test::grid({x, y, 2}, {2, 0, 0}, {0, 0, -4}, 6, 6));
  };
  const SceneObject objects[] = {{"left", floor(-2, 0), Mat4(1), left},
                                 {"right", floor(0.1f, 0.2f), Mat4(1), right}};
  return flattenScene(objects);
}

/// The left floor is in the left half of the picture.
Camera camera() {
  Camera c;
  c.eye = {0, 1.9f, 3.4f};
  return c;
}

/// Largest difference over a half of the picture; `seen` counts its pixels that are not black.
double worst(const Image& a, const Image& b, bool right, int& seen) {
  double most = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = right ? kWidth / 2 + 4 : 0; x < (right ? kWidth : kWidth / 4); ++x)
      for (int c = 0; c < 3; ++c) {
        seen += c == 0 && b.pixel(x, y)[0] > 0.05f;
        most = std::max(most, double(std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c])));
      }
  return most;
}

struct Pictures {
  Image mixed, material, patched;
};

Pictures picturesOf(World& world, bool viewDependent = true) {
  const Transfer transfer = matrices(world.samples.size(), 3);
  const ShRgb light = variedLight();
  Pictures out;
  Job job;
  out.material = render({*world.scene, world.samples, transfer, light, ShadeMethod::Glossy}, camera(), kWidth,
                        kHeight, 2, job);
  out.patched = world.picture(transfer, light, camera(), kWidth, kHeight, viewDependent);
  world.carry({true, false});
  out.mixed = world.picture(transfer, light, camera(), kWidth, kHeight, viewDependent);
  return out;
}

TEST(PlainObjects, ShowTheirMatteMaterialToHalfs) {
  for (const int channels : {1, 3}) {
    World world(floors(coloured(false), coloured(false)), variedRtt(6, 4, channels));
    const Pictures p = picturesOf(world);
    int seen = 0, patched = 0;
    EXPECT_LT(worst(p.mixed, p.material, true, seen), 2e-3) << channels;
    EXPECT_GT(seen, 300);
    EXPECT_EQ(worst(p.mixed, p.patched, false, patched), 0.0) << "the other carries its patch as before";
    EXPECT_GT(patched, 100);
    EXPECT_GT(worst(p.patched, p.material, true, seen), 0.05) << "the two are not alike by themselves";
  }
}

TEST(PlainObjects, ShowTheirGlossFromTheViewer) {
  for (const bool viewDependent : {true, false}) {
    World world(floors(coloured(false), coloured(true)), variedRtt(6, 4, 1));
    const Pictures p = picturesOf(world, viewDependent);
    int seen = 0;
    EXPECT_LT(worst(p.mixed, p.material, true, seen), 6e-3) << viewDependent;  // 32 x 32 views
    EXPECT_GT(seen, 300);
    // Gloss is there: without it the picture is another.
    World matte(floors(coloured(false), coloured(false)), variedRtt(6, 4, 1));
    EXPECT_GT(worst(picturesOf(matte).mixed, p.mixed, true, seen), 0.05);
  }
}

TEST(PlainObjects, AreTheSameInTheLiveRendererAndUnderAFilter) {
  const Rtt rtt = test::contrastedRtt();
  World world(floors(coloured(false), coloured(true)), rtt);
  world.cover = test::coverBy(*world.scene, 128, test::byPlace);
  const Transfer transfer = matrices(world.samples.size(), 1);
  world.carry({true, false});
  Job job;
  auto surface = std::make_shared<BiscaleSurface>(world.surface());
  surface->filter = std::make_shared<PatchFilter>(surface->cover, rtt, job);
  const ShRgb light = variedLight();
  const Image filtered =
      renderBiscale({*surface, world.samples, transfer, light}, camera(), kWidth, kHeight, 1, job);
  surface = std::make_shared<BiscaleSurface>(*surface);
  surface->filter = nullptr;
  const Image sharp =
      renderBiscale({*surface, world.samples, transfer, light}, camera(), kWidth, kHeight, 1, job);
  int seen = 0, changed = 0;
  EXPECT_EQ(worst(filtered, sharp, true, seen), 0.0);
  EXPECT_GT(worst(filtered, sharp, false, changed), 0.01);

  LiveScene scene;
  scene.scene = world.scene, scene.samples = std::make_shared<SampleSet>(world.samples);
  scene.transfer = std::make_shared<Transfer>(transfer), scene.materials = world.scene->materials;
  scene.light = light, scene.patch = surface;
  std::vector<std::uint32_t> pixels(std::size_t(kWidth * kHeight));
  LiveRenderer().draw(scene, {.camera = camera(), .width = kWidth, .height = kHeight}, pixels, job);
  const Image shown = toDisplay(sharp, {});
  for (int y = 0; y < kHeight; ++y)
    for (int x = kWidth / 2 + 4; x < kWidth; ++x)
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(float(pixels[std::size_t(y * kWidth + x)] >> (16 - 8 * k) & 255),
                    255 * shown.pixel(x, y)[k], 1.5f);
}

TEST(PlainObjects, AreOneTexelEach) {
  const Scene scene = floors(coloured(false), coloured(true));
  const PlainObjects both(scene, {false, false}, scene.materials, kBands);
  EXPECT_EQ(both.texelOf(0), 0u);
  EXPECT_EQ(both.texels().back(), 1u);
  EXPECT_EQ(both.responses().views().side(), PlainObjects::kViews);
  const PlainObjects left(scene, {false, true}, scene.materials, kBands);
  EXPECT_EQ(left.texels().back(), PlainObjects::kPatched);
  EXPECT_EQ(left.responses().views().side(), 1) << "a matte material looks the same from everywhere";
  EXPECT_THROW(PlainObjects(scene, {true}, scene.materials, kBands), ValueError);
}

}  // namespace
}  // namespace prt
