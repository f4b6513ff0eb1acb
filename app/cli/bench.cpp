// prt bench: one measurement against its limit or its rival, in one run.

#include "libprt/study/bench.h"
#include "app/cli/bench_gl.h"
#include "app/cli/session.h"
#include "libprt/project/recipe.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

struct Options {
  std::string name, mesh;
  int repetitions = 0;
  bool large = false;
};

std::vector<BenchInfo> allBenches() {
  std::vector<BenchInfo> all = benches();
  all.push_back(glBenchInfo());
  return all;
}

std::vector<std::string> benchNames() {
  std::vector<std::string> names;
  for (const BenchInfo& info : allBenches()) names.push_back(info.name);
  return names;
}

/// An unknown name is a mistake on the command line.
void requireKnown(const std::string& name) {
  const std::vector<std::string> names = benchNames();
  std::string list;
  for (const std::string& known : names) {
    if (known == name) return;
    list += (list.empty() ? "" : ", ") + known;
  }
  const std::string nearest = nearestName(name, names);
  throw UsageError("there is no bench '" + name + "'", "NAME",
                   (nearest.empty() ? "" : "did you mean " + nearest + "? ") + ("choose from " + list));
}

void bench(Session& session, const Options& options) {
  requireKnown(options.name);
  if (!options.mesh.empty() && options.name != "atlas" && options.name != "pipeline")
    throw UsageError("bench " + options.name + " takes no mesh", "--mesh",
                     "use it with bench atlas or pipeline");
  if (options.large && (options.name != "atlas" || !options.mesh.empty()))
    throw UsageError("only bench atlas without a mesh has a large shape", "--large",
                     "use it with bench atlas");
  const BenchResult result =
      options.name == glBenchInfo().name ? runGlBench(session.job(), options.repetitions)
      : options.large                    ? runLargeAtlasBench(session.job())
      : options.mesh.empty()             ? runBench(options.name, session.job(), options.repetitions)
      : options.name == "pipeline"       ? runPipelineBench(pipelineBenchRecipe(options.mesh), session.job())
                                         : runAtlasBench(options.mesh, session.job(), options.repetitions);
  session.say(fmt::format("{}: {:.3f} of the limit", result.name, result.ratio));
  session.say(fmt::format("  ours     {:.4g} {}", result.ours.value, result.ours.unit));
  session.say(fmt::format("  against  {:.4g} {} ({})", result.against.value, result.against.unit,
                          result.againstWhat));
  for (const auto& [name, value] : result.details) session.say(fmt::format("  {:<32} {:.5g}", name, value));
  session.result(toJson(result));
}

std::string listOfBenches() {
  std::string text = "Benches:\n";
  for (const BenchInfo& info : allBenches()) text += fmt::format("  {:<12} {}\n", info.name, info.measures);
  return text + "\nExample:\n  prt bench bake --json";
}

}  // namespace

void addBench(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("bench", "Measure one thing against its limit or its rival");
  command->add_option("NAME", options->name, "Which bench, of those below")->required();
  command
      ->add_option("--repetitions", options->repetitions,
                   "How often both sides are timed; 0 = as often as is needed")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_option("--mesh", options->mesh,
                      "bench atlas, pipeline: a mesh file instead of the built-in shapes");
  command->add_flag("--large", options->large, "bench atlas: a million triangles against a hundred thousand");
  command->footer(listOfBenches);
  command->callback([options, &action] { action = [options](Session& s) { bench(s, *options); }; });
}

}  // namespace prt::cli
