// How true pictures with both scales are: against the displaced surface, path traced under the same light.

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/project/products.h"
#include "libprt/study/biscale_truth.h"
#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

TruthCase stuccoCase(const FigureRequest& request, Job& job) {
  TruthCase of;
  of.recipe = figureRecipe(request, "builtin:rock");
  of.recipe.patch.model = PatchModel::HeightField;
  of.recipe.patch.depth = 0.1f;
  of.recipe.patch.albedo = of.recipe.objects[0].material.albedo = Rgb(0.5f);
  of.recipe.transfer.bounces = 2;
  of.recipe.synthesis.scale = 0.05f;
  of.light = nonNegativeLight(projectLights(figureLamp(), 5));
  of.width = 640, of.height = 480;
  of.grid = 4, of.paths = 64;
  Pipeline pipeline(nullptr, {});
  const auto scene = pipeline.run(of.recipe, {"scene"}, job).get<SceneProduct>("scene")->scene;
  of.camera = figureCamera(scene->mesh, of.width, of.height);
  // Triangles about as large as a texel of the patch.
  constexpr double kTriangles = 1.5e6;
  of.cuts = std::clamp(int(std::sqrt(kTriangles / double(scene->mesh.triangleCount()))), 1, 64);
  return of;
}

}  // namespace

nlohmann::json makeBiscaleTruth(const FigureRequest& request, Job& job) {
  const BiscaleTruth truth(stuccoCase(request, job), job);
  FigurePage page;
  page.title = "Both scales against the truth";
  page.intro = fmt::format(
      "Stucco on a model: as {} triangles, path traced, and as pictures of the macro mesh. Relative errors "
      "of what "
      "both cover, freed of the path tracer's noise; the light is the one that transfer sees.",
      truth.triangles());
  writeFigurePicture(request.folder / "truth.png", truth.reference());
  page.rows = {{{"truth.png", "the displaced surface, path traced", {}}}, {}};
  nlohmann::json errors;
  for (const TruthPicture& p : truth.pictures()) {
    std::string file = p.name.substr(0, p.name.find(' ')) + ".png";
    writeFigurePicture(request.folder / file, p.picture);
    page.rows[p.macro && p.meso ? 0 : 1].push_back(
        {file, fmt::format("{}: {:.1f} %", p.name, 100 * p.error.relative()), {}});
    errors[p.name] = {
        {"relative", p.error.relative()}, {"low", p.error.relativeLow()}, {"high", p.error.relativeHigh()}};
  }
  return {{"figure", "biscale-truth"},
          {"page", writePage(request.folder, page)},
          {"errors", errors},
          {"pictures", picturesOf(page)}};
}

}  // namespace prt
