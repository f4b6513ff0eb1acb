#include "ui/model/scene_edits.h"

#include "libprt/mesh/generate.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

const char* const kGround = "builtin:ground";
constexpr float kGroundReach = 4;  // half of the ground's width, in diagonals of the scene

ObjectRecipe& at(Recipe& recipe, int object) {
  return recipe.objects.at(std::size_t(object));
}

float groundWidth() {
  static const Box3 box = makeBuiltinMesh("ground", 0.1f).bounds();
  return box.high.x - box.low.x;
}

// Few digits: 1.2345 -> 1.3.
float roundedUp(float value) {
  const float unit = std::pow(10.0f, std::floor(std::log10(value)) - 1);
  return std::ceil(value / unit) * unit;
}

}  // namespace

std::string meshName(const std::string& path) {
  if (isBuiltin(path)) return path.substr(path.find(':') + 1);
  const std::string stem = std::filesystem::path(path).stem().string();
  return stem.empty() ? "object" : stem;
}

std::string freeObjectName(const Recipe& recipe, const std::string& wanted) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(recipe.objects.begin(), recipe.objects.end(),
                       [&](const ObjectRecipe& o) { return o.name == name; });
  };
  std::string name = wanted;
  for (int number = 2; taken(name); ++number) name = wanted + " " + std::to_string(number);
  return name;
}

Recipe withObject(Recipe recipe, const std::string& path) {
  ObjectRecipe object;
  object.name = freeObjectName(recipe, meshName(path));
  object.mesh.path = path;
  recipe.objects.push_back(object);
  return recipe;
}

Recipe withoutObject(Recipe recipe, int object) {
  recipe.objects.erase(recipe.objects.begin() + object);
  return recipe;
}

Recipe withDuplicate(Recipe recipe, int object, float aside) {
  ObjectRecipe copy = at(recipe, object);
  // "vase 2" becomes "vase 3", not "vase 2 2".
  const auto end = copy.name.find_last_not_of("0123456789 ");
  copy.name = freeObjectName(recipe, end == std::string::npos ? copy.name : copy.name.substr(0, end + 1));
  copy.transform.translate.x += aside;
  recipe.objects.insert(recipe.objects.begin() + object + 1, copy);
  return recipe;
}

Box3 boundsOf(const TriMesh& mesh, const Mat4& transform) {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.extend(Vec3(transform * Vec4(p, 1)));
  return box;
}

Recipe restingOn(Recipe recipe, int object, const TriMesh& mesh, float height) {
  TransformRecipe& transform = at(recipe, object).transform;
  transform.translate.y += height - boundsOf(mesh, transform.matrix()).low.y;
  return recipe;
}

Recipe centred(Recipe recipe, int object, const TriMesh& mesh) {
  TransformRecipe& transform = at(recipe, object).transform;
  const Vec3 middle = boundsOf(mesh, transform.matrix()).center();
  transform.translate -= Vec3(middle.x, 0, middle.z);
  return recipe;
}

float sizeOf(const TransformRecipe& transform) {
  const Vec3 s = abs(transform.scale);
  return s.x == s.y && s.y == s.z ? s.x : std::cbrt(s.x * s.y * s.z);
}

Recipe resized(Recipe recipe, int object, float size) {
  TransformRecipe& transform = at(recipe, object).transform;
  const float before = sizeOf(transform);
  if (!(size > 0) || !(before > 0)) return recipe;
  const bool even = abs(transform.scale) == Vec3(before);
  transform.scale = even ? sign(transform.scale) * size : transform.scale * (size / before);
  return recipe;
}

int groundObject(const Recipe& recipe) {
  const auto found = std::find_if(recipe.objects.begin(), recipe.objects.end(),
                                  [](const ObjectRecipe& o) { return o.mesh.path == kGround; });
  return found == recipe.objects.end() ? -1 : int(found - recipe.objects.begin());
}

float groundHeight(const Recipe& recipe) {
  const int ground = groundObject(recipe);
  return ground < 0 ? 0.0f : recipe.objects[std::size_t(ground)].transform.translate.y;
}

Recipe withGround(Recipe recipe, const Box3& scene) {
  recipe = withObject(std::move(recipe), kGround);
  ObjectRecipe& ground = recipe.objects.back();
  ground.patch = false;  // it carries what stands on it
  ground.material.name = "ground";
  ground.material.albedo = Rgb(0.6f);
  if (scene.empty()) return recipe;
  const float width = 2 * kGroundReach * std::max(scene.diagonal(), 1e-6f);
  ground.transform.scale = Vec3(roundedUp(width / groundWidth()));
  ground.transform.translate = {scene.center().x, scene.low.y, scene.center().z};
  return recipe;
}

}  // namespace prt::ui
