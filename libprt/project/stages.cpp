#include "libprt/project/stages.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/project/products.h"

namespace prt {
namespace {

ProductPtr makeMeshes(StageRun& run) {
  auto product = std::make_shared<MeshProduct>();
  run.job().begin("meshes", double(run.recipe().objects.size()), "objects");
  for (const ObjectRecipe& object : run.recipe().objects) {
    run.job().checkCancelled();
    const MeshRecipe& mesh = object.mesh;
    if (!isBuiltin(mesh.path)) throw FileError("mesh files are not read yet", mesh.path, "use builtin:vase");
    const std::string name = mesh.path.substr(mesh.path.find(':') + 1);
    product->meshes.push_back(std::make_shared<TriMesh>(makeBuiltinMesh(name, mesh.detail, std::uint32_t(mesh.seed))));
    product->reports.push_back("{}");
    run.job().advance(1);
  }
  return product;
}

ProductPtr makeScene(StageRun& run) {
  const auto meshes = run.input<MeshProduct>("mesh");
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < meshes->meshes.size(); ++i) {
    const ObjectRecipe& object = run.recipe().objects[i];
    objects.push_back({object.name, meshes->meshes[i], object.transform.matrix(), Material{}});
  }
  auto product = std::make_shared<SceneProduct>();
  product->scene = flattenScene(objects);
  return product;
}

/// The pipeline. A stage reads its inputs and what stands in its third column, nothing else.
std::vector<Stage> makeStages() {
  std::vector<Stage> table;
  table.push_back({.name = "mesh",
                   .makes = "the repaired mesh of each object",
                   .reads = {"objects[].mesh"},
                   .make = makeMeshes,
                   .load = MeshProduct::load});
  table.push_back({.name = "scene",
                   .makes = "all objects in one mesh, in the common frame",
                   .inputs = {"mesh"},
                   .reads = {"objects[].transform"},
                   .stored = false,
                   .make = makeScene});
  return table;
}

}  // namespace

const std::vector<Stage>& stages() {
  static const std::vector<Stage> table = makeStages();
  return table;
}

std::vector<std::string> stageNames() {
  std::vector<std::string> names;
  for (const Stage& stage : stages()) names.push_back(stage.name);
  return names;
}

}  // namespace prt
