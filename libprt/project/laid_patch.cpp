#include "libprt/project/laid_patch.h"

#include "libprt/meso/rtt_layers.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/products.h"
#include "libprt/project/synthesis_stages.h"

#include <algorithm>

namespace prt {
namespace {

/// The scene's mesh, kept alive by its scene.
std::shared_ptr<const TriMesh> meshOf(const std::shared_ptr<const Scene>& scene) {
  return {scene, &scene->mesh};
}

std::shared_ptr<const PatchCover> coverOf(const Products& products, const Recipe& recipe,
                                          const std::shared_ptr<const Scene>& scene) {
  if (recipe.synthesis.mapping == PatchMapping::Uv)
    return std::make_shared<PatchCover>(meshOf(scene), squareRepeat(scene->mesh, recipe.synthesis.repeat));
  const auto idmap = products.get<IdMapProduct>("idmap");
  const auto atlas = products.get<AtlasProduct>("atlas");
  if (!idmap || !idmap->map || !atlas || !atlas->atlas) return nullptr;
  return std::make_shared<PatchCover>(atlas->atlas, idmap->map, scene->mesh.triangleCount());
}

/// The patch's table with those of the layers behind it; null where they are not there yet.
std::shared_ptr<const Rtt> tableOf(const Products& products, const std::shared_ptr<const Rtt>& patch,
                                   int layers) {
  if (layers == 1) return patch;
  const auto over = products.get<LayersProduct>("layers");
  if (!over || int(over->tables.size()) + 1 != layers) return nullptr;
  std::vector<std::shared_ptr<const Rtt>> all{patch};
  for (const auto& table : over->tables) all.push_back(table->rtt);
  return std::make_shared<const Rtt>(stackedRtt(all));
}

/// Null when all carry the patch.
std::shared_ptr<const PlainObjects> plainObjects(const Scene& scene, const Recipe& recipe, int bands) {
  std::vector<bool> carries;
  std::vector<Material> materials;
  for (const ObjectRecipe& object : recipe.objects)
    carries.push_back(object.patch), materials.push_back(object.material);
  if (std::find(carries.begin(), carries.end(), false) == carries.end()) return nullptr;
  return std::make_shared<PlainObjects>(scene, carries, materials, bands);
}

}  // namespace

std::vector<std::string> stagesOfLaidPatch(const Recipe& recipe) {
  if (recipe.patch.model == PatchModel::None) return {};
  if (recipe.synthesis.mapping == PatchMapping::Uv) return {"scene", "frames", "rtt"};
  std::vector<std::string> stages{"scene", "frames", "rtt", "atlas", "idmap"};
  if (hasLayers(recipe)) stages.push_back("layers");
  return stages;
}

std::vector<std::string> stagesOfPicture(const Recipe& recipe) {
  std::vector<std::string> stages = stagesOfLaidPatch(recipe);
  stages.insert(stages.end(), {"scene", "samples", "transfer"});
  if (hasCaptured(recipe)) stages.push_back("mesh");
  return stages;
}

std::shared_ptr<const BiscaleSurface> laidPatch(const Products& products, const Recipe& recipe) {
  Job job;
  return laidPatch(products, recipe, job);
}

std::shared_ptr<const BiscaleSurface> laidPatch(const Products& products, const Recipe& recipe, Job& job) {
  if (recipe.patch.model == PatchModel::None) return nullptr;
  const auto scene = products.get<SceneProduct>("scene");
  const auto frames = products.get<FramesProduct>("frames");
  const auto rtt = products.get<RttProduct>("rtt");
  if (!scene || !frames || !rtt || !rtt->rtt) return nullptr;
  if (scene->scene->materials.size() != recipe.objects.size()) return nullptr;
  const auto cover = coverOf(products, recipe, scene->scene);
  const auto table = cover ? tableOf(products, rtt->rtt, cover->layers()) : nullptr;
  if (!table) return nullptr;
  auto surface = std::make_shared<BiscaleSurface>(
      scene->scene, std::shared_ptr<const TangentFrames>(frames, &frames->frames), cover,
      std::make_shared<ResponseTable>(*table));
  surface->matte = isMattePlane(recipe);
  surface->plain = plainObjects(*scene->scene, recipe, table->bands);
  if (recipe.method.filter) surface->filter = std::make_shared<PatchFilter>(cover, *table, job);
  return surface;
}

std::shared_ptr<const BiscaleSurface> withPlainObjects(std::shared_ptr<const BiscaleSurface> surface,
                                                       const Recipe& recipe) {
  if (surface->scene->materials.size() != recipe.objects.size()) return nullptr;
  auto plain = plainObjects(*surface->scene, recipe, surface->responses->bands());
  if (!plain && !surface->plain) return surface;
  auto changed = std::make_shared<BiscaleSurface>(*surface);
  changed->plain = std::move(plain);
  changed->matte = isMattePlane(recipe);
  return changed;
}

std::vector<std::optional<Material>> plainMaterials(const Recipe& recipe) {
  std::vector<std::optional<Material>> out;
  for (const ObjectRecipe& object : recipe.objects)
    out.push_back(object.patch ? std::nullopt : std::optional(object.material));
  return out;
}

bool isMattePlane(const Recipe& recipe) {
  const auto matte = [](const PatchOptions& patch) {
    return patch.model == PatchModel::Flat && luminance(patch.specular) <= 0;
  };
  return matte(recipe.patch) &&
         std::all_of(recipe.layers.begin(), recipe.layers.end(),
                     [&](const LayerRecipe& layer) { return !isPainted(layer) || matte(layer.patch); }) &&
         std::none_of(recipe.objects.begin(), recipe.objects.end(), [](const ObjectRecipe& o) {
           return o.visible && !o.captured && !o.patch && o.material.glossy();
         });
}

bool showsPatch(const Recipe& recipe) {
  return recipe.patch.model != PatchModel::None && recipe.method.name == "biscale";
}

}  // namespace prt
