#include "libprt/project/recipe.h"

#include "libprt/atlas/chart_settings.h"
#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"
#include "libprt/synthesis/layer_masks.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace prt {

Mat4 TransformRecipe::matrix() const {
  Mat4 m = glm::translate(Mat4(1.0f), translate);
  m = glm::rotate(m, float(radians(rotate.z)), Vec3(0, 0, 1));
  m = glm::rotate(m, float(radians(rotate.y)), Vec3(0, 1, 0));
  m = glm::rotate(m, float(radians(rotate.x)), Vec3(1, 0, 0));
  return glm::scale(m, scale);
}

Camera CameraRecipe::camera() const {
  return {eye, target, up, float(radians(verticalFov)), orthographic};
}

void checkRecipe(const Recipe& recipe, const std::string& where) {
  const auto at = [&](const std::string& path) { return where.empty() ? path : where + ": " + path; };
  if (recipe.objects.empty()) throw ValueError("is empty", at("objects"), "give at least one object");
  if (std::none_of(recipe.objects.begin(), recipe.objects.end(),
                   [](const ObjectRecipe& o) { return o.visible; }))
    throw ValueError("hides every object", at("objects[0].visible"), "show one at least");
  if (std::none_of(recipe.objects.begin(), recipe.objects.end(),
                   [](const ObjectRecipe& o) { return o.visible && !o.captured; }))
    throw ValueError("leaves nothing to bake: every object that is seen is captured",
                     at("objects[0].captured"),
                     "set it to false for the objects that the others stand around");
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    try {
      chartSettingsFromText(recipe.objects[i].charts);
    } catch (const ValueError& error) {
      throw ValueError(error.problem(), at("objects[" + std::to_string(i) + "].charts"), error.fix());
    }
  }
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    const Vec3& s = recipe.objects[i].transform.scale;
    if (s.x * s.y * s.z == 0)
      throw ValueError("flattens the object", at("objects[" + std::to_string(i) + "].transform.scale"),
                       "use factors other than 0");
  }
  if (recipe.layers.size() > std::size_t(kMostLayers))
    throw ValueError("has " + std::to_string(recipe.layers.size()) + " entries", at("layers"),
                     "keep at most " + std::to_string(kMostLayers));
  for (std::size_t i = 0; i < recipe.lights.size(); ++i)
    if (recipe.lights[i].direction == Vec3(0))
      throw ValueError("has no length", at("lights[" + std::to_string(i) + "].direction"),
                       "point it towards the light");
  for (std::size_t i = 0; i < recipe.cameras.size(); ++i) {
    const CameraRecipe& c = recipe.cameras[i];
    const std::string camera = "cameras[" + std::to_string(i) + "]";
    if (c.eye == c.target)
      throw ValueError("is where the eye is", at(camera + ".target"), "move one of them");
    if (length(cross(normalize(c.target - c.eye), c.up)) <= 1e-6f * length(c.up))
      throw ValueError("is along the view", at(camera + ".up"), "use another direction");
  }
}

bool isBuiltin(const std::string& path) {
  return path.starts_with("builtin:") || path.starts_with("scene:");
}

std::string rebasedPath(const std::string& path, const std::filesystem::path& from,
                        const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  if (path.empty() || isBuiltin(path) || fs::path(path).is_absolute()) return path;
  const fs::path target = fs::absolute(to).lexically_normal();
  return (fs::absolute(from) / path).lexically_normal().lexically_relative(target).generic_string();
}

void rebasePaths(Recipe& recipe, const std::filesystem::path& from, const std::filesystem::path& to) {
  forEachField(recipe, [&](const FieldPlace& place, const FieldRef& field) {
    if (place.parameter.type != ParameterType::File) return;
    std::string& path = *std::get<std::string*>(field);
    path = rebasedPath(path, from, to);
  });
}

}  // namespace prt
