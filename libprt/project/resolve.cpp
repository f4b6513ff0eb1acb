// What a recipe comes to: `auto` decided, values without effect at their defaults.

#include "libprt/project/laid_patch.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/pipeline.h"

#include <algorithm>

namespace prt {
namespace {

bool anyGlossy(const Recipe& recipe) {
  return std::any_of(recipe.objects.begin(), recipe.objects.end(),
                     [](const ObjectRecipe& o) { return o.visible && !o.captured && o.material.glossy(); });
}

/// The cheapest form that holds what materials, patch and bounces need.
TransferKind cheapestKind(const Recipe& recipe) {
  if (!anyGlossy(recipe) && (!showsPatch(recipe) || isMattePlane(recipe))) return TransferKind::Diffuse;
  return recipe.transfer.bounces == 0 ? TransferKind::Visibility : TransferKind::Matrix;
}

void resolveTransfer(const Recipe& recipe, TransferRecipe& transfer) {
  if (transfer.kind == TransferKind::Auto) transfer.kind = cheapestKind(recipe);
  if (!transfer.shadows || transfer.kind == TransferKind::None) {
    const int bands = transfer.bands;
    transfer = {};
    transfer.kind = TransferKind::None;
    transfer.shadows = false;
    transfer.bounces = 0;
    transfer.bands = bands;
  }
  if (showsPatch(recipe)) transfer.where = TransferWhere::Vertex;  // the patch is lit at vertices
  if (transfer.where == TransferWhere::Vertex) transfer.texels = TransferRecipe{}.texels;
  if (transfer.kind == TransferKind::Visibility) transfer.bounces = 0;
  if (transfer.kind != TransferKind::Matrix) transfer.compress = 0;
  if (transfer.bounces == 0) transfer.threshold = TransferRecipe{}.threshold;
  if (transfer.storage == TransferStorage::Auto)
    transfer.storage = transfer.kind == TransferKind::Matrix ? TransferStorage::Half : TransferStorage::Float;
}

void resolveMesh(MeshRecipe& mesh) {
  if (!isBuiltin(mesh.path)) {
    mesh.detail = MeshRecipe{}.detail;
    mesh.seed = MeshRecipe{}.seed;
    return;
  }
  const MeshRecipe given = mesh;
  mesh = {};
  mesh.path = given.path;
  mesh.detail = given.detail;
  if (mesh.path == "builtin:rock") mesh.seed = given.seed;
}

/// What of a patch its kind reads.
PatchOptions readOf(const PatchOptions& given) {
  PatchOptions patch;
  patch.model = given.model;
  if (given.model == PatchModel::None) return patch;
  if (given.model == PatchModel::Btf) {
    patch.btf = given.btf, patch.seamless = given.seamless;
    return patch;
  }
  patch.texture = given.texture, patch.gloss = given.gloss;
  patch.albedo = given.albedo, patch.specular = given.specular;
  if (luminance(given.specular) > 0)
    patch.exponent = given.exponent;
  else
    patch.gloss.clear();
  if (given.model == PatchModel::HeightField) {
    patch.heightmap = given.heightmap, patch.depth = given.depth, patch.grid = given.grid;
    if (isBuiltin(given.heightmap)) patch.count = given.count, patch.seed = given.seed;
  } else if (given.model == PatchModel::Weave) {
    patch.depth = given.depth, patch.yarns = given.yarns, patch.radius = given.radius;
    patch.amplitude = given.amplitude, patch.warp = given.warp;
  } else if (given.model == PatchModel::Mesh) {
    patch.mesh = given.mesh, patch.period = given.period;
  }
  return patch;
}

/// Patches, and what of `rtt` any of them reads. Layers that show nothing anywhere are none.
void resolvePatch(Recipe& recipe) {
  const RttRecipe given = recipe.rtt;
  if (!hasLayers(recipe)) recipe.layers.clear();
  std::erase_if(recipe.layers, [](const LayerRecipe& layer) { return !isPainted(layer); });
  bool baked = false, glossy = false;
  const auto resolve = [&](PatchOptions& patch) {
    patch = readOf(patch);
    baked = baked || (patch.model != PatchModel::None && patch.model != PatchModel::Btf);
    glossy = glossy || luminance(patch.specular) > 0;
  };
  resolve(recipe.patch);
  for (LayerRecipe& layer : recipe.layers) resolve(layer.patch);
  if (!hasPatch(recipe)) {
    recipe.rtt = {};
  } else if (!baked) {
    recipe.rtt = {};
    recipe.rtt.texels = given.texels, recipe.rtt.views = given.views, recipe.rtt.bands = given.bands;
    recipe.rtt.storage = given.storage;
  } else if (!glossy) {
    recipe.rtt.lobeRays = RttRecipe{}.lobeRays;
  }
}

/// Without a patch nothing is laid; by coordinates nothing is grown.
void resolveSynthesis(Recipe& recipe) {
  const SynthesisRecipe given = recipe.synthesis;
  if (recipe.patch.model == PatchModel::None || given.mapping == PatchMapping::Uv) {
    recipe.field = {}, recipe.synthesis = {}, recipe.idmap = {};
    if (recipe.patch.model != PatchModel::None)
      recipe.synthesis.mapping = given.mapping, recipe.synthesis.repeat = given.repeat;
    return;
  }
  recipe.synthesis.repeat = SynthesisRecipe{}.repeat;
  if (recipe.field.strokes.empty()) recipe.field.width = FieldRecipe{}.width;
}

void resolveMaterial(Material& material) {
  if (material.glossy()) return;
  const Material defaults;
  material.model = MaterialModel::Lambert;
  material.specular = defaults.specular;
  material.exponent = defaults.exponent;
}

/// To a bake, an object that is captured is one that is not there.
void resolveCaptured(ObjectRecipe& object) {
  object.emission = Rgb(0);
  if (!object.captured) return;
  ObjectRecipe hidden;
  hidden.name = object.name, hidden.mesh = object.mesh;
  hidden.visible = false;
  object = hidden;
}

}  // namespace

std::vector<std::string> contradictions(const Recipe& recipe) {
  const TransferRecipe& t = recipe.transfer;
  std::vector<std::string> lines;
  if (!t.shadows || t.kind == TransferKind::None) return lines;  // says by itself that there is nothing else
  if (t.kind == TransferKind::Visibility && t.bounces > 0)
    lines.push_back("transfer.kind=visibility holds shadows only: the " + std::to_string(t.bounces) +
                    " bounces of transfer.bounces are left out; use matrix or auto to have them, or set "
                    "transfer.bounces=0");
  if (hasPatch(recipe) && recipe.synthesis.mapping == PatchMapping::Uv &&
      std::any_of(recipe.layers.begin(), recipe.layers.end(), isPainted))
    lines.push_back(
        "synthesis.mapping=uv lays one patch: the layers are left out; use synthesis to have them");
  if (t.where == TransferWhere::Texel && showsPatch(recipe))
    lines.push_back(
        "method.name=biscale lights the patch by transfer at the vertices: transfer.where=texel is left out; "
        "use "
        "another method to have it");
  if (t.kind == TransferKind::Diffuse && anyGlossy(recipe))
    lines.push_back(
        "transfer.kind=diffuse shows no highlights: glossy materials are drawn without their specular part; "
        "use visibility, matrix or auto to have it");
  return lines;
}

Recipe resolved(const Recipe& recipe) {
  Recipe out = recipe;
  resolveTransfer(recipe, out.transfer);
  resolvePatch(out);
  resolveSynthesis(out);
  for (ObjectRecipe& object : out.objects) {
    resolveCaptured(object);
    resolveMesh(object.mesh);
    resolveMaterial(object.material);
  }
  return out;
}

}  // namespace prt
