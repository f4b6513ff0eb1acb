#include "libprt/study/figure_kit.h"

#include "libprt/core/image_io.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/products.h"
#include "libprt/project/relight.h"
#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <optional>

namespace prt {

Recipe figureRecipe(const FigureRequest& request, const char* builtIn) {
  Recipe recipe;
  recipe.objects[0].mesh.path = request.mesh.empty() ? builtIn : request.mesh;
  recipe.objects[0].material.albedo = Rgb(0.6f);
  recipe.method.name = "biscale";
  recipe.transfer.rays = 1024;
  recipe.synthesis.scale = 0.06f;
  return recipe;
}

void writeEncodedPicture(const std::filesystem::path& file, const Image& encoded) {
  ImageWriteOptions options;
  options.alreadySrgb = true;
  writeImage(file, encoded, options);
}

void writeFigurePicture(const std::filesystem::path& file, const Image& linear) {
  writeEncodedPicture(file, toDisplay(linear, {0, ToneCurve::Linear}));
}

LightRig figureLamp() {
  LightRig rig;
  CircleLight circle;
  circle.direction = normalize(Vec3(-0.75f, 0.6f, 0.35f));
  circle.halfAngle = float(radians(20.0));
  circle.radiance = Rgb(7);
  rig.circles = {circle};
  rig.constant = Rgb(0.18f, 0.2f, 0.24f);
  return rig;
}

Camera figureCamera(const TriMesh& mesh, int width, int height) {
  constexpr float kMargin = 0.04f, kNearer = 0.97f;
  const auto fits = [&](const Camera& camera) {
    const Vec2 size{float(width), float(height)}, least = kMargin * size, most = size - least;
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3& p) {
      const std::optional<Vec2> at = camera.project(p, width, height);
      return at && at->x > least.x && at->y > least.y && at->x < most.x && at->y < most.y;
    });
  };
  Camera camera = frameBox(mesh.bounds());
  for (Camera next = camera; fits(next); next.eye = next.target + kNearer * (next.eye - next.target))
    camera = next;
  return camera;
}

double Stopwatch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

void FigureModel::bake(const Recipe& recipe, Job& job) {
  products_ = pipeline_.run(recipe, stagesOfPicture(recipe), job);
  patch_ = laidPatch(products_, recipe);
}

Image FigureModel::picture(const Recipe& recipe, const LightRig& rig, Job& job) const {
  BakedScene baked = bakedScene(products_);
  baked.patch = patch_;
  return relight(baked, recipe, rig, camera(), {kWidth, kHeight, 2}, job);
}

Camera FigureModel::camera() const {
  return figureCamera(patch_->scene->mesh, kWidth, kHeight);
}

}  // namespace prt
