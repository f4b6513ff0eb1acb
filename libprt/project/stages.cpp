#include "libprt/project/stages.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "libprt/project/products.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

ProductPtr makeMeshes(StageRun& run);
ProductPtr makeScene(StageRun& run);
ProductPtr makeSamples(StageRun& run);
ProductPtr makeRays(StageRun& run);

/// The pipeline. A stage reads its inputs and the parts of the recipe that stand in its line, nothing else.
std::vector<Stage> makeStages() {
  return {
      {.name = "mesh",
       .makes = "the repaired mesh of each object",
       .reads = {"objects[].mesh"},
       .make = makeMeshes,
       .load = MeshProduct::load},
      {.name = "scene",
       .makes = "all objects in one mesh, in the common frame",
       .inputs = {"mesh"},
       .reads = {"objects[].transform", "objects[].material.twoSided"},
       .stored = false,
       .make = makeScene},
      {.name = "samples",
       .makes = "the points that transfer is computed at: the vertices",
       .inputs = {"scene"},
       .stored = false,
       .make = makeSamples},
      {.name = "rays",
       .makes = "the tree that rays are traced through",
       .inputs = {"scene"},
       .stored = false,
       .make = makeRays},
  };
}

/// One object's mesh, built in or from its file.
std::shared_ptr<const TriMesh> meshOf(const MeshRecipe& mesh, StageRun& run, std::string& report) {
  if (isBuiltin(mesh.path)) {
    const std::string name = mesh.path.substr(mesh.path.find(':') + 1);
    return std::make_shared<TriMesh>(makeBuiltinMesh(name, mesh.detail, std::uint32_t(mesh.seed)));
  }
  RepairOptions options;
  options.weld = mesh.weld;
  options.orientation = Orientation(int(mesh.orientation));
  options.splitNonManifold = mesh.splitNonManifold;
  options.keepNormals = mesh.keepNormals;
  options.creaseAngle = float(radians(mesh.crease));
  RepairReport repaired;
  auto loaded = std::make_shared<TriMesh>(loadMesh(run.file(mesh.path), options, run.job(), &repaired));
  nlohmann::json json = toJson(repaired);
  json["text"] = toText(repaired);
  report = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return loaded;
}

ProductPtr makeMeshes(StageRun& run) {
  auto product = std::make_shared<MeshProduct>();
  for (const ObjectRecipe& object : run.recipe().objects) {
    run.job().checkCancelled();
    std::string& report = product->reports.emplace_back("{}");
    product->meshes.push_back(meshOf(object.mesh, run, report));
  }
  return product;
}

ProductPtr makeScene(StageRun& run) {
  const auto meshes = run.input<MeshProduct>("mesh");
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < meshes->meshes.size(); ++i) {
    const ObjectRecipe& object = run.recipe().objects[i];
    Material geometryOnly;
    geometryOnly.twoSided = object.material.twoSided;
    objects.push_back({object.name, meshes->meshes[i], object.transform.matrix(), geometryOnly});
  }
  return std::make_shared<SceneProduct>(flattenScene(objects));
}

ProductPtr makeSamples(StageRun& run) {
  return std::make_shared<SamplesProduct>(samplesAtVertices(*run.input<SceneProduct>("scene")->scene));
}

ProductPtr makeRays(StageRun& run) {
  return std::make_shared<RaysProduct>(*run.input<SceneProduct>("scene")->scene);
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
