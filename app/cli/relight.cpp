// prt relight: a picture of a baked project under any light.

#include "libprt/project/relight.h"
#include "app/cli/picture_gl.h"
#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/log.h"
#include "libprt/project/project_file.h"

#include <fmt/format.h>

#include <chrono>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  ViewOptions view;
  std::string method, window, filter, backend = "cpu";
};

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

const PatchFilter* filterOf(const BakedScene& baked, const Recipe& recipe) {
  return recipe.method.name == "biscale" && baked.patch ? baked.patch->filter.get() : nullptr;
}

void relightProject(Session& session, const Options& options) {
  checkPictureOutput(options.view.output);
  const auto project = ProjectFile::open(options.view.project);
  Recipe recipe = project->recipe();
  if (!options.method.empty()) setByPath(recipe, "method.name", options.method);
  if (!options.filter.empty()) setByPath(recipe, "method.filter", options.filter == "on" ? "true" : "false");
  if (!options.window.empty()) setByPath(recipe, "method.window", options.window);
  const fs::path folder = folderOf(options.view.project);
  Pipeline pipeline(project.get(), {folder});
  const BakedScene baked = bakedScene(pipeline, recipe, options.view.project);
  if (!baked.final())
    logWarning(fmt::format("transfer is a preview, {} of {}; prt bake {} finishes it", baked.level,
                           baked.levels, options.view.project));
  const View view = viewOf(options.view, recipe, folder, baked.bounds());
  PictureOptions picture{view.width, view.height};
  picture.background = options.view.background;
  const auto begun = std::chrono::steady_clock::now();
  const Image image = options.backend == "gl"
                          ? relightGl(baked, recipe, view.lights, view.camera, picture, session.job())
                          : relight(baked, recipe, view.lights, view.camera, picture, session.job());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  writePicture(options.view.output, image, options.view.exposure);
  session.say(fmt::format("wrote {} ({} x {}, {:.0f} ms)", options.view.output, view.width, view.height,
                          1000 * seconds));
  nlohmann::json result{{"output", options.view.output}, {"width", view.width}, {"height", view.height},
                        {"backend", options.backend},    {"seconds", seconds},  {"level", baked.level},
                        {"levels", baked.levels}};
  if (const PatchFilter* filter = filterOf(baked, recipe)) {
    session.say(fmt::format("filtered by {} terms (error {:.2f} %), {} levels, {:.1f} MB",
                            PatchFilter::kTerms, 100 * filter->error(), filter->levels(),
                            double(filter->bytes()) * 1e-6));
    result["filter"] = {{"terms", PatchFilter::kTerms},
                        {"error", filter->error()},
                        {"levels", filter->levels()},
                        {"bytes", filter->bytes()}};
  }
  session.result(result);
}

}  // namespace

void addRelight(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("relight", "Picture of a baked project under any light");
  options->view.addTo(*command);
  command->add_option("--method", options->method, "auto, diffuse, glossy or biscale; default: the project's")
      ->check(CLI::IsMember(parameterAt("method.name").choices));
  command
      ->add_option("--window", options->window,
                   "Against ringing: none, hann, lanczos, fejer or dering; default: the project's")
      ->check(CLI::IsMember(parameterAt("method.window").choices));
  command
      ->add_option(
          "--filter", options->filter,
          "on or off: biscale shows the mean of the texels that a pixel covers; default: the project's")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_option("--backend", options->backend, "cpu or gl")
      ->check(CLI::IsMember({"cpu", "gl"}))
      ->capture_default_str();
  command->footer(
      "Examples:\n  prt relight bunny.prt --env sky.hdr --rotate 90 -o bunny.png\n"
      "  prt relight bunny.prt --light circle:45,30:20:8,7,6 --light constant:0.2 --size 1280x720 -o "
      "bunny.exr");
  command->callback([options, &action] { action = [options](Session& s) { relightProject(s, *options); }; });
}

}  // namespace prt::cli
