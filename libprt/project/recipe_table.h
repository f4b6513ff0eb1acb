#pragma once
// The one table of all recipe parameters, and the walk over it that reading, writing and paths share.
// Internal to project/.

#include "libprt/project/recipe.h"

#include <functional>
#include <variant>

namespace prt {

/// A value of one of a fixed set of names.
struct ChoiceRef {
  std::function<int()> get;
  std::function<void(int)> set;
};

/// A value inside a recipe.
using FieldRef = std::variant<bool*, int*, std::uint64_t*, float*, std::string*, Vec3*, ChoiceRef>;

/// Where a parameter sits: "transfer", "objects[2].material".
struct FieldPlace {
  std::string section;  ///< with indices; empty at the top level
  std::string name;
  const Parameter& parameter;

  std::string path() const { return section.empty() ? name : section + "." + name; }
};

/// Calls visit for every value of the recipe, in the table's order.
void forEachField(Recipe& recipe, const std::function<void(const FieldPlace&, const FieldRef&)>& visit);

/// The arrays of the recipe: "objects", "lights", "cameras", "layers".
struct RecipeArray {
  std::string name;
  std::size_t size;
  std::function<void(std::size_t)> resize;
};
std::vector<RecipeArray> recipeArrays(Recipe& recipe);

/// Throws ValueError when a text is not UTF-8: JSON, and so a recipe, cannot hold it.
void requireUtf8(const std::string& text, const std::string& where);

/// Value of a field as JSON, and the reverse. Writing checks type and range; `where` begins the message.
nlohmann::json fieldToJson(const FieldRef& field, const Parameter& parameter);
void fieldFromJson(const FieldRef& field, const Parameter& parameter, const nlohmann::json& value,
                   const std::string& where);

}  // namespace prt
