// Editing a recipe by path.

#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <optional>

namespace prt {
namespace {

using nlohmann::json;

/// "mesh" -> "objects[0].mesh.path", "material.albedo" -> "objects[0].material.albedo".
std::string longForm(std::string path) {
  for (const char* section : {"mesh", "transform", "material"}) {
    const std::string prefix = section;
    if (path == prefix || path.starts_with(prefix + ".")) path = "objects[0]." + path;
  }
  return path.starts_with("objects[") && path.ends_with(".mesh") ? path + ".path" : path;
}

/// "objects[2].mesh.path" -> "objects[].mesh.path".
std::string pattern(const std::string& path) {
  std::string out;
  bool inside = false;
  for (char c : path) {
    if (c == ']') inside = false;
    if (!inside) out += c;
    if (c == '[') inside = true;
  }
  return out;
}

std::vector<std::string> withShortForms(std::vector<std::string> paths) {
  const std::string first = "objects[0].";
  for (std::size_t i = paths.size(); i-- > 0;)
    if (paths[i].starts_with(first) && paths[i] != "objects[0].name")
      paths.push_back(paths[i].substr(first.size()));
  return paths;
}

[[noreturn]] void noSuchPath(const std::string& path, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(path, withShortForms(known));
  throw ValueError("there is no such setting", path,
                   nearest.empty() ? "prt bake --help lists them" : "did you mean " + nearest + "?");
}

/// If the path names the entry just behind the end of an array, appends it.
void growFor(Recipe& recipe, const std::string& path) {
  for (const RecipeArray& array : recipeArrays(recipe))
    if (path.starts_with(array.name + "[" + std::to_string(array.size) + "].") && array.size < 4096) {
      array.resize(array.size + 1);
      return;
    }
}

struct Found {
  FieldRef field;
  const Parameter* parameter;
};

Found find(Recipe& recipe, const std::string& path) {
  const std::string wanted = longForm(path);
  std::optional<Found> found;
  forEachField(recipe, [&](const FieldPlace& place, const FieldRef& field) {
    if (!found && place.path() == wanted) found = Found{field, &place.parameter};
  });
  if (!found) noSuchPath(path, pathsOf(recipe));
  return *found;
}

/// The JSON that a command line's text means for a parameter.
json valueOf(const Parameter& p, const std::string& text) {
  const bool wantsText =
      p.type == ParameterType::Text || p.type == ParameterType::File || p.type == ParameterType::Choice;
  json value = json::parse(text, nullptr, false);
  if (wantsText) return value.is_string() ? value : json(text);
  if (p.type == ParameterType::Color || p.type == ParameterType::Vector) {
    if (value.is_discarded()) value = json::parse("[" + text + "]", nullptr, false);
    if (value.is_number() && p.type == ParameterType::Color) value = json{value, value, value};
  }
  return value.is_discarded() ? json(text) : value;
}

}  // namespace

std::vector<std::string> pathsOf(const Recipe& recipe) {
  Recipe copy = recipe;
  std::vector<std::string> paths;
  forEachField(copy, [&](const FieldPlace& place, const FieldRef&) { paths.push_back(place.path()); });
  return paths;
}

const Parameter& parameterAt(const std::string& path) {
  const std::string wanted = pattern(longForm(path));
  for (const Parameter& p : parameters())
    if (p.path == wanted) return p;
  std::vector<std::string> known;
  for (const Parameter& p : parameters()) {
    std::string& first = known.emplace_back();
    for (char c : p.path) first.append(c == ']' ? "0]" : std::string(1, c));
  }
  noSuchPath(path, known);
}

void setByPath(Recipe& recipe, const std::string& path, const std::string& value) {
  Recipe edited = recipe;
  growFor(edited, longForm(path));
  const Found found = find(edited, path);
  fieldFromJson(found.field, *found.parameter, valueOf(*found.parameter, value), path);
  checkRecipe(edited, "");
  recipe = std::move(edited);
}

void setByAssignment(Recipe& recipe, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw ValueError("'" + assignment + "' is not PATH=VALUE", "", "write for example transfer.bounces=3");
  setByPath(recipe, assignment.substr(0, equals), assignment.substr(equals + 1));
}

json getByPath(const Recipe& recipe, const std::string& path) {
  Recipe copy = recipe;
  const Found found = find(copy, path);
  return fieldToJson(found.field, *found.parameter);
}

std::string toString(ParameterType type) {
  static const std::map<ParameterType, std::string> names{{ParameterType::Boolean, "true or false"},
                                                          {ParameterType::Integer, "whole number"},
                                                          {ParameterType::Number, "number"},
                                                          {ParameterType::Text, "text"},
                                                          {ParameterType::File, "file"},
                                                          {ParameterType::Choice, "choice"},
                                                          {ParameterType::Color, "[r, g, b]"},
                                                          {ParameterType::Vector, "[x, y, z]"}};
  return names.at(type);
}

}  // namespace prt
