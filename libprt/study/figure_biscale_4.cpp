// Figure 4 of Bi-Scale Radiance Transfer: the weave's RTT on a square, two views times five lights.

#include "libprt/light/light_rig.h"
#include "libprt/meso/patch_build.h"
#include "libprt/meso/rtt_bake.h"
#include "libprt/shade/patch_square.h"
#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace prt {
namespace {

struct Lighting {
  const char* name;
  const char* text;
  Vec3 direction;   // towards it
  double diameter;  // degrees
};

constexpr std::array<Lighting, 5> kLights{
    {{"left", "circle of 40 degrees, low from the left", {-0.87f, 0.5f, 0}, 40},
     {"front", "circle of 40 degrees, low from the front", {0, 0.5f, 0.87f}, 40},
     {"right", "circle of 40 degrees, low from the right", {0.87f, 0.5f, 0}, 40},
     {"above", "circle of 40 degrees, overhead", {0, 1, 0}, 40},
     {"wide", "circle of 110 degrees from the back left", {-0.5f, 0.7f, -0.5f}, 110}}};

struct Viewpoint {
  const char* name;
  const char* text;
  Vec3 eye;
};
constexpr std::array<Viewpoint, 2> kViews{
    {{"steep", "from above", {0.25f, 2.1f, 0.75f}},
     {"flat", "from the side, 20 degrees over the cloth", {0.45f, 0.8f, 1.95f}}}};

/// Every light sends the same irradiance on the ground, so that the pictures compare.
ShRgb lightOf(const Lighting& lighting) {
  LightRig rig;
  CircleLight circle;
  circle.direction = normalize(lighting.direction);
  circle.halfAngle = float(radians(lighting.diameter / 2));
  // Irradiance of a disc of half-angle a whose whole lies above the horizon: pi sin^2 a times the height of
  // its centre.
  const double sine = std::sin(double(circle.halfAngle));
  circle.radiance = Rgb(float(1 / (sine * sine * double(circle.direction.y))));
  rig.circles = {circle};
  return projectLights(rig, 5);
}

FigurePage pageOf(double seconds, const Rtt& rtt) {
  char text[256];
  std::snprintf(
      text, sizeof text,
      "Two views, five lights of equal irradiance: shadows between the yarns follow the light, the look "
      "changes with the view. Baked in %.1f s: %d x %d texels, %d x %d views, %d functions, %d bounces.",
      seconds, rtt.texels, rtt.texels, rtt.views, rtt.views, rtt.functions(), rtt.bounces);
  std::vector<std::vector<FigurePicture>> rows;
  for (const Viewpoint& view : kViews) {
    rows.emplace_back();
    for (const Lighting& light : kLights)
      rows.back().push_back({std::string(view.name) + "_" + light.name + ".png",
                             std::string(light.text) + ", " + view.text,
                             {}});
  }
  return {"The weave's radiance transfer texture on a square", text, rows, {}};
}

}  // namespace

nlohmann::json makeBiscale4(const FigureRequest& request, Job& job) {
  PatchOptions options;
  options.model = PatchModel::Weave;
  options.albedo = Rgb(0.62f, 0.44f, 0.26f);
  options.warp = Rgb(0.75f, 0.8f, 0.9f);
  const Stopwatch watch;
  const PatchScene patch = makePatchScene(std::make_shared<Patch>(buildPatch(options, {}, job)), job);
  const Rtt rtt = bakeRtt(patch, {}, job);
  const double seconds = watch.seconds();
  nlohmann::json pictures = nlohmann::json::array();
  SquareOptions square;
  square.repeats = 2;
  job.begin("pictures", double(kViews.size() * kLights.size()), "pictures");
  for (const Viewpoint& view : kViews)
    for (const Lighting& light : kLights) {
      Camera camera;
      camera.eye = 1.25f * view.eye;
      Image image = renderPatchSquare(rtt, lightOf(light), camera, square, job);
      const std::string name = std::string(view.name) + "_" + light.name + ".png";
      writeFigurePicture(request.folder / name, image);
      pictures.push_back({{"file", name}, {"view", view.text}, {"light", light.text}});
      job.advance(1);
    }
  return {{"figure", "biscale-4"},
          {"page", writePage(request.folder, pageOf(seconds, rtt))},
          {"bake_seconds", seconds},
          {"images_of_the_paper", 8192},
          {"pictures", pictures}};
}

}  // namespace prt
