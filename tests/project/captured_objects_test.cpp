#include "libprt/project/captured_objects.h"

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/project_file.h"
#include "libprt/project/relight.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace prt {
namespace {

using testing::HasSubstr;

/// A rock, and a ball beside it that is captured.
Recipe rockAndBall() {
  Recipe recipe;
  recipe.objects.resize(2);
  recipe.objects[0].mesh.path = "builtin:rock";
  recipe.objects[0].mesh.detail = 0.3f;
  recipe.objects[1].mesh.path = "builtin:sphere";
  recipe.objects[1].mesh.detail = 0.3f;
  recipe.objects[1].name = "ball";
  recipe.objects[1].captured = true;
  recipe.objects[1].emission = Rgb(4, 2, 1);
  recipe.objects[1].transform.translate = Vec3(4, 0, 0);
  recipe.transfer.rays = 64;
  recipe.transfer.bounces = 1;
  return recipe;
}

LightRig someRig() {
  LightRig rig;
  rig.constant = Rgb(0.3f, 0.4f, 0.5f);
  rig.directionals = {{Vec3(1, 0, 0), Rgb(1)}};
  return rig;
}

TEST(CapturedObjects, AreNotBakedAndMoveFreely) {
  const Recipe recipe = rockAndBall();
  Recipe moved = recipe, alone = recipe, seen = recipe;
  moved.objects[1].transform = {{-3, 1, 2}, {10, 20, 30}, {2, 2, 2}};
  moved.objects[1].emission = Rgb(0);
  moved.objects[1].material.albedo = Rgb(0.9f, 0.1f, 0.1f);
  moved.objects[1].material.twoSided = true;
  moved.objects[1].material.model = MaterialModel::Phong;
  moved.objects[1].material.specular = Rgb(0.5f);
  moved.objects[1].patch = false;
  moved.objects[1].seams = "1 2 3";
  alone.objects.pop_back();
  seen.objects[1].captured = false;
  Pipeline pipeline(nullptr, {});
  EXPECT_EQ(pipeline.keys(moved), pipeline.keys(recipe));
  EXPECT_EQ(pipeline.keys(seen).at("mesh"), pipeline.keys(recipe).at("mesh")) << "it is not read again";
  EXPECT_NE(pipeline.keys(seen).at("direct"), pipeline.keys(recipe).at("direct"));
  EXPECT_EQ(resolved(resolved(moved)), resolved(moved));
  EXPECT_EQ(resolved(moved).transfer.kind, TransferKind::Diffuse) << "nothing glossy is baked";
  Recipe painted = recipe, paintedMoved = moved;
  for (Recipe* each : {&painted, &paintedMoved})
    each->patch.model = PatchModel::Flat, each->method.name = "biscale";
  EXPECT_EQ(pipeline.keys(paintedMoved), pipeline.keys(painted)) << "nor is it lit with a patch";
  Job job;
  const auto bake = [&](const Recipe& r) {
    return pipeline.run(r, {"transfer"}, job).get<TransferProduct>("transfer")->transfer.values.bytes;
  };
  EXPECT_EQ(bake(recipe), bake(alone));
}

TEST(CapturedObjects, SomethingMustBeLeftToBake) {
  Recipe recipe = rockAndBall();
  checkRecipe(recipe, "");
  recipe.objects[0].visible = false;
  try {
    checkRecipe(recipe, "yard.json");
    FAIL() << "nothing is left";
  } catch (const ValueError& error) {
    EXPECT_THAT(error.what(), HasSubstr("yard.json: objects[0].captured"));
    EXPECT_THAT(error.what(), HasSubstr("nothing to bake"));
    EXPECT_THAT(error.what(), HasSubstr("set it to false"));
  }
}

TEST(CapturedObjects, AreTheRecipesInItsFrame) {
  Recipe recipe = rockAndBall();
  Job job;
  const auto meshes = Pipeline(nullptr, {}).run(recipe, {"mesh"}, job).get<MeshProduct>("mesh");
  const Surroundings around = surroundingsOf(recipe, *meshes);
  ASSERT_FALSE(around.empty());
  EXPECT_EQ(around.scene->mesh.triangleCount(), meshes->meshes[1]->triangleCount());
  EXPECT_NEAR(around.scene->mesh.bounds().center().x, 4, 0.01);
  EXPECT_EQ(around.scene->triangleObject.front(), 1u) << "objects keep their numbers";
  EXPECT_EQ(around.emission.at(1), Rgb(4, 2, 1));
  recipe.objects[1].visible = false;
  EXPECT_TRUE(surroundingsOf(recipe, *meshes).empty());
  recipe.objects[1].visible = true, recipe.objects[1].captured = false;
  EXPECT_TRUE(surroundingsOf(recipe, *meshes).empty());
  recipe = rockAndBall();
  recipe.objects.emplace_back();
  EXPECT_TRUE(surroundingsOf(recipe, *meshes).empty()) << "the meshes are of before";
}

TEST(CapturedObjects, WithoutThemLightIsWhatItWas) {
  SceneLighting lighting;
  Job job;
  const LightRig rig = someRig();
  const SceneLight lit = lighting.light(rig, ShRgb(6), {}, {}, Vec3(0), job);
  EXPECT_EQ(lit.light.c, projectLights(rig, 6).c);
  EXPECT_TRUE(lit.surroundings.empty());
}

TEST(CapturedObjects, LightAndShadeWhatIsBaked) {
  const Recipe recipe = rockAndBall();
  Job job;
  const auto meshes = Pipeline(nullptr, {}).run(recipe, {"mesh"}, job).get<MeshProduct>("mesh");
  SceneLighting lighting;
  const auto lit = [&](const Recipe& r, const LightRig& rig) {
    return lighting.light(rig, ShRgb(5), r.method, surroundingsOf(r, *meshes), Vec3(0), job).light;
  };
  const ShRgb glowing = lit(recipe, {});
  EXPECT_GT(glowing.evaluate({1, 0, 0}).x, 4 * std::abs(glowing.evaluate({-1, 0, 0}).x))
      << "it comes from there";
  EXPECT_NEAR(glowing.c[0].x, 2 * glowing.c[0].y, 1e-3f) << "in its colour";
  Recipe dark = recipe;
  dark.objects[1].emission = Rgb(0), dark.objects[1].material.albedo = Rgb(0);
  LightRig sun;
  sun.directionals = {{Vec3(1, 0, 0), Rgb(1)}};
  EXPECT_NEAR(lit(dark, sun).c[0].x, 0, 1e-6f) << "the sun is behind it";
  dark.objects[1].transform.translate = Vec3(0, 4, 0);
  EXPECT_EQ(lit(dark, sun).c, projectLights(sun, 5).c) << "it has moved out of the way";
}

TEST(CapturedObjects, ATurningMapIsFollowed) {
  const Recipe recipe = rockAndBall();
  Job job;
  const auto meshes = Pipeline(nullptr, {}).run(recipe, {"mesh"}, job).get<MeshProduct>("mesh");
  const Surroundings around = surroundingsOf(recipe, *meshes);
  LightRig rig = someRig();
  rig.environment = std::make_shared<const EnvironmentMap>(clearSky({}, 64, 32));
  const ShRgb map = projectEnvironment(*rig.environment, 5);
  SceneLighting kept;
  for (const float turn : {0.0f, 1.0f, 2.0f}) {
    rig.rotation = turn;
    SceneLighting fresh;
    EXPECT_EQ(kept.light(rig, map, {}, around, Vec3(0), job).light.c,
              fresh.light(rig, map, {}, around, Vec3(0), job).light.c);
  }
}

TEST(CapturedObjects, AProjectShowsThem) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "yard.prt").string();
  Recipe recipe = rockAndBall();
  recipe.objects[1].transform.translate = Vec3(2, 0, 0);
  Job job;
  {
    const auto project = ProjectFile::openForWork(file);
    project->setRecipe(recipe);
    Pipeline(project.get(), {folder.path()}).run(recipe, {"transfer"}, job);
    project->save();
  }
  const auto project = ProjectFile::open(file);
  Pipeline pipeline(project.get(), {folder.path()});
  Camera camera;
  camera.eye = Vec3(1, 0.5f, 6), camera.target = Vec3(1, 0, 0);
  const auto picture = [&](const Recipe& r) {
    return relight(bakedScene(pipeline, r, file), r, {}, camera, {60, 40, 1}, job);
  };
  const Image image = picture(recipe);
  int glowing = 0, lit = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      glowing += image.rgb(x, y) == Rgb(4, 2, 1);
      lit += x < 30 && image.rgb(x, y).x > 0.02f;
    }
  EXPECT_GT(glowing, 20) << "the ball, under no other light";
  EXPECT_GT(lit, 20) << "the rock beside it";
  Recipe moved = recipe;
  moved.objects[1].transform.translate = Vec3(0, 40, 0);
  EXPECT_NE(picture(moved).data, image.data) << "without a bake";
}

}  // namespace
}  // namespace prt
