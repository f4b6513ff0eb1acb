#include "ui/model/relighter.h"

#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/generate.h"
#include "libprt/transport/transfer_bake.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

std::shared_ptr<const Scene> sphereScene() {
  const SceneObject object{"sphere",
                           std::make_shared<const TriMesh>(makeIcosphere({.radius = 1, .subdivisions = 2})),
                           Mat4(1), Material{}};
  return std::make_shared<const Scene>(flattenScene(std::span(&object, 1)));
}

Transfer diffuseTransfer(const std::shared_ptr<const Scene>& scene,
                         const std::shared_ptr<const SampleSet>& samples) {
  TransferSettings settings;
  settings.form = TransferForm::Diffuse;
  settings.bands = 3;
  settings.rays = 64;
  settings.bounces = 0;
  Job job;
  return bakeTransfer(scene, std::make_shared<RayScene>(*scene), samples, settings, job);
}

TEST(Relighter, WithoutTransferTheSurfaceIsLitWithoutShadows) {
  Relighter relighter;
  relighter.setScene(sphereScene());
  LightRig rig;
  rig.constant = Rgb(1);
  relighter.setLights(rig);
  EXPECT_EQ(relighter.surface().form, TransferForm::None);
  EXPECT_NEAR(relighter.light().evaluate(Vec3(0, 1, 0)).x, 1, 1e-5);
}

TEST(Relighter, TransferIsAppliedOncePerChange) {
  const auto scene = sphereScene();
  const auto samples = std::make_shared<const SampleSet>(samplesAtVertices(*scene));
  Relighter relighter;
  int changes = 0;
  QObject::connect(&relighter, &Relighter::changed, [&] { ++changes; });
  relighter.setScene(scene);
  relighter.setSamples(samples);
  relighter.setTransfer(std::make_shared<const Transfer>(diffuseTransfer(scene, samples)));
  LightRig rig;
  rig.constant = Rgb(1, 2, 0);
  relighter.setLights(rig);
  EXPECT_GE(changes, 4);
  ASSERT_EQ(relighter.surface().form, TransferForm::Diffuse);
  const Rgb* first = relighter.surface().irradiance.data();
  EXPECT_NEAR(first->x, kPiF, 0.05f) << "a sphere sees half the sky everywhere";
  EXPECT_NEAR(first->y, 2 * kPiF, 0.1f);
  EXPECT_EQ(relighter.surface().irradiance.data(), first) << "nothing changed, nothing is computed";
  const quint64 version = relighter.lightVersion();
  rig.constant = Rgb(0);
  relighter.setLights(rig);
  EXPECT_GT(relighter.lightVersion(), version);
  EXPECT_EQ(relighter.surface().irradiance[0], Rgb(0));
}

TEST(Relighter, SamplesAndTransferAlwaysFitTogether) {
  const auto oneSided = sphereScene();
  Scene copy = *oneSided;
  copy.materials[0].twoSided = true;
  const auto twoSided = std::make_shared<const Scene>(copy);
  const auto front = std::make_shared<const SampleSet>(samplesAtVertices(*oneSided));
  const auto both = std::make_shared<const SampleSet>(samplesAtVertices(*twoSided));
  ASSERT_GT(both->size(), front->size());
  Relighter relighter;
  LightRig rig;
  rig.constant = Rgb(1);
  relighter.setLights(rig);
  relighter.setScene(oneSided);
  relighter.setSamples(front);
  relighter.setTransfer(std::make_shared<const Transfer>(diffuseTransfer(oneSided, front)));
  EXPECT_EQ(relighter.surface().irradiance.size(), front->size());
  // In the order of a bake; a picture may be drawn at any time between.
  relighter.setScene(twoSided);
  EXPECT_EQ(relighter.surface().irradiance.size(), relighter.samples()->size());
  relighter.setSamples(both);
  EXPECT_EQ(relighter.samples(), front) << "until there is transfer for the others";
  EXPECT_EQ(relighter.surface().irradiance.size(), front->size());
  const quint64 scene = relighter.sceneVersion();
  relighter.setTransfer(std::make_shared<const Transfer>(diffuseTransfer(twoSided, both)));
  EXPECT_EQ(relighter.samples(), both);
  EXPECT_GT(relighter.sceneVersion(), scene);
  EXPECT_EQ(relighter.surface().irradiance.size(), both->size());
  // And back.
  relighter.setSamples(front);
  relighter.setTransfer(std::make_shared<const Transfer>(diffuseTransfer(oneSided, front)));
  EXPECT_EQ(relighter.samples(), front);
}

TEST(Relighter, TurningTheEnvironmentTurnsItsCoefficients) {
  const auto map = std::make_shared<const EnvironmentMap>(softboxStudio(64, 32));
  Relighter relighter;
  relighter.setScene(sphereScene());
  relighter.setEnvironment(map, projectEnvironment(*map, 10), {});
  LightRig rig;
  rig.rotation = 1.1f;
  rig.intensity = 2;
  relighter.setLights(rig);
  EXPECT_EQ(relighter.environment(), map) << "lights leave the map alone";
  rig.environment = map;
  const ShRgb expected = projectLights(rig, 5);
  ASSERT_EQ(relighter.light().c.size(), expected.c.size());
  for (std::size_t k = 0; k < expected.c.size(); ++k)
    EXPECT_LT(length(relighter.light().c[k] - expected.c[k]), 1e-4f);
}

TEST(Relighter, TheRecipesWindowKeepsASunFromRinging) {
  Relighter relighter;
  relighter.setScene(sphereScene());
  LightRig rig;
  rig.circles = {{Vec3(0, 1, 0), 0.02f, Rgb(1000)}};
  const auto darkest = [&] {
    float low = 0;
    for (const Vec3& d : relighter.scene()->mesh.normals)
      low = std::min(low, relighter.light().evaluate(d).x);
    return low;
  };
  relighter.setLights(rig);
  EXPECT_LT(darkest(), -0.05f);
  relighter.setLights(rig, {.window = "dering"});
  EXPECT_GT(darkest(), -0.001f);
}

TEST(Relighter, TheSameGeometryKeepsItsTransferAnotherForgetsIt) {
  const auto scene = sphereScene();
  const auto samples = std::make_shared<const SampleSet>(samplesAtVertices(*scene));
  Relighter relighter;
  relighter.setScene(scene);
  relighter.setSamples(samples);
  relighter.setTransfer(std::make_shared<const Transfer>(diffuseTransfer(scene, samples)));
  relighter.setScene(sphereScene());
  EXPECT_TRUE(relighter.transfer());
  auto moved = std::make_shared<Scene>(*scene);
  moved->mesh.positions[0] += Vec3(0.1f);
  relighter.setScene(moved);
  EXPECT_FALSE(relighter.transfer());
  relighter.setScene(nullptr);
  EXPECT_FALSE(relighter.scene());
}

TEST(Relighter, MaterialsChangeThePictureNotTheLight) {
  Relighter relighter;
  relighter.setScene(sphereScene());
  const quint64 light = relighter.lightVersion(), materials = relighter.materialVersion();
  relighter.setMaterials({Material{.albedo = Rgb(0.1f)}});
  EXPECT_EQ(relighter.lightVersion(), light);
  EXPECT_GT(relighter.materialVersion(), materials);
}

TEST(Relighter, WhatStandsBehindTheModelIsLatLongSharpOrBlurredAndMadeOnce) {
  Relighter relighter;
  EXPECT_FALSE(relighter.backdrop());
  EXPECT_FALSE(relighter.blurredBackdrop());
  const auto map = std::make_shared<const EnvironmentMap>(clearSky({}, 128, 64));
  Job job;
  relighter.setEnvironment(map, projectEnvironment(*map, 5), makeBackdrop(map, job));
  EXPECT_EQ(relighter.backdrop(), map) << "it is lat-long as it is";
  const auto blurred = relighter.blurredBackdrop();
  ASSERT_TRUE(blurred);
  EXPECT_EQ(relighter.blurredBackdrop(), blurred);
  EXPECT_LT(blurred->report().largest, 0.1f * map->report().largest) << "the sun is spread";
  relighter.setEnvironment(nullptr, {}, {});
  EXPECT_FALSE(relighter.blurredBackdrop());
}

TEST(Relighter, LightIsKnownWithoutApplyingTransfer) {
  Relighter relighter;
  LightRig rig;
  rig.constant = Rgb(2);
  relighter.setLights(rig);
  EXPECT_NEAR(relighter.light().evaluate(Vec3(1, 0, 0)).y, 2, 1e-5) << "there is no scene to apply it to";
}

}  // namespace
}  // namespace prt::ui
