#include "libprt/core/error.h"
#include "libprt/project/lights.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/project/scenes.h"
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

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene, testing::ValuesIn(builtinSceneNames()), [](const auto& p) { return p.param; });

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
  EXPECT_NEAR(length(rig.circles[0].direction - Vec3(-1, 0, 0)), 0, 1e-6) << "what came from -Z comes from -X";
  EXPECT_EQ(rig.circles[0].radiance, Rgb(2, 4, 6));
}

TEST(Lights, OneEnvironmentAtATime) {
  EnvironmentCache cache;
  std::vector<LightRecipe> lights(2);
  EXPECT_THROW(makeLightRig(lights, ".", cache), ValueError);
  lights[1].intensity = 0;
  EXPECT_NE(makeLightRig(lights, ".", cache).environment, nullptr);
}

TEST(Lights, MapsAreReadOnce) {
  EnvironmentCache cache;
  EXPECT_EQ(cache.get("builtin:overcast", "auto", "."), cache.get("builtin:overcast", "auto", "."));
}

}  // namespace
}  // namespace prt
