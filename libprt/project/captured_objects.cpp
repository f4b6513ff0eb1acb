#include "libprt/project/captured_objects.h"

#include <algorithm>

namespace prt {
namespace {

constexpr int kMostBandsAround = 10;  // of the light on the surroundings

ShRgb firstBands(const ShRgb& light, int bands) {
  ShRgb out(std::min(bands, light.bands));
  std::copy_n(light.c.begin(), out.c.size(), out.c.begin());
  return out;
}

}  // namespace

bool isCaptured(const ObjectRecipe& object) {
  return object.visible && object.captured;
}

bool hasCaptured(const Recipe& recipe) {
  return std::any_of(recipe.objects.begin(), recipe.objects.end(), isCaptured);
}

Recipe withCapturedInside(Recipe recipe) {
  for (ObjectRecipe& object : recipe.objects) object.captured = false;
  return recipe;
}

std::vector<Rgb> emissionOf(const Recipe& recipe) {
  std::vector<Rgb> out;
  bool any = false;
  for (const ObjectRecipe& object : recipe.objects) {
    out.push_back(isCaptured(object) ? object.emission : Rgb(0));
    any = any || out.back() != Rgb(0);
  }
  return any ? out : std::vector<Rgb>{};
}

Surroundings surroundingsOf(const Recipe& recipe, const MeshProduct& meshes) {
  if (!hasCaptured(recipe) || meshes.meshes.size() != recipe.objects.size()) return {};
  const auto nothing = std::make_shared<const TriMesh>();
  std::vector<SceneObject> objects;
  Surroundings out;
  bool any = false;
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    const ObjectRecipe& object = recipe.objects[i];
    const bool captured = isCaptured(object) && meshes.meshes[i];
    objects.push_back({object.name, captured ? meshes.meshes[i] : nothing,
                       captured ? object.transform.matrix() : Mat4(1.0f), object.material});
    out.emission.push_back(object.emission);
    any = any || (captured && meshes.meshes[i]->triangleCount() > 0);
  }
  if (!any) return {};
  out.scene = std::make_shared<const Scene>(flattenScene(objects));
  out.samples = bareSamples(*out.scene);
  return out;
}

void SceneLighting::know(std::shared_ptr<const EnvironmentMap> map,
                         std::shared_ptr<const EnvironmentPoints> points) {
  map_ = std::move(map);
  points_ = std::move(points);
}

const EnvironmentPoints* SceneLighting::pointsOf(const LightRig& rig, Job& job) {
  if (!rig.environment) return nullptr;
  if (rig.environment != map_ || !points_)
    know(rig.environment, std::make_shared<const EnvironmentPoints>(*rig.environment, job));
  return points_.get();
}

SceneLight SceneLighting::light(const LightRig& rig, const ShRgb& environment, const MethodRecipe& method,
                                const Surroundings& surroundings, const Vec3& middle, Job& job) {
  if (surroundings.empty()) return {lightFor(rig, environment, method), {}};
  ShRgb light = projectLights(rig, environment);
  SceneLight out{{}, surroundings};
  out.surroundings.light = firstBands(windowed(light, method.window), kMostBandsAround);
  if (seen_ != surroundings.scene || middle_ != middle || !view_) {
    view_.emplace(surroundings.scene->mesh, middle, job);
    seen_ = surroundings.scene, middle_ = middle;
  }
  const CapturedCube cube = view_->capture(out.surroundings, job);
  const ShRgb difference = capturedDifference(cube, rig, pointsOf(rig, job), light.bands);
  for (std::size_t k = 0; k < light.c.size(); ++k) light.c[k] += difference.c[k];
  out.light = windowed(light, method.window);
  return out;
}

}  // namespace prt
