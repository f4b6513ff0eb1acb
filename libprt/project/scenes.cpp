#include "libprt/project/scenes.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/project/embedded_scenes.h"
#include "libprt/project/project_file.h"
#include "libprt/project/recipe_table.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string lowerExtension(const fs::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

Recipe recipeOfMesh(const std::string& path, const std::string& name) {
  Recipe recipe;
  recipe.objects[0].name = name;
  recipe.objects[0].mesh.path = path;
  return recipe;
}

Recipe recipeOfBuiltinMesh(const std::string& input) {
  const std::string name = input.substr(input.find(':') + 1);
  const std::vector<std::string> names = builtinMeshNames();
  if (std::count(names.begin(), names.end(), name) == 0)
    throw ValueError("no built-in mesh is called '" + name + "'", input, "choose from " + listed(names));
  return recipeOfMesh(input, name);
}

}  // namespace

std::vector<std::string> builtinSceneNames() {
  std::vector<std::string> names;
  for (const EmbeddedScene& scene : embeddedScenes()) names.push_back(scene.name);
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name == "default"; });
  return names;
}

Recipe builtinScene(const std::string& name) {
  for (const EmbeddedScene& scene : embeddedScenes())
    if (scene.name == name) return recipeFromText(scene.json, "scene:" + name);
  throw ValueError("no built-in scene is called '" + name + "'", "scene:" + name,
                   "choose from " + listed(builtinSceneNames()));
}

RecipeSource openRecipe(const std::string& input) {
  if (input.starts_with("scene:")) return {builtinScene(input.substr(6)), ".", {}};
  if (input.starts_with("builtin:")) return {recipeOfBuiltinMesh(input), ".", {}};
  const fs::path file = input;
  std::error_code error;
  if (!fs::exists(file, error)) throw FileError("does not exist", input, "check the path");
  if (fs::is_directory(file, error))
    throw FileError("is a folder", input, "give a mesh, a .json or a .prt file");
  const std::string extension = lowerExtension(file);
  if (extension == ".json") return {loadRecipe(file), folderOf(file), {}};
  if (extension == ".prt") return {ProjectFile::open(file)->recipe(), folderOf(file), file};
  const std::vector<std::string> meshes = meshExtensions();
  if (std::count(meshes.begin(), meshes.end(), extension) == 0)
    throw FileError("is neither a mesh, a recipe nor a project", input,
                    "use .prt, .json or " + listed(meshes));
  requireUtf8(file.filename().string(), input);
  return {recipeOfMesh(file.filename().string(), file.stem().string()), folderOf(file), {}};
}

}  // namespace prt
