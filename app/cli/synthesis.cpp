// prt synthesis: looks at how the patch was laid over the surface.

#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/image_io.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/export_synthesis.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/project/project_file.h"
#include "libprt/shade/biscale.h"
#include "libprt/shade/patch_look.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  ViewOptions view;  // its output is the picture of the surface
  std::string map;
  bool ids = false, quality = false;
};

/// What the project holds of the patch on the surface.
struct Laid {
  std::shared_ptr<const SynthesisProduct> synthesis;
  std::shared_ptr<const IdMapProduct> idmap;
  Products products;  // these, and what a picture of them needs
};

Laid laidPatch(Pipeline& pipeline, const Recipe& recipe, const std::string& project, Job& job) {
  Products products = pipeline.find(recipe, {"synthesis", "idmap", "atlas", "rtt", "layers"});
  Laid laid{products.get<SynthesisProduct>("synthesis"), products.get<IdMapProduct>("idmap"), {}};
  if (!laid.synthesis || !laid.synthesis->meso)
    throw ValueError("holds no patch laid over the surface", project,
                     resolved(recipe).synthesis.mapping == PatchMapping::Uv
                         ? "synthesis.mapping=uv needs none"
                         : "set patch.model and run prt bake --stage idmap");
  products.states.merge(pipeline.run(recipe, {"scene", "frames", "samples"}, job).states);
  laid.products = std::move(products);
  return laid;
}

/// The transfer that the project holds, where the patch can be lit by it: at vertices, with as much as it
/// needs.
std::shared_ptr<const TransferProduct> transferFor(Pipeline& pipeline, const Recipe& recipe,
                                                   const SampleSet& samples, const BiscaleSurface& patch) {
  const auto found = pipeline.find(recipe, {"transfer"}).get<TransferProduct>("transfer");
  const bool serves =
      found && samples.vertices > 0 && (found->transfer.form != TransferForm::Diffuse || patch.matte);
  if (serves) return found;
  Transfer none;
  none.bands = patch.responses->bands();
  return std::make_shared<TransferProduct>(std::move(none));
}

void drawSurface(Session& session, const Options& options, Pipeline& pipeline, const Recipe& recipe,
                 const fs::path& folder, const Laid& laid) {
  const auto patch = prt::laidPatch(laid.products, recipe);
  if (!patch) throw ValueError("holds no id map", options.view.project, "run prt bake --stage idmap");
  const TriMesh& mesh = patch->scene->mesh;
  const View view = viewOf(options.view, recipe, folder, mesh.bounds());
  const auto picture = [&]() -> Image {
    if (options.ids)
      return patchColours(mesh, *patch->cover, view.camera, view.width, view.height, 2, session.job());
    const SampleSet& samples = *laid.products.get<SamplesProduct>("samples")->samples;
    const auto baked = transferFor(pipeline, recipe, samples, *patch);
    const Transfer& transfer = baked->transfer;
    const ShRgb light = lightFor(view.lights, transfer.bands, recipe.method);
    return renderBiscale({*patch, samples, transfer, light, nullptr, recipe.method.viewDependent},
                         view.camera, view.width, view.height, 2, session.job());
  };
  writePicture(options.view.output, picture(), options.view.exposure);
  session.say("wrote " + options.view.output);
}

nlohmann::json describe(Session& session, const Options& options, const Recipe& recipe, const Laid& laid) {
  const SynthesisProduct& s = *laid.synthesis;
  nlohmann::json json{{"vertices", s.meso->vertexCount()},
                      {"levels", s.meso->levels()},
                      {"edge", s.meso->edge},
                      {"patch_width", s.patchWidth},
                      {"distance", s.quality.distance},
                      {"coherence", s.quality.coherence},
                      {"longest_repeat", s.quality.longestRepeat}};
  session.say(fmt::format("{} vertices {:.4g} apart; the patch is {:.4g} wide", s.meso->vertexCount(),
                          s.meso->edge, s.patchWidth));
  session.say(
      fmt::format("distance {:.3f} (1 = unrelated), coherence {:.1f} %, longest repeat {:.1f} patches",
                  s.quality.distance, 100 * s.quality.coherence, s.quality.longestRepeat));
  if (!options.quality) return json;
  const auto atlas = laid.products.get<AtlasProduct>("atlas");
  const SynthesisQuality q = qualityOf(
      s, laid.products.get<SceneProduct>("scene")->scene->mesh,
      laid.products.get<FramesProduct>("frames")->frames, *laid.products.get<RttProduct>("rtt")->rtt,
      laid.products.get<LayersProduct>("layers").get(), resolved(recipe),
      atlas ? std::span<const std::uint32_t>(atlas->atlas->chartOf) : std::span<const std::uint32_t>{},
      session.job());
  json["inside"] = q.inside, json["across"] = q.across;
  session.say(fmt::format("distance inside charts {:.4f}, across their borders {:.4f}", q.inside, q.across));
  return json;
}

void synthesis(Session& session, const Options& options) {
  if (!options.view.output.empty()) checkPictureOutput(options.view.output);
  if (!options.map.empty()) checkPictureOutput(options.map);
  const auto project = ProjectFile::open(options.view.project);
  const fs::path file = options.view.project,
                 folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Pipeline pipeline(project.get(), {folder});
  const Recipe& recipe = project->recipe();
  const Laid laid = laidPatch(pipeline, recipe, options.view.project, session.job());
  nlohmann::json result = describe(session, options, recipe, laid);
  if (!options.map.empty()) {
    if (!laid.idmap || !laid.idmap->map)
      throw ValueError("holds no id map", options.view.project, "run prt bake --stage idmap");
    writeImage(options.map, idMapPicture(*laid.idmap->map), {.alreadySrgb = true});
    session.say("wrote " + options.map);
    result["map"] = options.map;
  }
  if (!options.view.output.empty()) {
    drawSurface(session, options, pipeline, recipe, folder, laid);
    result["output"] = options.view.output;
  }
  session.result(result);
}

}  // namespace

void addSynthesis(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("synthesis", "Look at the patch laid over the surface of a project");
  options->view.addTo(*command);
  command->get_option("--output")
      ->required(false)
      ->description(
          "Picture of the patch on the surface to write: .exr, .hdr or .png; shadowed where the project "
          "holds "
          "matrices");
  command->add_flag("--ids", options->ids, "Show patch coordinates instead: u in red, v in green");
  command->add_option("--map", options->map, "Picture of the id map to write: u in red, v in green");
  command->add_flag("--quality", options->quality,
                    "Compare neighbours across borders of charts with those inside");
  command->footer("Example:\n  prt synthesis cloth.prt --map ids.png -o cloth.png --quality");
  command->callback([options, &action] { action = [options](Session& s) { synthesis(s, *options); }; });
}

}  // namespace prt::cli
