// Figures 1 and 3 of Bi-Scale Radiance Transfer: what macro transport does for a model with meso structure.

#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Transport {
  const char* file;
  const char* text;
  bool shadows;
  int bounces;
  bool patch = true;
};

nlohmann::json makeTransports(const char* name, const char* title, Recipe recipe,
                              std::initializer_list<Transport> transports, const FigureRequest& request,
                              Job& job) {
  const Stopwatch watch;
  FigureModel model;
  FigurePage page;
  page.title = title;
  page.rows.resize(1);
  for (const Transport& t : transports) {
    recipe.transfer.shadows = t.shadows, recipe.transfer.bounces = t.bounces;
    recipe.method.name = t.patch ? "biscale" : "auto";
    model.bake(recipe, job);
    writeFigurePicture(request.folder / t.file, model.picture(recipe, figureLamp(), job));
    page.rows[0].push_back({t.file, t.text, {}});
  }
  const double seconds = watch.seconds();
  page.intro = fmt::format("A circle light before a dim sky; everything made in {:.0f} s.", seconds);
  return {{"figure", name},
          {"page", writePage(request.folder, page)},
          {"seconds", seconds},
          {"pictures", picturesOf(page)}};
}

}  // namespace

nlohmann::json makeBiscale1(const FigureRequest& request, Job& job) {
  Recipe recipe = figureRecipe(request, "builtin:bird");
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.heightmap = "builtin:bins";
  recipe.patch.albedo = recipe.objects[0].material.albedo = Rgb(0.75f, 0.6f, 0.42f);
  return makeTransports("biscale-1", "A model without and with either scale", recipe,
                        {{"meso.png", "meso scale alone: it glows", false, 0},
                         {"macro.png", "macro scale alone", true, 2, false},
                         {"both.png", "both scales", true, 2}},
                        request, job);
}

nlohmann::json makeBiscale3(const FigureRequest& request, Job& job) {
  Recipe recipe = figureRecipe(request, "builtin:rock");
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.albedo = recipe.objects[0].material.albedo = Rgb(0.8f, 0.74f, 0.66f);
  return makeTransports("biscale-3", "Three kinds of macro transport", recipe,
                        {{"none.png", "none", false, 0},
                         {"shadows.png", "shadows", true, 0},
                         {"bounces.png", "shadows and three bounces", true, 3}},
                        request, job);
}

}  // namespace prt
