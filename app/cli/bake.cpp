// prt bake: makes the products of a recipe and saves them in a project.

#include "libprt/project/bake.h"
#include "app/cli/progress_bar.h"
#include "app/cli/recipe_page.h"
#include "app/cli/session.h"
#include "libprt/core/log.h"
#include "libprt/meso/rtt_seam.h"
#include "libprt/project/scenes.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

namespace prt::cli {
namespace {

struct Options {
  std::string input, output;
  std::vector<std::string> assignments, stages;
  double checkpointSeconds = 5;
};

/// The table of all parameters for --help.
std::string parameterHelp() {
  std::string text = "Settings for --set (short: mesh, transform and material mean objects[0]'s):\n";
  for (const Parameter& p : parameters()) {
    text += fmt::format("  {:<36} {} [{}]\n", p.path, p.doc, p.defaultText);
  }
  return text +
         "\nExample:\n  prt bake bunny.obj -o bunny.prt --set transfer.bounces=3 --set "
         "material.albedo=0.8,0.4,0.2";
}

void tell(const Session& session, const BakeSummary& s) {
  for (const BakeSummary::Object& object : s.objects)
    session.say(fmt::format("{}: {} vertices, {} triangles; {}", object.name, object.vertices,
                            object.triangles, object.repair));
  if (s.transfer) {
    const BakeSummary::TransferFacts& t = *s.transfer;
    session.say(fmt::format(
        "transfer: {}, {} bands, {} samples, {} rays each, {} bounces; {}, storage error {:.3f} %", t.form,
        t.bands, t.samples, t.rays, t.bounces, byteCount(double(t.bytes)), 100 * t.storageError));
  }
  if (s.floor)
    session.say(fmt::format(
        "errors to expect: interpolation floor {:.2f} % (+- {:.2f}), Monte Carlo {:.2f} %",
        100 * s.floor->interpolation, 100 * s.floor->interpolationError, 100 * s.floor->sampling));
  if (s.synthesis)
    session.say(
        fmt::format("patch on the surface: {} vertices, distance {:.3f} (1 = unrelated), coherence {:.1f} %",
                    s.synthesis->vertices, s.synthesis->distance, 100 * s.synthesis->coherence));
  if (s.atlas)
    session.say(
        fmt::format("atlas: {} charts, L2 stretch {:.4f} (largest {:.2f}), seams {:.2f} roots of the area, "
                    "{:.1f} % filled",
                    s.atlas->charts, s.atlas->l2, s.atlas->lInf, s.atlas->seam, 100 * s.atlas->filled));
  if (s.rtt) {
    const BakeSummary::RttFacts& r = *s.rtt;
    session.say(
        fmt::format("radiance transfer texture: {0} x {0} texels, {1} x {1} views, {2} functions, {3}, {4} "
                    "bounces, patch depth {5:.3f}; storage error {6:.3f} %",
                    r.texels, r.views, r.bands * r.bands, r.channels == 3 ? "RGB" : "scalar", r.bounces,
                    r.depth, 100 * r.storageError));
    if (r.viewError) {
      session.say(fmt::format("errors to expect of it: {:.1f} % between views, {:.1f} % beyond the outermost",
                              100 * r.viewError->between, 100 * r.viewError->beyond));
      if (r.views < 16 && r.viewError->between > kMuchViewError)
        logWarning(
            fmt::format("views of the patch differ too much to interpolate {0} x {0} of them; raise "
                        "rtt.views to {1} or make the patch thinner",
                        r.views, r.views < 12 ? 12 : 16));
    }
    if (r.seamStep > kVisibleSeam)
      logWarning(fmt::format(
          "the sample's borders do not meet (steps {:.1f} times those inside): repeats will show lines; "
          "set patch.seamless=true to take the steps away",
          r.seamStep));
    if (!r.warning.empty()) logWarning(r.warning);
  }
  for (const BakeSummary::StageTime& stage : s.stages)
    if (stage.made) session.say(fmt::format("  {:<10} {:8.2f} s", stage.name, stage.seconds));
  session.say(fmt::format("saved {} ({})", s.file.string(), byteCount(double(s.bytes))));
}

void bake(Session& session, const Options& options) {
  RecipeSource source = openRecipe(options.input);
  for (const std::string& assignment : options.assignments) setByAssignment(source.recipe, assignment);
  if (session.seed)
    source.recipe.transfer.seed = source.recipe.rtt.seed = source.recipe.synthesis.seed = *session.seed;
  BakeOptions bakeOptions;
  bakeOptions.output = options.output.empty() ? source.project : std::filesystem::path(options.output);
  if (bakeOptions.output.empty()) throw UsageError("no output is named", "-o", "add for example -o out.prt");
  bakeOptions.checkpointSeconds = options.checkpointSeconds;
  bakeOptions.stages = options.stages;
  const BakeSummary summary = bakeProject(source, bakeOptions, session.job());
  tell(session, summary);
  session.result(toJson(summary));
}

}  // namespace

void addBake(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("bake", "Bake a mesh, a recipe or a project; goes on where an earlier bake stopped");
  command
      ->add_option("INPUT", options->input,
                   "Mesh file, recipe (.json), project (.prt), scene:NAME or builtin:MESH")
      ->required();
  command->add_option("-o,--output", options->output, "Project to write (.prt); default: INPUT if it is one");
  command->add_option("--set", options->assignments, "PATH=VALUE of a setting below; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--stage", options->stages, "Only what this stage needs; may be repeated")
      ->check(CLI::IsMember(stageNames()))
      ->allow_extra_args(false);
  command->add_option("--checkpoint", options->checkpointSeconds, "Least seconds between checkpoints")
      ->check(finite())
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      ->add_flag_callback(
          "--help-all",
          [] {
            fmt::print("{}", recipePage());
            throw CLI::Success();
          },
          "Print every setting with its values and what changing it costs, as a page (Markdown)")
      ->trigger_on_parse();
  command->footer(parameterHelp);
  command->callback([options, &action] { action = [options](Session& s) { bake(s, *options); }; });
}

}  // namespace prt::cli
