// prt demo: bakes and relights the built-in scenes, and leaves pictures and a page to look at.

#include "app/cli/demo_page.h"
#include "app/cli/progress_bar.h"
#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/file.h"
#include "libprt/project/bake.h"
#include "libprt/project/lights.h"
#include "libprt/project/project_file.h"
#include "libprt/project/relight.h"

#include <fmt/format.h>

#include <chrono>
#include <map>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string folder;
  std::vector<std::string> scenes;
  std::vector<std::string> assignments;
  std::string size = "560x420";
  int frames = 12;
};

const std::map<std::string, std::string> kCaptions{
    {"vase",
     "A glazed vase under a clear sky with sun: visibility and colour-bleeding matrices, a Phong lobe "
     "towards the viewer."},
    {"bird", "A clay bird on moss under an overcast sky: diffuse vectors with three bounces."},
    {"rock", "A rock between three softboxes: its hollows light themselves."},
};

double secondsSince(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// Pictures of the light turning once around; returns the mean time of one.
double makeFrames(Session& session, const Options& options, DemoScene& scene, const fs::path& project) {
  const auto file = ProjectFile::open(project);
  const Recipe& recipe = file->recipe();
  Pipeline pipeline(file.get(), {options.folder});
  const BakedScene baked = bakedScene(pipeline, recipe, project.string());
  EnvironmentCache environments;
  PictureOptions picture;
  parseSize(options.size, picture.width, picture.height);
  const Camera camera = recipe.cameras.at(0).camera();
  double seconds = 0;
  for (int i = 0; i < options.frames; ++i) {
    session.job().checkCancelled();
    std::vector<LightRecipe> lights = recipe.lights;
    for (LightRecipe& light : lights) light.rotation += 360.0f * float(i) / float(options.frames);
    const LightRig rig = makeLightRig(lights, options.folder, environments);
    const auto begun = Clock::now();
    const Image image = relight(baked, recipe, rig, camera, picture, session.job());
    seconds += secondsSince(begun);
    scene.frames.push_back(fs::path(options.folder) /
                           fmt::format("{}_{:03}.png", scene.name, 360 * i / options.frames));
    writePicture(scene.frames.back().string(), image, 0);
  }
  return seconds / options.frames;
}

DemoScene makeScene(Session& session, const Options& options, const std::string& name,
                    nlohmann::json& report) {
  const fs::path project = fs::path(options.folder) / (name + ".prt");
  RecipeSource source{builtinScene(name), ".", {}};
  for (const std::string& assignment : options.assignments) setByAssignment(source.recipe, assignment);
  if (session.seed) source.recipe.transfer.seed = *session.seed;
  const auto begun = Clock::now();
  const BakeSummary summary = bakeProject(source, {project, {}}, session.job());
  const double baked = secondsSince(begun);
  DemoScene scene{name, kCaptions.contains(name) ? kCaptions.at(name) : "", {}, {}};
  const double perFrame = makeFrames(session, options, scene, project);
  std::size_t vertices = 0;
  for (const BakeSummary::Object& object : summary.objects) vertices += object.vertices;
  scene.facts = {{"vertices", std::to_string(vertices)},
                 {"transfer", summary.transfer->form},
                 {"interpolation floor", fmt::format("{:.2f} %", 100 * summary.floor->interpolation)},
                 {"bake", fmt::format("{:.1f} s", baked)},
                 {"project", byteCount(double(summary.bytes))},
                 {"picture", fmt::format("{:.0f} ms", 1000 * perFrame)}};
  session.say(fmt::format("{}: {} vertices, baked in {:.1f} s, {:.0f} ms per picture", name, vertices, baked,
                          1000 * perFrame));
  nlohmann::json entry = toJson(summary);
  entry["bake_seconds"] = baked;
  entry["picture_seconds"] = perFrame;
  report[name] = entry;
  return scene;
}

void demo(Session& session, const Options& options) {
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (!fs::is_directory(options.folder, error))
    throw FileError("is not a folder and cannot be made one", options.folder, "choose another name");
  int width = 0, height = 0;
  parseSize(options.size, width, height);
  std::vector<DemoScene> scenes;
  nlohmann::json report;
  for (const std::string& name : options.scenes) scenes.push_back(makeScene(session, options, name, report));
  const fs::path page = fs::path(options.folder) / "index.html";
  writeFile(page, demoPage(scenes));
  writeFile(fs::path(options.folder) / "report.json", report.dump(2) + "\n");
  session.say("open " + page.string());
  session.result({{"page", page.string()}, {"scenes", report}});
}

}  // namespace

void addDemo(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("demo", "Bake and relight the built-in scenes; writes pictures and a page");
  options->scenes = {"vase", "bird", "rock"};
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--scene", options->scenes, "Built-in scene; may be repeated")
      ->check(CLI::IsMember(builtinSceneNames()))
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("--set", options->assignments, "PATH=VALUE of a setting in all scenes; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--size", options->size, "Width x height of the pictures")->capture_default_str();
  command->add_option("--frames", options->frames, "Pictures per turn of the light")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  command->footer("Example:\n  prt demo -o demo && xdg-open demo/index.html");
  command->callback([options, &action] { action = [options](Session& s) { demo(s, *options); }; });
}

}  // namespace prt::cli
