#include "libprt/project/scenes.h"
#include "libprt/core/error.h"
#include "libprt/project/lights.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace prt {
namespace {

using testing::Contains;
using testing::HasSubstr;

class BuiltinScene : public testing::TestWithParam<std::string> {};

TEST_P(BuiltinScene, HasEverythingForAPicture) {
  const Recipe recipe = builtinScene(GetParam());
  EXPECT_FALSE(recipe.lights.empty());
  EXPECT_FALSE(recipe.cameras.empty());
  EnvironmentCache cache;
  EXPECT_NE(makeLightRig(recipe.lights, ".", cache).environment, nullptr);
  Job job;
  const auto scene = Pipeline(nullptr, {}).run(recipe, {"scene"}, job).get<SceneProduct>("scene");
  EXPECT_GT(scene->scene->mesh.triangleCount(), 1000u);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene, testing::ValuesIn(builtinSceneNames()),
                         [](const auto& p) { return p.param; });

TEST(Scenes, WhatIsHiddenTakesNoPartAndKeepsItsNumber) {
  Recipe recipe;
  recipe.objects.resize(2);
  recipe.objects[0].mesh.path = "builtin:sphere";
  recipe.objects[0].material.model = MaterialModel::Phong;
  recipe.objects[0].material.specular = Rgb(0.5f);
  recipe.objects[1].mesh.path = "builtin:box";
  recipe.transfer.rays = 16;
  Recipe hidden = recipe, alone = recipe;
  hidden.objects[0].visible = false;
  alone.objects.erase(alone.objects.begin());
  Job job;
  Pipeline pipeline(nullptr, {});
  const auto sceneOf = [&](const Recipe& r) {
    return pipeline.run(r, {"scene"}, job).get<SceneProduct>("scene")->scene;
  };
  const auto all = sceneOf(recipe), rest = sceneOf(hidden), expected = sceneOf(alone);
  EXPECT_GT(all->mesh.triangleCount(), expected->mesh.triangleCount());
  EXPECT_EQ(rest->mesh.positions, expected->mesh.positions);
  EXPECT_EQ(rest->mesh.triangles, expected->mesh.triangles);
  EXPECT_EQ(rest->names.size(), 2u);
  for (const std::uint32_t object : rest->triangleObject) ASSERT_EQ(object, 1u);

  EXPECT_EQ(pipeline.keys(hidden).at("mesh"), pipeline.keys(recipe).at("mesh")) << "it is not read again";
  EXPECT_NE(pipeline.keys(hidden).at("direct"), pipeline.keys(recipe).at("direct"));
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Matrix);
  EXPECT_EQ(resolved(hidden).transfer.kind, TransferKind::Diffuse) << "nothing glossy is seen";
  const auto bake = [&](const Recipe& r) {
    return pipeline.run(r, {"transfer"}, job).get<TransferProduct>("transfer")->transfer.values.bytes;
  };
  EXPECT_EQ(bake(hidden), bake(alone)) << "nor does it throw a shadow";
}

TEST(Scenes, DefaultComesFirst) {
  EXPECT_EQ(builtinSceneNames().front(), "default");
  EXPECT_THAT(builtinSceneNames(), Contains("vase"));
  EXPECT_THROW(builtinScene("nothing"), ValueError);
}

TEST(Scenes, InputsAreToldApart) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(openRecipe("scene:rock").recipe, builtinScene("rock"));
  EXPECT_EQ(openRecipe("builtin:torus").recipe.objects[0].mesh.path, "builtin:torus");
  EXPECT_THROW(openRecipe("builtin:teapot"), ValueError);
  EXPECT_THROW(openRecipe("/nonexistent/a.obj"), FileError);
  EXPECT_THROW(openRecipe(folder.path().string()), FileError);
  std::ofstream(folder / "a.OBJ") << "v 0 0 0\n";
  const RecipeSource mesh = openRecipe((folder / "a.OBJ").string());
  EXPECT_EQ(mesh.recipe.objects[0].mesh.path, "a.OBJ");
  EXPECT_EQ(mesh.folder, folder.path());
  std::ofstream(folder / "b.json") << R"({"transfer": {"bands": 3}})";
  EXPECT_EQ(openRecipe((folder / "b.json").string()).recipe.transfer.bands, 3);
  std::ofstream(folder / "c.txt") << "?";
  EXPECT_THROW(openRecipe((folder / "c.txt").string()), FileError);
}

TEST(Lights, AnglesAreFullAndInDegrees) {
  EnvironmentCache cache;
  LightRecipe light;
  light.kind = LightKind::Circle;
  light.angle = 110;
  light.direction = Vec3(0, 0, -2);
  light.rotation = 90;
  light.radiance = Rgb(1, 2, 3);
  light.intensity = 2;
  const LightRig rig = makeLightRig({&light, 1}, ".", cache);
  ASSERT_EQ(rig.circles.size(), 1u);
  EXPECT_NEAR(rig.circles[0].halfAngle, radians(55), 1e-6);
  EXPECT_NEAR(length(rig.circles[0].direction - Vec3(-1, 0, 0)), 0, 1e-6)
      << "what came from -Z comes from -X";
  EXPECT_EQ(rig.circles[0].radiance, Rgb(2, 4, 6));
}

TEST(Lights, OneEnvironmentAtATime) {
  EnvironmentCache cache;
  std::vector<LightRecipe> lights(2);
  EXPECT_THROW(makeLightRig(lights, ".", cache), ValueError);
  lights[1].intensity = 0;
  EXPECT_NE(makeLightRig(lights, ".", cache).environment, nullptr);
}

TEST(Lights, ALightThatIsOffIsAsIfItWereNotThere) {
  EnvironmentCache cache;
  std::vector<LightRecipe> lights(5);
  lights[1].kind = LightKind::Circle;
  lights[2].kind = LightKind::Directional;
  lights[3].kind = LightKind::Constant;
  lights[4].path = "builtin:overcast";  // a second environment, which would be too many
  for (LightRecipe& light : lights) light.on = false;
  const LightRig dark = makeLightRig(lights, ".", cache);
  EXPECT_EQ(dark.environment, nullptr);
  EXPECT_TRUE(dark.circles.empty());
  EXPECT_TRUE(dark.directionals.empty());
  EXPECT_EQ(dark.constant, Rgb(0));
  lights[1].on = lights[4].on = true;
  const LightRig lit = makeLightRig(lights, ".", cache);
  EXPECT_EQ(lit.circles.size(), 1u);
  EXPECT_EQ(lit.environment, cache.get("builtin:overcast", "auto", "."));
}

TEST(Lights, TheSunStandsWhereTheRecipePutsIt) {
  EnvironmentCache cache;
  LightRecipe light;
  light.sunAzimuth = 90;  // from -Z counter-clockwise: -X
  light.sunElevation = 30;
  const auto brightest = [&] {
    Vec3 best(0);
    float most = 0;
    cache.get(light, ".")->forEachTexel([&](int, int, const DVec3& d, double, const Rgb& c) {
      if (luminance(c) > most) most = luminance(c), best = Vec3(d);
    });
    return best;
  };
  const Vec3 expected(-std::cos(kPiF / 6), 0.5f, 0);
  EXPECT_GT(dot(brightest(), expected), std::cos(0.015f)) << "within a texel";
  EXPECT_LT(length(worldDirection(light) - expected), 1e-5f);
  light.rotation = 90;
  EXPECT_GT(dot(brightest(), expected), std::cos(0.015f)) << "the map does not turn with the light";
  EXPECT_LT(length(worldDirection(light) - Vec3(0, 0.5f, std::cos(kPiF / 6))), 1e-5f)
      << "but the world's sun does";

  Recipe recipe;
  setByPath(recipe, "lights[0].sunElevation", "1");
  EXPECT_NO_THROW(cache.get(recipe.lights[0], "."));
  EXPECT_THROW(setByPath(recipe, "lights[0].sunElevation", "0.5"), ValueError);
}

TEST(Lights, MapsAreReadOnceAndKnownByTheirSun) {
  EnvironmentCache cache;
  EXPECT_EQ(cache.get("builtin:overcast", "auto", "."), cache.get("builtin:overcast", "auto", "."));
  LightRecipe light;
  const auto usual = cache.get(light, ".");
  EXPECT_EQ(usual, cache.get("builtin:clear-sky", "auto", "."));
  light.sunElevation = 46;
  EXPECT_NE(usual, cache.get(light, "."));
  light.sunElevation = 45;
  light.sunAzimuth = -134;
  EXPECT_NE(usual, cache.get(light, "."));
}

TEST(Lights, TheCacheKeepsTheMapsThatWereAskedForLast) {
  EnvironmentCache cache;
  LightRecipe light;
  light.path = "builtin:studio";
  const std::weak_ptr<const EnvironmentMap> asked = cache.get(light, ".");
  LightRecipe other = light;
  const std::weak_ptr<const EnvironmentMap> old = cache.get("builtin:orientation", "auto", ".");
  for (std::size_t i = 0; i < EnvironmentCache::kKept; ++i) {
    other.mapping = "auto " + std::to_string(i);  // another key, the same built-in map
    cache.get(other, ".");
    cache.get(light, ".");
  }
  EXPECT_FALSE(asked.expired());
  EXPECT_TRUE(old.expired());
}

}  // namespace
}  // namespace prt
