// Figures 2 and 6 of Bi-Scale Radiance Transfer: the id map and what each part of the method adds.

#include "libprt/project/export_synthesis.h"
#include "libprt/project/products.h"
#include "libprt/project/synthesis_stages.h"
#include "libprt/shade/patch_look.h"
#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

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

}  // namespace

nlohmann::json makeBiscale6(const FigureRequest& request, Job& job) {
  const Stopwatch watch;
  Recipe recipe = figureRecipe(request, "builtin:bird");
  recipe.patch.model = PatchModel::Weave;
  recipe.patch.albedo = Rgb(0.62f, 0.44f, 0.26f);
  recipe.patch.warp = Rgb(0.75f, 0.8f, 0.9f);
  FigureModel model;
  FigurePage page;
  page.title = "What each scale adds";
  page.rows.resize(2);
  for (const Look& look : kLooks) {
    recipe.transfer.shadows = look.shadows, recipe.transfer.bounces = look.bounces;
    recipe.method.viewDependent = look.viewDependent;
    model.bake(recipe, job);
    writeFigurePicture(request.folder / look.file, model.picture(recipe, figureLamp(), job));
    page.rows[0].push_back({look.file, look.text, {}});
  }
  writeEncodedPicture(request.folder / "id_map.png",
                      idMapPicture(*model.products().get<IdMapProduct>("idmap")->map));
  page.rows[1].push_back({"id_map.png", "id map: places in the patch, u in red, v in green", {}});
  writeEncodedPicture(request.folder / "ids.png",
                      patchColours(model.patch()->scene->mesh, *model.patch()->cover, model.camera(),
                                   FigureModel::kWidth, FigureModel::kHeight, 2, job));
  page.rows[1].push_back({"ids.png", "the same on the surface", {}});
  const double seconds = watch.seconds();
  page.intro = fmt::format(
      "A weave on a model under a circle light; everything made in {:.0f} s (the paper: about 8 hours).",
      seconds);
  return {{"figure", "biscale-6"},
          {"page", writePage(request.folder, page)},
          {"seconds", seconds},
          {"seconds_of_the_paper", 8 * 3600},
          {"pictures", picturesOf(page)}};
}

}  // namespace prt
