// The recipe as a JSON file. One pass over the parameter table does all of it, so that a parameter
// exists in JSON as soon as it is in the table.

#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <set>
#include <sstream>

namespace prt {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxArray = 4096;
constexpr std::uintmax_t kMaxFileBytes = 16u << 20;
constexpr int kMaxDepth = 16;

/// "objects[2].mesh" -> "/objects/2/mesh".
json::json_pointer pointerOf(const std::string& path) {
  std::string pointer;
  for (char c : path) {
    if (c == ']') continue;
    pointer += c == '.' || c == '[' ? '/' : c;
  }
  return json::json_pointer("/" + pointer);
}

std::string at(const std::string& where, const std::string& path) {
  return where.empty() ? path : where + ": " + path;
}

void checkVersion(const json& root, const std::string& where) {
  const auto version = root.find("version");
  if (version == root.end()) return;
  if (!version->is_number_integer() || *version < 1)
    throw ValueError(version->dump() + " is not a recipe version", at(where, "version"), "use 1");
  if (*version > kRecipeVersion)
    throw ValueError("the recipe's version " + version->dump() + " is newer than this program", where,
                     "open it with a newer version of prt");
}

/// Moves the short forms "mesh", "transform" and "material" into objects[0], and texts into mesh.path.
json withoutShortForms(json root, const std::string& where) {
  for (const char* section : {"mesh", "transform", "material"}) {
    const auto short_ = root.find(section);
    if (short_ == root.end()) continue;
    if (!root.contains("objects")) root["objects"] = json::array({json::object()});
    json& objects = root["objects"];
    if (!objects.is_array() || objects.empty() || !objects[0].is_object())
      throw ValueError("'" + std::string(section) + "' needs an object to belong to", where,
                       "leave out 'objects'");
    if (objects[0].contains(section))
      throw ValueError("is given twice", at(where, section),
                       "keep one of '" + std::string(section) + "' and 'objects[0]." + section + "'");
    objects[0][section] = *short_;
    root.erase(section);
  }
  const auto objects = root.find("objects");
  if (objects != root.end() && objects->is_array())
    for (json& object : *objects)
      if (object.is_object() && object.contains("mesh") && object["mesh"].is_string())
        object["mesh"] = json{{"path", object["mesh"]}};
  return root;
}

void resizeArrays(Recipe& recipe, const json& root, const std::string& where) {
  for (const RecipeArray& array : recipeArrays(recipe)) {
    const auto given = root.find(array.name);
    if (given == root.end()) continue;
    if (!given->is_array()) throw ValueError("is not a list", at(where, array.name), "write it in [ ]");
    if (given->size() > kMaxArray)
      throw ValueError("has too many entries", at(where, array.name), "keep it below 4096");
    array.resize(given->size());
  }
}

/// What may stand in a recipe of this many objects, lights, cameras and layers.
struct KnownKeys {
  std::set<std::string> fields, sections, arrays{"objects", "lights", "cameras", "layers"};

  explicit KnownKeys(Recipe& recipe) {
    fields.insert("version");
    sections.insert("");
    forEachField(recipe, [&](const FieldPlace& place, const FieldRef&) {
      fields.insert(place.path());
      sections.insert(place.section);
    });
  }
};

void refuseUnknown(const json& node, const std::string& path, const KnownKeys& known,
                   const std::string& where) {
  if (known.fields.contains(path)) return;
  if (known.sections.contains(path)) {
    if (!node.is_object()) throw ValueError("is not a group of settings", at(where, path), "write it in { }");
    for (const auto& [key, value] : node.items())
      refuseUnknown(value, path.empty() ? key : path + "." + key, known, where);
    return;
  }
  if (known.arrays.contains(path)) {
    for (std::size_t i = 0; i < node.size(); ++i)
      refuseUnknown(node[i], path + "[" + std::to_string(i) + "]", known, where);
    return;
  }
  const std::string nearest = nearestName(path, {known.fields.begin(), known.fields.end()});
  throw ValueError("there is no such setting", at(where, path),
                   nearest.empty() ? "remove it" : "did you mean " + nearest + "?");
}

/// Parses, refusing what JSON leaves open: keys given twice, nesting without end.
json parseStrictly(const std::string& text, const std::string& where) {
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMaxDepth) throw ValueError("is nested too deeply", where, "check that it is a recipe");
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw ValueError("key '" + parsed.get<std::string>() + "' is given twice", where, "keep one");
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::exception& error) {
    throw ValueError(std::string("is not JSON: ") + error.what(), where, "correct the syntax");
  }
}

}  // namespace

json recipeToJson(const Recipe& recipe) {
  json root{{"version", kRecipeVersion},
            {"objects", json::array()},
            {"lights", json::array()},
            {"cameras", json::array()},
            {"layers", json::array()}};
  Recipe copy = recipe;
  forEachField(copy, [&](const FieldPlace& place, const FieldRef& field) {
    root[pointerOf(place.path())] = fieldToJson(field, place.parameter);
  });
  return root;
}

Recipe recipeFromJson(const json& given, const std::string& where) {
  if (!given.is_object()) throw ValueError("is not a recipe", where, "a recipe is a JSON object { }");
  checkVersion(given, where);
  const json root = withoutShortForms(given, where);
  Recipe recipe;
  resizeArrays(recipe, root, where);
  refuseUnknown(root, "", KnownKeys(recipe), where);
  forEachField(recipe, [&](const FieldPlace& place, const FieldRef& field) {
    const json::json_pointer pointer = pointerOf(place.path());
    if (root.contains(pointer)) fieldFromJson(field, place.parameter, root[pointer], at(where, place.path()));
  });
  checkRecipe(recipe, where);
  return recipe;
}

Recipe recipeFromText(const std::string& text, const std::string& where) {
  return recipeFromJson(parseStrictly(text, where), where);
}

Recipe loadRecipe(const std::filesystem::path& file) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) throw FileError("cannot be read: " + error.message(), file.string(), "check the path");
  if (bytes > kMaxFileBytes) throw FileError("is too large for a recipe", file.string(), "check the path");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw FileError("cannot be read", file.string(), "check its permissions");
  return recipeFromText(text.str(), file.string());
}

}  // namespace prt
