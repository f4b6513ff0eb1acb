// prt info: what is inside a project.

#include "app/cli/progress_bar.h"
#include "app/cli/session.h"
#include "libprt/project/project_file.h"
#include "libprt/project/scenes.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

std::string shapeText(const std::vector<std::int64_t>& shape) {
  return nlohmann::json(shape).dump();
}

nlohmann::json toJson(const ProductInfo& info) {
  nlohmann::json arrays = nlohmann::json::array();
  for (const ArrayInfo& a : info.arrays)
    arrays.push_back({{"name", a.name},
                      {"dtype", toString(a.dtype)},
                      {"shape", a.shape},
                      {"bytes", a.bytes},
                      {"stored", a.stored},
                      {"checksum", a.checksum}});
  return {{"stage", info.stage},
          {"key", info.key},
          {"checkpoint", info.checkpoint},
          {"level", info.level},
          {"levels", info.levels},
          {"meta", nlohmann::json::parse(info.meta, nullptr, false)},
          {"arrays", arrays}};
}

std::string levelText(const ProductInfo& info) {
  if (info.checkpoint) return "unfinished work";
  return info.level >= info.levels ? "final" : fmt::format("preview {} of {}", info.level, info.levels);
}

void tellProduct(const Session& session, const ProductInfo& info) {
  std::int64_t bytes = 0, stored = 0;
  for (const ArrayInfo& a : info.arrays) bytes += a.bytes, stored += a.stored;
  session.say(fmt::format("{:<10} {:<16} {} ({} in the file)", info.stage, levelText(info),
                          byteCount(double(bytes)), byteCount(double(stored))));
  for (const ArrayInfo& a : info.arrays)
    session.say(fmt::format("    {:<24} {} {}", a.name, toString(a.dtype), shapeText(a.shape)));
}

void info(Session& session, const std::string& file) {
  const auto project = ProjectFile::open(file);
  const Recipe& recipe = project->recipe();
  nlohmann::json products = nlohmann::json::array();
  session.say(fmt::format("{}: {}", file, byteCount(double(project->bytes()))));
  for (std::size_t i = 0; i < recipe.objects.size(); ++i)
    session.say(fmt::format("object {}: {}", recipe.objects[i].name, recipe.objects[i].mesh.path));
  for (const LightRecipe& light : recipe.lights)
    session.say(fmt::format("light {}: {}{}", light.name, light.path, light.on ? "" : " (off)"));
  for (const CameraRecipe& camera : recipe.cameras) session.say(fmt::format("camera {}", camera.name));
  for (const ProductInfo& product : project->contents()) {
    tellProduct(session, product);
    products.push_back(toJson(product));
  }
  session.result({{"file", file},
                  {"bytes", project->bytes()},
                  {"recipe", recipeToJson(recipe)},
                  {"products", products}});
}

}  // namespace

void addInfo(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("info", "Show what is inside a project");
  command->add_option("PROJECT", *file, "Project (.prt)")->required();
  command->footer("Example:\n  prt info bunny.prt --json");
  command->callback([file, &action] { action = [file](Session& s) { info(s, *file); }; });
}

}  // namespace prt::cli
