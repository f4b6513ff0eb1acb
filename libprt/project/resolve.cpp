// What a recipe comes to: `auto` decided, values without effect at their defaults.

#include "libprt/project/pipeline.h"

#include <algorithm>

namespace prt {
namespace {

/// The cheapest form that holds what the materials and bounces need.
TransferKind cheapestKind(const Recipe& recipe) {
  const bool glossy = std::any_of(recipe.objects.begin(), recipe.objects.end(),
                                  [](const ObjectRecipe& o) { return o.material.glossy(); });
  if (!glossy) return TransferKind::Diffuse;
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
  if (transfer.kind == TransferKind::Visibility) transfer.bounces = 0;
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

void resolveMaterial(Material& material) {
  if (material.glossy()) return;
  const Material defaults;
  material.model = MaterialModel::Lambert;
  material.specular = defaults.specular;
  material.exponent = defaults.exponent;
}

}  // namespace

Recipe resolved(const Recipe& recipe) {
  Recipe out = recipe;
  resolveTransfer(recipe, out.transfer);
  for (ObjectRecipe& object : out.objects) {
    resolveMesh(object.mesh);
    resolveMaterial(object.material);
  }
  return out;
}

}  // namespace prt
