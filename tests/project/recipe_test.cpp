#include "libprt/project/recipe.h"

#include "libprt/atlas/chart_settings.h"
#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

namespace prt {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const ValueError& error) {
    return error.what();
  }
  return "no error";
}

/// Settings of charts, as text.
std::string randomCharts() {
  std::vector<ChartSettings> charts(std::size_t(*rc::gen::inRange(0, 4)));
  for (ChartSettings& chart : charts) {
    chart.face = std::uint32_t(*rc::gen::inRange(0, 1000));
    chart.weight = double(*rc::gen::inRange(1, 1000)) / 100;
    if (*rc::gen::arbitrary<bool>()) chart.corners = {0, 0.25, 0.5, 0.75};
    if (*rc::gen::arbitrary<bool>()) chart.place = ChartPlacement{0.25, 0, {0.5, 0.125}, true};
    chart.locked = *rc::gen::arbitrary<bool>();
  }
  return chartSettingsToText(charts);
}

/// A random value that a parameter allows.
json randomValue(const Parameter& p) {
  const auto number = [&] {
    const double low = p.low == p.high ? -1000 : p.low, high = p.low == p.high ? 1000 : p.high;
    return double(float(low + (high - low) * double(*rc::gen::inRange(0, 1 << 20)) / (1 << 20)));
  };
  if (p.path == "objects[].charts") return randomCharts();
  switch (p.type) {
    case ParameterType::Boolean:
      return *rc::gen::arbitrary<bool>();
    case ParameterType::Integer:
      return std::int64_t(p.low +
                          std::floor((p.high - p.low) * double(*rc::gen::inRange(0, 1 << 20)) / (1 << 20)));
    case ParameterType::Number:
      return number();
    case ParameterType::Choice:
      return *rc::gen::elementOf(p.choices);
    case ParameterType::Color:
    case ParameterType::Vector:
      return json{number(), number(), number()};
    default:
      return *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~')));
  }
}

Recipe randomRecipe() {
  Recipe recipe;
  recipe.objects.resize(std::size_t(*rc::gen::inRange(1, 4)));
  recipe.lights.resize(std::size_t(*rc::gen::inRange(0, 4)));
  recipe.cameras.resize(std::size_t(*rc::gen::inRange(0, 3)));
  forEachField(recipe, [](const FieldPlace& place, const FieldRef& field) {
    fieldFromJson(field, place.parameter, randomValue(place.parameter), place.path());
  });
  recipe.objects[0].visible = true;  // one must be
  return recipe;
}

bool isSound(const Recipe& recipe) {
  return errorOf([&] { checkRecipe(recipe, ""); }) == "no error";
}

RC_GTEST_PROP(Recipe, SurvivesJson, ()) {
  const Recipe recipe = randomRecipe();
  RC_PRE(isSound(recipe));
  RC_ASSERT(recipeFromText(recipeToJson(recipe).dump(2), "test") == recipe);
}

RC_GTEST_PROP(Recipe, EveryPathCanBeReadAndSet, ()) {
  const Recipe recipe = randomRecipe();
  RC_PRE(isSound(recipe));
  Recipe copy;
  copy.objects.resize(recipe.objects.size());
  copy.lights.resize(recipe.lights.size());
  copy.cameras.resize(recipe.cameras.size());
  for (const std::string& path : pathsOf(recipe)) {
    if (path.ends_with(".eye") || path.ends_with(".target") || path.ends_with(".up"))
      continue;  // bound together
    setByPath(copy, path, getByPath(recipe, path).dump());
    RC_ASSERT(getByPath(copy, path) == getByPath(recipe, path));
  }
}

TEST(Recipe, DefaultsSurviveJson) {
  EXPECT_EQ(recipeFromJson(recipeToJson(Recipe{}), ""), Recipe{});
}

TEST(Recipe, FloatsPrintAsWritten) {
  Recipe recipe;
  setByPath(recipe, "material.albedo", "[0.3, 0.2, 0.1]");
  EXPECT_EQ(getByPath(recipe, "material.albedo").dump(), "[0.3,0.2,0.1]");
}

TEST(Recipe, OneObjectIsShownAtLeast) {
  Recipe recipe;
  EXPECT_THAT(errorOf([&] { setByPath(recipe, "objects[0].visible", "false"); }),
              HasSubstr("hides every object"));
  EXPECT_TRUE(recipe.objects[0].visible);
  setByPath(recipe, "objects[1].mesh.path", "builtin:box");
  setByPath(recipe, "objects[0].visible", "false");
  EXPECT_FALSE(recipe.objects[0].visible);
  EXPECT_THAT(errorOf([&] { setByPath(recipe, "objects[1].visible", "false"); }), HasSubstr("show one"));
}

TEST(Recipe, ShortFormsMeanTheFirstObject) {
  Recipe recipe;
  setByPath(recipe, "mesh", "bunny.obj");
  EXPECT_EQ(recipe.objects[0].mesh.path, "bunny.obj");
  setByPath(recipe, "mesh.path", "spot.obj");
  EXPECT_EQ(recipe.objects[0].mesh.path, "spot.obj");
  setByPath(recipe, "material.model", "phong");
  EXPECT_EQ(recipe.objects[0].material.model, MaterialModel::Phong);
  const Recipe fromJson = recipeFromText(R"({"mesh": "a.obj", "material": {"albedo": [1, 0, 0]}})", "r");
  EXPECT_EQ(fromJson.objects[0].mesh.path, "a.obj");
  EXPECT_EQ(fromJson.objects[0].material.albedo, Rgb(1, 0, 0));
}

TEST(Recipe, PathsAppendTheNextEntry) {
  Recipe recipe;
  setByPath(recipe, "lights[1].kind", "circle");
  ASSERT_EQ(recipe.lights.size(), 2u);
  EXPECT_THAT(errorOf([&] { setByPath(recipe, "lights[5].kind", "circle"); }), HasSubstr("no such setting"));
}

TEST(Recipe, AFailedEditChangesNothing) {
  Recipe recipe;
  EXPECT_THROW(setByPath(recipe, "lights[1].angle", "-3"), ValueError);
  EXPECT_EQ(recipe, Recipe{});
}

TEST(Recipe, ErrorsNameTheNearestPath) {
  Recipe r;
  const auto set = [&](const char* path, const char* value) {
    return errorOf([&] { setByPath(r, path, value); });
  };
  EXPECT_THAT(set("transfer.bonces", "3"), HasSubstr("did you mean transfer.bounces?"));
  EXPECT_THAT(set("material.albdo", "1"), HasSubstr("did you mean material.albedo?"));
  EXPECT_THAT(set("mesh.pth", "x"), HasSubstr("did you mean mesh.path?"));
  EXPECT_THAT(set("transfer.kind", "matrx"), HasSubstr("did you mean matrix?"));
  EXPECT_THAT(set("transfer.bands", "11"), HasSubstr("use 1 to 10"));
  EXPECT_THAT(set("transfer.bands", "2.5"), HasSubstr("whole number"));
  EXPECT_THAT(set("transfer.bands", "many"), HasSubstr("number"));
  EXPECT_THAT(set("transfer.shadows", "maybe"), HasSubstr("true or false"));
  EXPECT_THAT(set("material.albedo", "[1, 2]"), HasSubstr("[r, g, b]"));
  EXPECT_THAT(set("material.albedo", "nan"), HasSubstr("is not"));
  EXPECT_THAT(set("transform.scale", "0,1,1"), HasSubstr("flattens"));
}

TEST(Recipe, ColoursTakeGreyAndCommas) {
  Recipe r;
  setByPath(r, "material.albedo", "0.25");
  EXPECT_EQ(r.objects[0].material.albedo, Rgb(0.25f));
  setByPath(r, "material.albedo", "1, 0.5, 0");
  EXPECT_EQ(r.objects[0].material.albedo, Rgb(1, 0.5f, 0));
}

TEST(Recipe, JsonIsReadStrictly) {
  const auto read = [](const char* text) { return errorOf([&] { recipeFromText(text, "r.json"); }); };
  EXPECT_THAT(read("{"), HasSubstr("r.json: is not JSON"));
  EXPECT_THAT(read("[]"), HasSubstr("not a recipe"));
  EXPECT_THAT(read(R"({"transfr": {"bands": 3}})"), HasSubstr("r.json: transfr: there is no such setting"));
  EXPECT_THAT(read(R"({"transfer": {"band": 3}})"), HasSubstr("did you mean transfer.bands?"));
  EXPECT_THAT(read(R"({"transfer": {"bands": "3"}})"), HasSubstr("transfer.bands"));
  EXPECT_THAT(read(R"({"transfer": 3})"), HasSubstr("write it in { }"));
  EXPECT_THAT(read(R"({"transfer": {"bands": {}}})"), HasSubstr("transfer.bands"));
  EXPECT_THAT(read(R"({"transfer": {}, "transfer": {}})"), HasSubstr("given twice"));
  EXPECT_THAT(read(R"({"mesh": "a", "objects": [{"mesh": "b"}]})"), HasSubstr("given twice"));
  EXPECT_THAT(read(R"({"objects": []})"), HasSubstr("at least one object"));
  EXPECT_THAT(read(R"({"objects": {}})"), HasSubstr("not a list"));
  EXPECT_THAT(read(R"({"lights": [7]})"), HasSubstr("lights[0]"));
  EXPECT_THAT(read(R"({"version": 99})"), HasSubstr("newer"));
  EXPECT_THAT(read(R"({"version": "1"})"), HasSubstr("version"));
  EXPECT_THAT(read(R"({"lights": [{"direction": [0, 0, 0]}]})"), HasSubstr("has no length"));
  EXPECT_EQ(read(R"({"transfer": {}, "objects": [{}]})"), "no error");
}

TEST(Recipe, EveryParameterIsDescribed) {
  std::set<std::string> paths;
  for (const Parameter& p : parameters()) {
    EXPECT_TRUE(paths.insert(p.path).second) << p.path << " twice";
    EXPECT_FALSE(p.doc.empty() || p.cost.empty() || p.defaultText.empty()) << p.path;
    EXPECT_EQ(p.doc.back(), '.') << p.path;
    EXPECT_EQ(p.type == ParameterType::Choice, !p.choices.empty()) << p.path;
    EXPECT_EQ(&parameterAt(p.path), &p);
  }
}

TEST(Recipe, TransformScalesTurnsThenMoves) {
  const TransformRecipe t{{1, 0, 0}, {0, 90, 0}, {2, 1, 1}};
  const Vec3 p = Vec3(t.matrix() * Vec4(1, 0, 0, 1));
  EXPECT_NEAR(length(p - Vec3(1, 0, -2)), 0, 1e-6f);
}

TEST(Recipe, RelativePathsFollowAMove) {
  Recipe r;
  r.objects[0].mesh.path = "meshes/bunny.obj";
  r.lights.push_back(r.lights[0]);
  r.lights[1].path = "/abs/sky.exr";
  rebasePaths(r, "/home/a/work", "/home/a/out");
  EXPECT_EQ(r.objects[0].mesh.path, "../work/meshes/bunny.obj");
  EXPECT_EQ(r.lights[0].path, "builtin:clear-sky");
  EXPECT_EQ(r.lights[1].path, "/abs/sky.exr");
}

TEST(Recipe, UnreadableFilesAreFileErrors) {
  EXPECT_THROW(loadRecipe("/nonexistent/recipe.json"), FileError);
  EXPECT_THROW(loadRecipe("/tmp"), FileError);
}

TEST(Recipe, TextThatJsonCannotHoldIsRefused) {
  Recipe recipe;
  for (const char* setting : {"mesh.path=caf\xe9.obj", "objects[0].name=\xff", "lights[0].path=\xc0\xaf"})
    EXPECT_THAT(errorOf([&] { setByAssignment(recipe, setting); }), HasSubstr("not UTF-8")) << setting;
  setByAssignment(recipe, "objects[0].name=caf\xc3\xa9");
  EXPECT_EQ(recipe.objects[0].name, "caf\xc3\xa9");
}

TEST(NearestName, ForgivesTyposButNotNonsense) {
  EXPECT_EQ(nearestName("bnads", {"bands", "rays"}), "bands");
  EXPECT_EQ(nearestName("xyzzy", {"bands", "rays"}), "");
}

}  // namespace
}  // namespace prt
