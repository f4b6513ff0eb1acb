#include "libprt/project/laid_patch.h"

#include "libprt/core/error.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/project/relight.h"

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

TEST(LaidPatch, IsNotThereBeforeItsPartsAre) {
  const Recipe recipe = smallPatch(PatchMapping::Synthesis);
  Products products = bake(recipe);
  products.states.erase("idmap");
  EXPECT_FALSE(laidPatch(products, recipe));
  EXPECT_FALSE(laidPatch({}, recipe));
}

}  // namespace
}  // namespace prt
