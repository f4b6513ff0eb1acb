#include "libprt/project/laid_patch.h"

#include "libprt/core/error.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/project/relight.h"
#include "libprt/project/scenes.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

Recipe smallPatch(PatchMapping mapping) {
  Recipe recipe;
  recipe.objects[0].mesh.path = "builtin:vase";
  recipe.objects[0].mesh.detail = 0.25f;
  recipe.transfer.rays = 64;
  recipe.transfer.bounces = 1;
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.heightmap = "builtin:bins";
  recipe.patch.grid = 16;
  recipe.rtt.texels = 8, recipe.rtt.views = 2, recipe.rtt.rays = 64, recipe.rtt.supersamples = 1;
  recipe.synthesis.mapping = mapping;
  recipe.synthesis.vertices = 2000, recipe.synthesis.scale = 0.2f;
  recipe.idmap.size = 128, recipe.atlas.size = 256;
  recipe.method.name = "biscale";
  return recipe;
}

Products bake(const Recipe& recipe) {
  Job job;
  std::vector<std::string> stages = stagesOfLaidPatch(recipe);
  stages.insert(stages.end(), {"scene", "samples", "transfer"});
  return Pipeline(nullptr, {}).run(recipe, stages, job);
}

double brightness(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) sum += double(image.data[4 * i]);
  return sum / double(image.pixels());
}

TEST(LaidPatch, BiscaleAsksForTransferThatKeepsDirections) {
  Recipe recipe = smallPatch(PatchMapping::Synthesis);
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Matrix);
  recipe.transfer.bounces = 0;
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Visibility);
  recipe.method.name = "auto";
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Diffuse);
  recipe.method.name = "biscale";
  recipe.patch.model = PatchModel::None;
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Diffuse);
  EXPECT_TRUE(stagesOfLaidPatch(recipe).empty());
}

TEST(LaidPatch, FlatAndMatteItNeedsDiffuseVectorsOnly) {
  Recipe recipe = smallPatch(PatchMapping::Synthesis);
  recipe.patch = {};
  recipe.patch.model = PatchModel::Flat, recipe.patch.albedo = Rgb(0.6f, 0.4f, 0.2f);
  recipe.objects[0].material.albedo = recipe.patch.albedo;
  EXPECT_EQ(resolved(recipe).transfer.kind, TransferKind::Diffuse);
  const Products products = bake(recipe);
  BakedScene baked = bakedScene(products);
  baked.patch = laidPatch(products, recipe);
  ASSERT_TRUE(baked.patch && baked.patch->matte);
  LightRig lights;
  lights.constant = Rgb(0.5f);
  lights.circles.push_back({normalize(Vec3(1, 2, 1)), 0.6f, Rgb(2)});
  const Camera camera = frameBox(baked.geometry->scene->mesh.bounds());
  Job job;
  const Image patched = relight(baked, recipe, lights, camera, {60, 45}, job);
  recipe.method.name = "auto";
  const Image plain = relight(baked, recipe, lights, camera, {60, 45}, job);
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < plain.data.size(); ++i)
    difference += double(std::abs(patched.data[i] - plain.data[i])), sum += double(plain.data[i]);
  EXPECT_GT(sum, 10);
  EXPECT_LT(difference, 0.03 * sum) << "the noise of the texture's rays";

  recipe.method.name = "biscale";
  Recipe other = recipe;
  other.patch.specular = Rgb(0.1f);
  EXPECT_EQ(resolved(other).transfer.kind, TransferKind::Matrix);
  other = recipe;
  other.layers.push_back({"bumps", {}, "0,0,0 0.1 1"});
  EXPECT_EQ(resolved(other).transfer.kind, TransferKind::Diffuse) << "a layer without a patch";
  other.layers[0].patch.model = PatchModel::Weave;
  EXPECT_EQ(resolved(other).transfer.kind, TransferKind::Matrix);
}

TEST(LaidPatch, PicturesShowItAndWithoutItSayWhatToDo) {
  for (const PatchMapping mapping : {PatchMapping::Synthesis, PatchMapping::Uv}) {
    Recipe recipe = smallPatch(mapping);
    const Products products = bake(recipe);
    BakedScene baked = bakedScene(products);
    LightRig lights;
    lights.constant = Rgb(1);
    Job job;
    const Camera camera = frameBox(baked.geometry->scene->mesh.bounds());
    EXPECT_THROW(relight(baked, recipe, lights, camera, {40, 30}, job), ValueError);
    baked.patch = laidPatch(products, recipe);
    ASSERT_TRUE(baked.patch);
    const Image patched = relight(baked, recipe, lights, camera, {40, 30}, job);
    recipe.method.name = "auto";
    const Image plain = relight(baked, recipe, lights, camera, {40, 30}, job);
    EXPECT_GT(brightness(patched), 0.3 * brightness(plain));
    EXPECT_NE(patched.data, plain.data);
  }
}

TEST(LaidPatch, LeavesTheGroundOfABuiltInSceneItsMaterial) {
  Recipe recipe = smallPatch(PatchMapping::Synthesis);
  const Recipe scene = builtinScene("default");
  recipe.objects = scene.objects;
  ASSERT_EQ(recipe.objects[1].name, "ground");
  EXPECT_TRUE(recipe.objects[0].patch);
  EXPECT_FALSE(recipe.objects[1].patch);
  for (ObjectRecipe& object : recipe.objects) object.mesh.detail = 0.25f;
  const Products products = bake(recipe);
  BakedScene baked = bakedScene(products);
  LightRig lights;
  lights.constant = Rgb(1);
  Camera camera;
  camera.eye = {0, 1, 2}, camera.target = {0, 0, 1.6f};  // the ground in front of the vase
  Job job;
  const auto middle = [&] { return relight(baked, recipe, lights, camera, {8, 6}, job).rgb(4, 3); };
  const auto laid = laidPatch(products, recipe);
  ASSERT_TRUE(laid && laid->plain);
  baked.patch = laid;
  const Rgb shown = middle();
  recipe.method.filter = true;  // charts of the id map that are empty
  baked.patch = laidPatch(products, recipe);
  ASSERT_TRUE(baked.patch->filter);
  EXPECT_EQ(middle(), shown);
  recipe.method.name = "auto";
  const Rgb plain = middle();
  EXPECT_GT(plain.x, 0.2f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], plain[c], 4e-3f);

  // Its material changes without a bake, and nothing else of the patch is made anew.
  recipe.objects[1].material.albedo = Rgb(0.1f, 0.2f, 0.3f);
  recipe.method.name = "biscale";
  baked.patch = withPlainObjects(laid, recipe);
  EXPECT_EQ(baked.patch->responses, laid->responses);
  EXPECT_NEAR(middle().z / shown.z, 0.3f / scene.objects[1].material.albedo.z, 5e-3f);
  recipe.objects[1].patch = true;
  EXPECT_FALSE(withPlainObjects(laid, recipe)->plain);
  recipe.objects.pop_back();
  EXPECT_FALSE(withPlainObjects(laid, recipe)) << "another scene's";
  EXPECT_FALSE(laidPatch(products, recipe));
}

TEST(LaidPatch, IsNotThereBeforeItsPartsAre) {
  const Recipe recipe = smallPatch(PatchMapping::Synthesis);
  Products products = bake(recipe);
  products.states.erase("idmap");
  EXPECT_FALSE(laidPatch(products, recipe));
  EXPECT_FALSE(laidPatch({}, recipe));
}

}  // namespace
}  // namespace prt
