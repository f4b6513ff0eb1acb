// prt reference: the ground truth of a project's picture, path traced.

#include "libprt/shade/reference.h"
#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/image_io.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/project/project_file.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  ViewOptions view;
  int samples = 256;
  std::optional<int> bounces;
  bool diffuseBounces = false;
  std::string noise;
};

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void reference(Session& session, const Options& options) {
  checkPictureOutput(options.view.output);
  if (!options.noise.empty()) checkPictureOutput(options.noise);
  const auto project = ProjectFile::open(options.view.project);
  const Recipe& recipe = project->recipe();
  const fs::path folder = folderOf(options.view.project);
  Pipeline pipeline(project.get(), {folder});
  const Products products = pipeline.run(withCapturedInside(recipe), {"scene"}, session.job());
  const Scene scene = withMaterials(*products.get<SceneProduct>("scene")->scene, recipe);
  const View view = viewOf(options.view, recipe, folder, scene.mesh.bounds());
  const PathTracer tracer(scene, view.lights, session.job(), emissionOf(recipe));
  PathOptions path;
  path.bounces = options.bounces.value_or(recipe.transfer.bounces);
  path.diffuseBounces = options.diffuseBounces;
  path.seed = session.seed.value_or(1);
  ReferenceImage image(tracer, view.camera, view.width, view.height, path);
  image.add(options.samples, session.job());
  writePicture(options.view.output, image.radiance(options.view.background), options.view.exposure);
  if (!options.noise.empty())
    writePicture(options.noise, image.standardError(options.view.background), options.view.exposure);
  session.say(fmt::format("wrote {} ({} x {}, {} paths per pixel, {} bounces)", options.view.output,
                          view.width, view.height, image.samples(), path.bounces));
  session.result({{"output", options.view.output},
                  {"width", view.width},
                  {"height", view.height},
                  {"spp", image.samples()},
                  {"bounces", path.bounces},
                  {"seed", path.seed}});
}

}  // namespace

void addReference(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("reference", "Path-traced ground truth for the same picture");
  options->view.addTo(*command);
  command->add_option("--spp", options->samples, "Paths per pixel")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command->add_option("--bounces", options->bounces, "Interreflections; default: the project's")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--diffuse-bounces", options->diffuseBounces,
                    "Surfaces seen by way of another reflect diffusely, as baked transfer has it");
  command->add_option("--noise", options->noise, "Also write the standard error of each pixel, .exr");
  command->footer(
      "Two references with different --seed cancel each other's noise: see prt compare --second-reference.\n"
      "Example:\n  prt reference bunny.prt --env sky.hdr --spp 1024 --bounces 3 --seed 2 -o truth.exr");
  command->callback([options, &action] { action = [options](Session& s) { reference(s, *options); }; });
}

}  // namespace prt::cli
