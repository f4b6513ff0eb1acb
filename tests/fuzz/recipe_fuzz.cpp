// Recipes as JSON, and settings as "PATH=VALUE".

#include "libprt/core/error.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/recipe.h"
#include "tests/fuzz/target.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <string>

namespace {

using namespace prt;
using fuzz::require;

/// Calls action; an Error must be one line.
template <class Action>
void allowError(Action action) {
  try {
    action();
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
}

/// What everybody does with a recipe that was accepted.
void useRecipe(const Recipe& recipe) {
  const std::string text = recipeToJson(recipe).dump(2);
  require(recipeFromText(text, "again") == recipe);
  require(resolved(resolved(recipe)) == resolved(recipe));
  contradictions(recipe);
  Recipe copy = recipe;
  for (const std::string& path : pathsOf(recipe)) {
    if (recipe.objects.size() + recipe.lights.size() + recipe.cameras.size() > 16) break;
    setByPath(copy, path, getByPath(recipe, path).dump());
  }
  require(copy == recipe);
  rebasePaths(copy, "/a/b", "/a/c");
  rebasePaths(copy, "/a/c", "/a/b");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  allowError([&] { useRecipe(recipeFromText(text, "fuzzed")); });
  if (size > 200) return 0;
  Recipe recipe;
  allowError([&] {
    setByAssignment(recipe, text);
    useRecipe(recipe);
  });
  return 0;
}

namespace {

constexpr char kShort[] =
    R"({"mesh": "a.obj", "material": {"model": "phong", "albedo": [0.8, 0.4, 0.2], "exponent": 40},)"
    R"( "transfer": {"bands": 4, "rays": 64, "bounces": 1}})";
constexpr char kLong[] =
    R"({"version": 1, "objects": [{"name": "a", "mesh": {"path": "builtin:rock", "detail": 0.5, "seed": 7,)"
    R"( "weld": false, "orientation": "keep"}, "transform": {"translate": [1, 2, 3], "rotate": [0, 90, 0],)"
    R"( "scale": [1, -1, 1]}}, {}], "lights": [{"kind": "circle", "direction": [0, 1, 0], "angle": 3},)"
    R"( {"path": "sky.hdr", "rotation": -90}], "cameras": [{"name": "c", "eye": [3, 0, 0], "vfov_deg": 20}],)"
    R"( "method": {"name": "diffuse", "window": "hann"}})";

}  // namespace

const prt::fuzz::Target prt::fuzz::target{.name = "recipe",
                                          .seeds =
                                              [] {
                                                std::vector<std::string> seeds{kShort,
                                                                               kLong,
                                                                               recipeToJson(Recipe{}).dump(2),
                                                                               "transfer.bounces=3",
                                                                               "material.albedo=0.5,0.4,0.3",
                                                                               "lights[1].kind=circle",
                                                                               "cameras[0].eye=[1,2,3]",
                                                                               "mesh=a.obj"};
                                                return seeds;
                                              },
                                          .words = {"[",
                                                    "{",
                                                    "}",
                                                    "]",
                                                    "null",
                                                    "true",
                                                    "\"\\u0000\"",
                                                    "\"\xff\"",
                                                    "1e400",
                                                    "-1e-400",
                                                    "[[[[[[[[",
                                                    "{\"a\":",
                                                    ",",
                                                    ":",
                                                    "\"mesh\":",
                                                    "\"objects\":[],",
                                                    "\"version\":2,",
                                                    "lights[4095].",
                                                    "objects[4096].",
                                                    ".",
                                                    "=",
                                                    "transform.scale=",
                                                    "0,0,0",
                                                    "\"transfer\":",
                                                    "18446744073709551615",
                                                    "[0]",
                                                    "\"scale\":[0,0,0]"},
                                          .runs = 20000,
                                          .memoryBase = std::size_t{64} << 20};
