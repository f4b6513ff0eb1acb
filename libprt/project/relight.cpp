#include "libprt/project/relight.h"

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/shade/biscale.h"

namespace prt {

Box3 BakedScene::bounds() const {
  Box3 box = geometry->scene->mesh.bounds();
  if (surroundings.empty()) return box;
  const Box3 around = surroundings.scene->mesh.bounds();
  box.extend(around.low), box.extend(around.high);
  return box;
}

BakedScene bakedScene(const Products& products) {
  BakedScene baked{products.get<SceneProduct>("scene"), products.get<SamplesProduct>("samples"),
                   products.get<TransferProduct>("transfer"), nullptr};
  if (!baked.geometry || !baked.samples || !baked.transfer)
    throw ValueError("nothing is baked", "transfer", "bake it first");
  const ProductState& state = *products.state("transfer");
  baked.level = state.level;
  baked.levels = state.levels;
  return baked;
}

BakedScene bakedScene(Pipeline& pipeline, const Recipe& recipe, const std::string& project) {
  const Products products = pipeline.find(recipe, stagesOfPicture(recipe));
  if (!products.state("transfer"))
    throw ValueError("holds no baked transfer for its recipe", project, "run prt bake " + project);
  BakedScene baked = bakedScene(products);
  baked.patch = laidPatch(products, recipe);
  if (const auto meshes = products.get<MeshProduct>("mesh"))
    baked.surroundings = surroundingsOf(recipe, *meshes);
  return baked;
}

void expectPatch(const BakedScene& baked) {
  if (!baked.patch)
    throw ValueError(
        "no patch is laid over the surface", "method.name",
        "set patch.model and method.name=biscale, let an object carry it (objects[].patch), and bake");
}

SceneLight sceneLight(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, Job& job) {
  const int bands = baked.transfer->transfer.bands;
  const ShRgb environment =
      lights.environment ? projectEnvironment(*lights.environment, bands) : ShRgb(bands);
  return SceneLighting().light(lights, environment, recipe.method, baked.surroundings,
                               baked.geometry->scene->mesh.bounds().center(), job);
}

Image relight(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, const Camera& camera,
              const PictureOptions& options, Job& job) {
  const Scene scene = withMaterials(*baked.geometry->scene, recipe);
  const Transfer& transfer = baked.transfer->transfer;
  const auto [light, surroundings] = sceneLight(baked, recipe, lights, job);
  if (recipe.method.name == "biscale") expectPatch(baked);
  if (recipe.method.name == "biscale")
    return renderBiscale({*baked.patch, *baked.samples->samples, transfer, light,
                          options.background ? &lights : nullptr, recipe.method.viewDependent, &surroundings},
                         camera, options.width, options.height, options.grid, job);
  RenderInput input{scene,  *baked.samples->samples, transfer, light, shadeMethod(recipe.method.name), {},
                    nullptr};
  if (options.background) input.background = &lights;
  input.surroundings = &surroundings;
  return render(input, camera, options.width, options.height, options.grid, job);
}

ShadeMethod shadeMethod(const std::string& name) {
  if (name == "auto") return ShadeMethod::Auto;
  if (name == "diffuse") return ShadeMethod::Diffuse;
  if (name == "glossy") return ShadeMethod::Glossy;
  throw ValueError("there is no method '" + name + "'", "method.name",
                   "use auto, diffuse, glossy or biscale");
}

}  // namespace prt
