#include "libprt/study/biscale_stage.h"

#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"

#include <cmath>

namespace prt {

Recipe biscaleBenchRecipe() {
  Recipe recipe;
  recipe.objects[0].mesh.path = "builtin:rock";
  recipe.patch.model = PatchModel::Weave;
  recipe.method.name = "biscale";
  recipe.transfer.kind = TransferKind::Matrix;
  recipe.transfer.rays = 256;  // how exact they are does not change what applying them takes
  recipe.transfer.bounces = 1;
  recipe.synthesis.vertices = 120'000;
  recipe.lights.push_back({.kind = LightKind::Circle});
  return recipe;
}

BiscaleStage::BiscaleStage(const Recipe& recipe, const Products& products) : method_(recipe.method) {
  const auto transfer = products.get<TransferProduct>("transfer");
  scene_.scene = products.get<SceneProduct>("scene")->scene;
  scene_.samples = products.get<SamplesProduct>("samples")->samples;
  scene_.transfer = std::shared_ptr<const Transfer>(transfer, &transfer->transfer);
  scene_.materials = scene_.scene->materials;
  scene_.patch = laidPatch(products, recipe);
  EnvironmentCache environments;
  rig_ = makeLightRig(recipe.lights, ".", environments);
  LightRig environment;
  environment.environment = rig_.environment;
  environment_ = projectLights(environment, scene_.transfer->bands);
  home_ = frameBox(scene_.scene->mesh.bounds());
  picture_.width = picture_.height = kSide;
}

void BiscaleStage::step(int frame) {
  rig_.rotation = 0.05f * float(frame);
  const float turn = 0.03f * float(frame);
  const Vec3 d = home_.eye - home_.target;
  picture_.camera = home_;
  picture_.camera.eye = home_.target + Vec3(std::cos(turn) * d.x + std::sin(turn) * d.z, d.y,
                                            std::cos(turn) * d.z - std::sin(turn) * d.x);
}

void BiscaleStage::light() {
  scene_.light = lightFor(rig_, environment_, method_);
}

}  // namespace prt
