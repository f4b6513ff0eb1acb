#include "libprt/project/laid_patch.h"

#include "libprt/project/atlas_stages.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/products.h"
#include "libprt/project/synthesis_stages.h"

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

}  // namespace

std::vector<std::string> stagesOfLaidPatch(const Recipe& recipe) {
  if (recipe.patch.model == PatchModel::None) return {};
  if (recipe.synthesis.mapping == PatchMapping::Uv) return {"scene", "frames", "rtt"};
  return {"scene", "frames", "rtt", "atlas", "idmap"};
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
  const auto cover = coverOf(products, recipe, scene->scene);
  if (!cover) return nullptr;
  auto surface = std::make_shared<BiscaleSurface>(
      scene->scene, std::shared_ptr<const TangentFrames>(frames, &frames->frames), cover,
      std::make_shared<ResponseTable>(*rtt->rtt));
  if (recipe.method.filter) surface->filter = std::make_shared<PatchFilter>(cover, *rtt->rtt, job);
  return surface;
}

bool showsPatch(const Recipe& recipe) {
  return recipe.patch.model != PatchModel::None && recipe.method.name == "biscale";
}

}  // namespace prt
