// prt export: a baked project as plain files.

#include "libprt/project/export.h"
#include "app/cli/session.h"
#include "libprt/core/log.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/errors.h"
#include "libprt/project/lights.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/project_file.h"
#include "libprt/project/synthesis_stages.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string project, npy, exr, gltf;
  double exposure = 0;
  bool errors = false;
};

/// Where the bake is wrong under the project's lights, also in words.
std::shared_ptr<const ErrorMap> estimate(Session& session, const ExportInput& input) {
  const BakedScene& baked = input.baked;
  const std::shared_ptr<const Transfer> transfer(baked.transfer, &baked.transfer->transfer);
  const ErrorProbe probe =
      probeErrors(*baked.geometry->scene, *baked.samples->samples, transfer, input.recipe, session.job());
  auto map = std::make_shared<ErrorMap>(
      probe.under(judgedLight(input.lights, transfer->bands, input.recipe.method)));
  session.say(
      fmt::format("estimated error {:.2f} %: Monte Carlo {:.2f}, interpolation {:.2f}, truncation {:.2f}",
                  100 * map->totalRms(), 100 * map->rms.x, 100 * map->rms.y, 100 * map->rms.z));
  return map;
}

void exportProject(Session& session, const Options& options) {
  if (options.npy.empty() && options.exr.empty() && options.gltf.empty())
    throw UsageError("nothing to write is named", "", "add --npy DIR, --exr DIR or --gltf DIR");
  if (options.errors && options.npy.empty())
    throw UsageError("--error-estimate is written with the arrays", "", "add --npy DIR");
  const auto project = ProjectFile::open(options.project);
  const fs::path file = options.project, folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Pipeline pipeline(project.get(), {folder});
  EnvironmentCache environments;
  const Recipe& recipe = project->recipe();
  const auto rtt = pipeline.find(recipe, {"rtt"}).get<RttProduct>("rtt");
  const auto patch = pipeline.find(recipe, {"patch"}).get<PatchProduct>("patch");
  const auto atlas = pipeline.find(recipe, {"atlas"}).get<AtlasProduct>("atlas");
  const Products laid = pipeline.find(recipe, {"synthesis", "idmap"});
  const auto synthesis = laid.get<SynthesisProduct>("synthesis");
  const auto idmap = laid.get<IdMapProduct>("idmap");
  if (synthesis && synthesis->meso && !options.npy.empty() &&
      !pipeline.find(recipe, {"transfer"}).state("transfer")) {
    const Products made = pipeline.run(recipe, {"scene", "frames"}, session.job());
    const ExportParts parts{made.get<SceneProduct>("scene")->scene->mesh,
                            made.get<FramesProduct>("frames")->frames,
                            atlas ? atlas->atlas.get() : nullptr,
                            rtt ? rtt->rtt.get() : nullptr,
                            patch ? patch->patch.get() : nullptr,
                            synthesis.get(),
                            idmap.get()};
    const ExportedFiles files = exportParts(parts, options.npy, session.job());
    session.say(fmt::format("wrote the patch on the surface to {}", options.npy));
    session.result({{"npy", {{"folder", options.npy}, {"files", files}}}});
    return;
  }
  if (rtt && rtt->rtt && !options.npy.empty() && !pipeline.find(recipe, {"transfer"}).state("transfer")) {
    const ExportedFiles files = exportRtt(*rtt->rtt, patch ? patch->patch.get() : nullptr, options.npy);
    session.say(fmt::format("wrote the radiance transfer texture alone to {}", options.npy));
    session.result({{"npy", {{"folder", options.npy}, {"files", files}}}});
    return;
  }
  if (atlas && !options.npy.empty() && !pipeline.find(recipe, {"transfer"}).state("transfer")) {
    const auto scene = pipeline.run(recipe, {"scene"}, session.job()).get<SceneProduct>("scene");
    const ExportedFiles files = exportAtlas(scene->scene->mesh, *atlas, options.npy, session.job());
    session.say(fmt::format("wrote the atlas alone to {}", options.npy));
    session.result({{"npy", {{"folder", options.npy}, {"files", files}}}});
    return;
  }
  const BakedScene baked = bakedScene(pipeline, recipe, options.project);
  const auto frames = pipeline.run(recipe, {"frames"}, session.job()).get<FramesProduct>("frames");
  ExportInput input{recipe, baked, frames, makeLightRig(recipe.lights, folder, environments)};
  if (!input.baked.final())
    logWarning(fmt::format("transfer is a preview, {} of {}", input.baked.level, input.baked.levels));
  nlohmann::json written;
  if (options.errors) input.errors = estimate(session, input);
  if (rtt) input.rtt = rtt->rtt;
  if (atlas) input.atlas = atlas->atlas;
  input.synthesis = synthesis, input.idmap = idmap;
  if (patch) input.patch = patch->patch;
  const auto note = [&](const char* kind, const std::string& where, const ExportedFiles& files) {
    session.say(fmt::format("wrote {} files to {}", files.size(), where));
    written[kind] = {{"folder", where}, {"files", files}};
  };
  if (!options.npy.empty()) note("npy", options.npy, exportNpy(input, options.npy, session.job()));
  if (!options.exr.empty()) note("exr", options.exr, exportExr(input, options.exr, session.job()));
  if (!options.gltf.empty())
    note("gltf", options.gltf, exportGltf(input, options.gltf, options.exposure, session.job()));
  session.result(written);
}

}  // namespace

void addExport(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("export", "Write plain files with a manifest.json: numpy arrays, EXR, glTF");
  command->add_option("PROJECT", options->project, "Baked project (.prt)")->required();
  command->add_option("--npy", options->npy, "Folder for .npy arrays: geometry, transfer, light");
  command->add_flag("--error-estimate", options->errors,
                    "Estimate where the bake is wrong and add it to --npy; takes about as long as the bake");
  command->add_option("--exr", options->exr,
                      "Folder for .exr pictures: the light, and a picture of each camera");
  command->add_option("--gltf", options->gltf,
                      "Folder for a .glb with the current light baked into vertex colours");
  command->add_option("--exposure", options->exposure, "Stops, for the vertex colours")
      ->check(finite())
      ->check(CLI::Range(-30.0, 30.0))
      ->capture_default_str();
  command->footer(
      "Example:\n  prt export bunny.prt --npy arrays && python3 -c \"import numpy; "
      "print(numpy.load('arrays/transfer_diffuse.npy').shape)\"");
  command->callback([options, &action] { action = [options](Session& s) { exportProject(s, *options); }; });
}

}  // namespace prt::cli
