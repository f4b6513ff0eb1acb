// prt synthesis: looks at how the patch was laid over the surface.

#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/image_io.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/export_synthesis.h"
#include "libprt/project/lights.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/project/project_file.h"
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
  std::shared_ptr<const AtlasProduct> atlas;
  std::shared_ptr<const RttProduct> rtt;
  std::shared_ptr<const SceneProduct> scene;
  std::shared_ptr<const FramesProduct> frames;
};

Laid laidPatch(Pipeline& pipeline, const Recipe& recipe, const std::string& project, Job& job) {
  const Products found = pipeline.find(recipe, {"synthesis", "idmap", "atlas", "rtt"});
  Laid laid{found.get<SynthesisProduct>("synthesis"),
            found.get<IdMapProduct>("idmap"),
            found.get<AtlasProduct>("atlas"),
            found.get<RttProduct>("rtt"),
            nullptr,
            nullptr};
  if (!laid.synthesis || !laid.synthesis->meso)
    throw ValueError("holds no patch laid over the surface", project,
                     resolved(recipe).synthesis.mapping == PatchMapping::Uv
                         ? "synthesis.mapping=uv needs none"
                         : "set patch.model and run prt bake --stage idmap");
  const Products made = pipeline.run(recipe, {"scene", "frames"}, job);
  laid.scene = made.get<SceneProduct>("scene"), laid.frames = made.get<FramesProduct>("frames");
  return laid;
}

/// The transferred light at the vertices, where the project holds it in enough bands; else empty.
std::vector<Rgb> incidentLight(Pipeline& pipeline, const Recipe& recipe, const LightRig& lights, int bands) {
  const auto transfer = pipeline.find(recipe, {"transfer"}).get<TransferProduct>("transfer");
  if (!transfer || transfer->transfer.bands != bands ||
      (transfer->transfer.form != TransferForm::Matrix &&
       transfer->transfer.form != TransferForm::Visibility))
    return {};
  return transferredRadiance(transfer->transfer, lightFor(lights, bands, recipe.method));
}

void drawSurface(Session& session, const Options& options, Pipeline& pipeline, const Recipe& recipe,
                 const fs::path& folder, const Laid& laid) {
  if (!laid.idmap || !laid.idmap->map || !laid.atlas)
    throw ValueError("holds no id map", options.view.project, "run prt bake --stage idmap");
  const TriMesh& mesh = laid.scene->scene->mesh;
  const View view = viewOf(options.view, recipe, folder, mesh.bounds());
  PatchLook look{mesh, laid.frames->frames, *laid.atlas->atlas, *laid.idmap->map};
  std::vector<Rgb> incident;
  if (!options.ids) {
    look.rtt = laid.rtt->rtt.get();
    look.light = lightFor(view.lights, look.rtt->bands, recipe.method);
    incident = incidentLight(pipeline, recipe, view.lights, look.rtt->bands);
    incident.resize(std::min(incident.size(), mesh.vertexCount() * std::size_t(look.rtt->functions())));
    look.incident = incident;
  }
  writePicture(options.view.output, patchLook(look, view.camera, view.width, view.height, 2, session.job()),
               options.view.exposure);
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
  const SynthesisQuality q = qualityOf(s, laid.scene->scene->mesh, laid.frames->frames, *laid.rtt->rtt,
                                       symmetryOf(resolved(recipe).field),
                                       laid.atlas ? std::span<const std::uint32_t>(laid.atlas->atlas->chartOf)
                                                  : std::span<const std::uint32_t>{},
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
