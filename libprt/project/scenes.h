#pragma once
// Built-in scenes, and whatever else a program can be given to begin with. The scenes are the recipes in
// resources/scenes, built into the library: they work wherever it is installed.

#include "libprt/project/recipe.h"

#include <filesystem>
#include <string>
#include <vector>

namespace prt {

/// Names for "scene:NAME", "default" first.
std::vector<std::string> builtinSceneNames();
/// Throws ValueError, naming the choices, when there is none of that name.
Recipe builtinScene(const std::string& name);

/// A recipe and where its relative paths begin.
struct RecipeSource {
  Recipe recipe;
  std::filesystem::path folder;
  std::filesystem::path project;  ///< the .prt that it came from, which has products; else empty
};

/// What a user may name to begin with: a mesh file, a recipe (.json), a project (.prt), "scene:NAME" or
/// "builtin:MESH". Throws FileError and ValueError.
RecipeSource openRecipe(const std::string& input);

}  // namespace prt
