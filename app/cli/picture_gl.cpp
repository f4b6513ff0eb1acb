#include "app/cli/picture_gl.h"

#include "libprt/gl/headless_context.h"
#include "libprt/gl/scene_renderer.h"
#include "libprt/shade/surface_light.h"

namespace prt::cli {

Image relightGl(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, const Camera& camera,
                const PictureOptions& options, Job& job) {
  const bool patch = recipe.method.name == "biscale";
  if (patch) expectPatch(baked);
  const gl::HeadlessContext context;
  gl::SceneRenderer renderer;
  Scene scene = withMaterials(*baked.geometry->scene, recipe);
  if (!patch && shadeMethod(recipe.method.name) == ShadeMethod::Diffuse)
    for (Material& material : scene.materials) material.model = MaterialModel::Lambert;
  renderer.setScene(scene, *baked.samples->samples);
  const Transfer& transfer = baked.transfer->transfer;
  const auto [light, surroundings] = sceneLight(baked, recipe, lights, job);
  if (patch) {
    renderer.setPatch(baked.patch);
    renderer.setPatchLight(*baked.samples->samples, transfer, light, job);
  } else {
    renderer.setLight(surfaceLight(transfer, light, *baked.samples->samples));
  }
  renderer.setSurroundings(surroundings);
  gl::Picture picture;
  picture.camera = camera;
  picture.width = options.width;
  picture.height = options.height;
  picture.samples = options.grid * options.grid;
  picture.background = options.background ? gl::Background::Environment : gl::Background::Black;
  if (lights.environment) renderer.setEnvironment(*lights.environment);
  picture.environmentRotation = lights.rotation;
  picture.environmentIntensity = lights.environment ? lights.intensity : 0;
  picture.circles = lights.circles;
  picture.constant = lights.constant;
  picture.viewDependent = recipe.method.viewDependent;
  return renderer.render(picture);
}

}  // namespace prt::cli
