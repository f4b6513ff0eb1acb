// prt figures: figures of the papers, made anew.

#include "libprt/study/figures.h"
#include "app/cli/session.h"
#include "libprt/project/recipe.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

struct Options {
  std::string name, folder, mesh;
};

std::string listOfFigures() {
  std::string text = "Figures:\n";
  for (const FigureInfo& info : figures()) text += fmt::format("  {:<12} {}\n", info.name, info.shows);
  return text + "\nExample:\n  prt figures biscale-4 -o figures && xdg-open figures/index.html";
}

void make(Session& session, const Options& options) {
  std::vector<std::string> names;
  std::string list;
  for (const FigureInfo& info : figures())
    names.push_back(info.name), list += (list.empty() ? "" : ", ") + info.name;
  if (std::find(names.begin(), names.end(), options.name) == names.end()) {
    const std::string nearest = nearestName(options.name, names);
    throw UsageError("there is no figure '" + options.name + "'", "NAME",
                     (nearest.empty() ? "" : "did you mean " + nearest + "? ") + ("choose from " + list));
  }
  const nlohmann::json result = makeFigure(options.name, {options.folder, options.mesh}, session.job());
  session.say("open " + result.value("page", options.folder));
  session.result(result);
}

}  // namespace

void addFigures(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("figures", "Make figures of the papers anew: pictures and a page");
  command->add_option("NAME", options->name, "Which figure, of those below")->required();
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--mesh", options->mesh,
                      "A mesh file or builtin:NAME in place of the figures' own models");
  command->footer(listOfFigures);
  command->callback([options, &action] { action = [options](Session& s) { make(s, *options); }; });
}

}  // namespace prt::cli
