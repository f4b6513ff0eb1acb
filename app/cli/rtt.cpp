// prt rtt: looks at the radiance transfer texture of a project.

#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/meso/btf_render.h"
#include "libprt/meso/rtt_compress.h"
#include "libprt/meso/rtt_storage.h"
#include "libprt/project/lights.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/project_file.h"
#include "libprt/shade/patch_square.h"

#include <fmt/format.h>

#include <charconv>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string project, output, view = "0,90", btf;
  std::vector<std::string> lights;
  int zoom = 4;
  double exposure = 0;
  bool errors = false, exact = false;
};

/// "x,y,z" towards the viewer in the patch's frame, or "azimuth,elevation" in degrees.
Vec3 parseView(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (error != std::errc() || rest != text.data() + end || !std::isfinite(value)) break;
    numbers.push_back(value);
    begin = end + 1;
  }
  Vec3 d(0);
  if (numbers.size() == 2) {
    const double a = radians(numbers[0]), e = radians(numbers[1]);
    d = Vec3(DVec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
  } else if (numbers.size() == 3) {
    d = Vec3(DVec3(numbers[0], numbers[1], numbers[2]));
  }
  if (!(d.z > 0) || !(length(d) > 1e-6f))
    throw UsageError("'" + text + "' is no view from above the patch", "--view",
                     "write azimuth,elevation in degrees or x,y,z with z above 0");
  return normalize(d);
}

void preview(Session& session, const Options& options, const Rtt& rtt, const Recipe& recipe,
             const fs::path& folder) {
  std::vector<LightRecipe> lights = recipe.lights;
  if (!options.lights.empty()) lights.clear();
  for (const std::string& text : options.lights) lights.push_back(parseLight(text));
  EnvironmentCache environments;
  const ShRgb light =
      lightOnGround(lightFor(makeLightRig(lights, folder, environments), rtt.bands, recipe.method));
  writePicture(options.output, previewImage(rtt, parseView(options.view), light, options.zoom),
               options.exposure);
  session.say("wrote " + options.output);
}

/// What fewer terms and smaller numbers cost.
nlohmann::json compression(Session& session, const Rtt& rtt) {
  const RttFactors factors = compressRtt(rtt, 64, session.job());
  nlohmann::json curve = nlohmann::json::array(), storage;
  session.say(fmt::format("table: {:.1f} MB of floats", double(rtt.values.size()) * 4e-6));
  for (const int terms : {1, 2, 4, 8, 16, 24, 32, 48, 64}) {
    if (terms > factors.terms) break;
    const double megabytes = double(factors.bytes()) * terms / factors.terms * 1e-6;
    session.say(fmt::format("  {:3} terms {:8.2f} MB  error {:.3f} %", terms, megabytes,
                            100 * factors.errors[std::size_t(terms)]));
    curve.push_back(
        {{"terms", terms}, {"error", factors.errors[std::size_t(terms)]}, {"megabytes", megabytes}});
  }
  for (const DType type : {DType::f16, DType::u8}) {
    const StoredRtt stored = storeRtt(rtt, type);
    session.say(fmt::format("  as {}      {:8.2f} MB  error {:.4f} %", toString(type),
                            double(stored.values.bytes.size()) * 1e-6, 100 * stored.error));
    storage[toString(type)] = stored.error;
  }
  return {{"terms", curve}, {"storage", storage}};
}

/// The patch that the project holds.
std::shared_ptr<const Patch> patchOf(Pipeline& pipeline, const Recipe& recipe, const std::string& project) {
  const auto product = pipeline.find(recipe, {"patch"}).get<PatchProduct>("patch");
  if (!product || !product->patch)
    throw ValueError("has no patch to render", project, "only generated patches and meshes have a surface");
  return product->patch;
}

/// A table of one view: the patch itself from there, traced.
Rtt exactly(Session& session, const Options& options, const std::shared_ptr<const Patch>& patch,
            const Recipe& recipe) {
  const RttSettings settings = rttSettings(resolved(recipe));
  const PatchScene scene = makePatchScene(patch, session.job());
  const Vec3 view = parseView(options.view);
  return picturesOfPatch(scene, bakePatchLight(scene, settings, session.job()), settings, {&view, 1}, 1,
                         session.job());
}

/// The 8192 pictures of equation (5).
std::size_t writeBtf(Session& session, const Options& options, const std::shared_ptr<const Patch>& patch,
                     const Recipe& recipe) {
  const LightSet lights = lightGrid();
  BtfWriter writer(options.btf, lights);
  RttSettings settings = rttSettings(resolved(recipe));
  renderBtf(makePatchScene(patch, session.job()), settings, lights, session.job(),
            [&](const BtfView& view) { writer.add(view, session.job()); });
  const std::size_t count = writer.finish();
  session.say(fmt::format("wrote {} images and a manifest.json to {}", count, options.btf));
  return count;
}

void rtt(Session& session, const Options& options) {
  if (options.output.empty() && options.btf.empty() && !options.errors)
    throw UsageError("nothing to do is named", "", "add -o PICTURE, --errors or --btf DIR");
  if (!options.output.empty()) checkPictureOutput(options.output);
  const auto project = ProjectFile::open(options.project);
  const fs::path file = options.project, folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Pipeline pipeline(project.get(), {folder});
  const Recipe& recipe = project->recipe();
  const auto baked = bakedRtt(pipeline, recipe, options.project);
  nlohmann::json result{{"texels", baked->rtt->texels}, {"views", baked->rtt->views}};
  if (!options.output.empty()) {
    if (options.exact)
      preview(session, options, exactly(session, options, patchOf(pipeline, recipe, options.project), recipe),
              recipe, folder);
    else
      preview(session, options, *baked->rtt, recipe, folder);
    result["picture"] = options.output;
  }
  if (options.errors) result["errors"] = compression(session, *baked->rtt);
  if (!options.btf.empty())
    result["images"] = writeBtf(session, options, patchOf(pipeline, recipe, options.project), recipe);
  session.result(result);
}

}  // namespace

void addRtt(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("rtt", "Look at the radiance transfer texture of a project");
  command->add_option("PROJECT", options->project, "Baked project (.prt) with a patch")->required();
  command->add_option("-o,--output", options->output, "Picture of the patch to write: .exr, .hdr or .png");
  command
      ->add_option(
          "--view", options->view,
          "Towards the viewer: azimuth,elevation in degrees or x,y,z in the patch's frame (z outwards)")
      ->capture_default_str();
  command
      ->add_option("--light", options->lights,
                   "Light instead of the project's, in the world in which the patch lies on the ground: "
                   "circle:DIR:DEG:RGB, directional:DIR:RGB or constant:RGB; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--zoom", options->zoom, "Pixels a texel")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--exposure", options->exposure, "Stops, for PNG only")
      ->check(finite())
      ->check(CLI::Range(-30.0, 30.0))
      ->capture_default_str();
  command->add_flag(
      "--exact", options->exact,
      "Trace the patch itself from the view instead of interpolating between the table's views");
  command->add_flag("--errors", options->errors, "Errors of fewer terms (SVD) and of smaller number formats");
  command->add_option(
      "--btf", options->btf,
      "Folder for the images of equation (5): every view under each of 8 x 16 directional lights");
  command->footer("Example:\n  prt rtt cloth.prt --view 30,40 --light circle:1,1,0:40:3 -o cloth.png");
  command->callback([options, &action] { action = [options](Session& s) { rtt(s, *options); }; });
}

}  // namespace prt::cli
