// Figure 5 of Bi-Scale Radiance Transfer: radiance transfer textures on a model.

#include "libprt/meso/patch_generate.h"
#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Material5 {
  std::string name;
  PatchOptions patch;
};

/// Every built-in height field, the weave, and the flower, which is flat.
std::vector<Material5> materials() {
  static const Rgb kAlbedo[] = {{0.75f, 0.6f, 0.42f},
                                {0.6f, 0.62f, 0.66f},
                                {0.66f, 0.7f, 0.5f},
                                {0.45f, 0.6f, 0.6f},
                                {0.78f, 0.74f, 0.68f}};
  std::vector<Material5> all;
  for (const std::string& name : heightGeneratorNames()) {
    PatchOptions patch;
    patch.model = PatchModel::HeightField;
    patch.heightmap = "builtin:" + name;
    patch.albedo = kAlbedo[all.size() % std::size(kAlbedo)];
    all.push_back({name, patch});
  }
  PatchOptions weave;
  weave.model = PatchModel::Weave;
  weave.albedo = Rgb(0.62f, 0.44f, 0.26f), weave.warp = Rgb(0.75f, 0.8f, 0.9f);
  all.push_back({"weave", weave});
  PatchOptions flower;
  flower.model = PatchModel::Flat;
  flower.texture = "builtin:flower", flower.albedo = Rgb(1);
  all.push_back({"flower", flower});
  return all;
}

}  // namespace

nlohmann::json makeBiscale5(const FigureRequest& request, Job& job) {
  const Stopwatch watch;
  FigureModel model;
  FigurePage page;
  page.title = "Radiance transfer textures on a model";
  for (const Material5& material : materials()) {
    Recipe recipe = figureRecipe(request, "builtin:vase");
    recipe.patch = material.patch;
    recipe.transfer.bounces = 2;
    recipe.synthesis.scale = 0.08f;
    model.bake(recipe, job);
    const std::string file = material.name + ".png";
    writeFigurePicture(request.folder / file, model.picture(recipe, figureLamp(), job));
    if (page.rows.empty() || page.rows.back().size() == 4) page.rows.emplace_back();
    page.rows.back().push_back({file, material.name, {}});
  }
  const double seconds = watch.seconds();
  page.intro =
      fmt::format("Baked, synthesised over the surface and lit by the same light, in {:.0f} s.", seconds);
  return {{"figure", "biscale-5"},
          {"page", writePage(request.folder, page)},
          {"seconds", seconds},
          {"pictures", picturesOf(page)}};
}

}  // namespace prt
