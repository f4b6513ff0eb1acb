#include "ui/model/scene_edits.h"

#include "libprt/mesh/generate.h"
#include "tests/ui/small_scene.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

using test::smallScene;

Recipe turned() {
  Recipe recipe = smallScene();
  recipe.objects[0].transform.translate = {3, 5, -2};
  recipe.objects[0].transform.rotate = {30, 40, 50};
  recipe.objects[0].transform.scale = {1, -2, 0.5f};
  return recipe;
}

Box3 placed(const Recipe& recipe, const TriMesh& mesh) {
  return boundsOf(mesh, recipe.objects[0].transform.matrix());
}

TEST(SceneEdits, ObjectsAreNamedAfterTheirMeshOnce) {
  EXPECT_EQ(meshName("models/old chair.obj"), "old chair");
  EXPECT_EQ(meshName("builtin:rock"), "rock");
  Recipe recipe = withObject(smallScene(), "builtin:vase");
  EXPECT_EQ(recipe.objects[1].name, "vase 2");
  recipe = withDuplicate(recipe, 1, 0);
  EXPECT_EQ(recipe.objects[2].name, "vase 3") << "not vase 2 2";
}

TEST(SceneEdits, ADuplicateStandsBesideItsOriginal) {
  const Recipe recipe = withDuplicate(turned(), 0, 1.5f);
  ASSERT_EQ(recipe.objects.size(), 2u);
  ObjectRecipe moved = recipe.objects[0];
  moved.transform.translate.x += 1.5f;
  moved.name = recipe.objects[1].name;
  EXPECT_EQ(recipe.objects[1], moved);
  EXPECT_EQ(withoutObject(recipe, 1), turned());
}

TEST(SceneEdits, RestingPutsTheLowestPointOnTheGround) {
  const TriMesh mesh = makeRock({.subdivisions = 3});
  EXPECT_NEAR(placed(restingOn(turned(), 0, mesh, 0), mesh).low.y, 0, 1e-5);
  EXPECT_NEAR(placed(restingOn(turned(), 0, mesh, -1.25f), mesh).low.y, -1.25f, 1e-5);
}

TEST(SceneEdits, CentringMovesSidewaysOnly) {
  const TriMesh mesh = makeRock({.subdivisions = 3});
  const Recipe recipe = centred(turned(), 0, mesh);
  const Vec3 middle = placed(recipe, mesh).center();
  EXPECT_NEAR(middle.x, 0, 1e-5);
  EXPECT_NEAR(middle.z, 0, 1e-5);
  EXPECT_EQ(recipe.objects[0].transform.translate.y, 5);
}

TEST(SceneEdits, SizeKeepsProportionsAndMirroring) {
  const Recipe recipe = turned();
  EXPECT_NEAR(sizeOf(recipe.objects[0].transform), 1, 1e-6);
  EXPECT_NEAR(length(resized(recipe, 0, 3).objects[0].transform.scale - Vec3(3, -6, 1.5f)), 0, 1e-5);
  EXPECT_EQ(resized(recipe, 0, 0), recipe);
  EXPECT_EQ(resized(recipe, 0, -1), recipe);
  Recipe even = smallScene();
  even.objects[0].transform.scale = Vec3(0.3f, -0.3f, 0.3f);
  EXPECT_EQ(sizeOf(even.objects[0].transform), 0.3f);
  EXPECT_EQ(resized(even, 0, 0.7f).objects[0].transform.scale, Vec3(0.7f, -0.7f, 0.7f)) << "to the bit";
}

TEST(SceneEdits, TheGroundLiesUnderTheSceneAndIsWideEnough) {
  Box3 scene;
  scene.extend({-2, 0.5f, 1});
  scene.extend({4, 7, 3});
  const Recipe recipe = withGround(smallScene(), scene);
  ASSERT_EQ(groundObject(recipe), 1);
  EXPECT_EQ(groundHeight(recipe), 0.5f);
  EXPECT_FALSE(recipe.objects[1].patch);
  const Box3 ground = boundsOf(makeBuiltinMesh("ground"), recipe.objects[1].transform.matrix());
  EXPECT_NEAR(ground.center().x, 1, 1e-4);
  EXPECT_NEAR(ground.center().z, 2, 1e-4);
  EXPECT_EQ(ground.low.y, ground.high.y);
  const float reach = 0.5f * (ground.high.x - ground.low.x);
  EXPECT_GT(reach, 2 * scene.diagonal());
  EXPECT_LT(reach, 6 * scene.diagonal());
  EXPECT_EQ(groundObject(smallScene()), -1);
}

}  // namespace
}  // namespace prt::ui
