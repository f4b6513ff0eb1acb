// Figures 2 and 6 of Bi-Scale Radiance Transfer on the built-in bird: the id map and what each part of the
// method adds.

#include "libprt/core/file.h"
#include "libprt/core/image_io.h"
#include "libprt/project/export_synthesis.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/project/relight.h"
#include "libprt/project/synthesis_stages.h"
#include "libprt/shade/patch_look.h"
#include "libprt/shade/tonemap.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <nlohmann/json.hpp>

#include <chrono>

namespace prt {
namespace {

constexpr int kWidth = 960, kHeight = 720;

struct Look {
  const char* file;
  const char* text;
  bool shadows;
  int bounces;
  bool viewDependent;
};
constexpr Look kLooks[] = {
    {"plain.png", "meso scale alone: light arrives everywhere alike", false, 0, true},
    {"shadows.png", "with the macro scale's shadows", true, 0, true},
    {"full.png", "with its shadows and light between parts", true, 2, true},
    {"from_above.png", "the same, the patch as seen from above from everywhere", true, 2, false}};

Recipe wovenBird() {
  Recipe recipe;
  recipe.objects[0].mesh.path = "builtin:bird";
  recipe.objects[0].material.albedo = Rgb(0.6f);
  recipe.patch.model = PatchModel::Weave;
  recipe.patch.albedo = Rgb(0.62f, 0.44f, 0.26f);
  recipe.patch.warp = Rgb(0.75f, 0.8f, 0.9f);
  recipe.synthesis.scale = 0.06f;
  recipe.method.name = "biscale";
  recipe.transfer.rays = 1024;
  return recipe;
}

Camera cameraOf(const Box3& bounds) {
  Camera camera = frameBox(bounds);
  camera.eye = camera.target + 0.72f * (camera.eye - camera.target);
  return camera;
}

void write(const std::filesystem::path& file, const Image& linear) {
  ImageWriteOptions encoded;
  encoded.alreadySrgb = true;
  writeImage(file, toDisplay(linear, {0, ToneCurve::Linear}), encoded);
}

/// A circle light from the upper left before a dim sky: one that casts shadows.
LightRig lamp() {
  LightRig rig;
  CircleLight circle;
  circle.direction = normalize(Vec3(-0.75f, 0.6f, 0.35f));
  circle.halfAngle = float(radians(20.0));
  circle.radiance = Rgb(7);
  rig.circles = {circle};
  rig.constant = Rgb(0.18f, 0.2f, 0.24f);
  return rig;
}

}  // namespace

nlohmann::json makeBiscale6(const std::filesystem::path& folder, Job& job) {
  const auto begun = std::chrono::steady_clock::now();
  Recipe recipe = wovenBird();
  Pipeline pipeline(nullptr, {});
  nlohmann::json pictures = nlohmann::json::array();
  std::vector<std::vector<FigurePicture>> rows(2);
  const auto keep = [&](std::size_t row, const std::string& file, const std::string& text) {
    pictures.push_back({{"file", file}, {"shows", text}});
    rows[row].push_back({file, text});
  };
  Products products;
  for (const Look& look : kLooks) {
    recipe.transfer.shadows = look.shadows, recipe.transfer.bounces = look.bounces;
    recipe.method.viewDependent = look.viewDependent;
    std::vector<std::string> stages = stagesOfLaidPatch(recipe);
    stages.insert(stages.end(), {"samples", "transfer"});
    products = pipeline.run(recipe, stages, job);
    BakedScene baked = bakedScene(products);
    baked.patch = laidPatch(products, recipe);
    const Camera camera = cameraOf(baked.geometry->scene->mesh.bounds());
    write(folder / look.file, relight(baked, recipe, lamp(), camera, {kWidth, kHeight, 2}, job));
    keep(0, look.file, look.text);
  }
  const auto patch = laidPatch(products, recipe);
  const TriMesh& mesh = patch->scene->mesh;
  ImageWriteOptions encoded;
  encoded.alreadySrgb = true;
  writeImage(folder / "id_map.png", idMapPicture(*products.get<IdMapProduct>("idmap")->map), encoded);
  keep(1, "id_map.png", "id map: places in the patch, u in red, v in green");
  write(folder / "ids.png",
        patchColours(mesh, *patch->cover, cameraOf(mesh.bounds()), kWidth, kHeight, 2, job));
  keep(1, "ids.png", "the same on the surface");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  char intro[200];
  std::snprintf(intro, sizeof intro,
                "A woven bird under a circle light; everything made in %.0f s (the paper: about 8 hours).",
                seconds);
  writeFile(folder / "index.html", figurePage("What each scale adds", intro, rows));
  return {{"figure", "biscale-6"},
          {"page", (folder / "index.html").string()},
          {"seconds", seconds},
          {"seconds_of_the_paper", 8 * 3600},
          {"pictures", pictures}};
}

}  // namespace prt
