#include "libprt/project/stages.h"

#include "libprt/core/error.h"
#include "libprt/core/log.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/errors.h"
#include "libprt/project/hand_cuts.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/products.h"
#include "libprt/project/synthesis_stages.h"
#include "libprt/transport/cluster_transfer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>

namespace prt {
namespace {

ProductPtr makeMeshes(StageRun& run);
ProductPtr makeScene(StageRun& run);
ProductPtr makeSamples(StageRun& run);
ProductPtr makeFrames(StageRun& run);
ProductPtr makeRays(StageRun& run);
ProductPtr makeDirect(StageRun& run);
ProductPtr makeTransfer(StageRun& run);
ProductPtr makeFloor(StageRun& run);
std::string directForm(const Recipe& recipe);

/// Charts, and what lies on them: for pictures of the patch on the surface; else by `--stage`.
bool grownPatch(const Recipe& recipe) {
  return showsPatch(recipe) && recipe.synthesis.mapping == PatchMapping::Synthesis;
}

bool grownLayers(const Recipe& recipe) {
  return showsPatch(recipe) && hasLayers(recipe);
}

/// Charts of objects that carry no patch are packed smaller where there is one.
std::string roomForPatchText(const Recipe& recipe) {
  return recipe.patch.model != PatchModel::None ? plainObjectsText(recipe) : std::string();
}

bool bakesAtTexels(const Recipe& recipe) {
  return recipe.transfer.where == TransferWhere::Texel;
}

/// How many texels, where transfer is at texels.
std::string texelsText(const Recipe& recipe) {
  return bakesAtTexels(recipe) ? std::to_string(recipe.transfer.texels) + " texels" : std::string();
}

/// The pipeline. A stage reads its inputs and the parts of the recipe that stand in its line, nothing else.
std::vector<Stage> makeStages() {
  return {
      {.name = "mesh",
       .makes = "the repaired mesh of each object, and where its file was at fault",
       .version = 2,
       .reads = {"objects[].mesh"},
       .make = makeMeshes,
       .load = MeshProduct::load},
      {.name = "scene",
       .makes = "all objects in one mesh, in the common frame",
       .inputs = {"mesh"},
       .reads = {"objects[].visible", "objects[].transform", "objects[].material.twoSided"},
       .stored = false,
       .make = makeScene},
      {.name = "charts",
       .makes = "the surface cut into disks, each laid flat",
       .version = 2,
       .inputs = {"scene"},
       .reads = {"objects[].seams", "charts"},
       .derives = cornersText,
       .wanted = grownPatch,
       .previews = false,
       .make = makeChartsStage,
       .load = ChartsProduct::load},
      {.name = "atlas",
       .makes = "all charts side by side in one square",
       .inputs = {"scene", "charts"},
       .reads = {"objects[].charts", "atlas"},
       .derives = roomForPatchText,
       .wanted = grownPatch,
       .previews = false,
       .make = makeAtlasStage,
       .load = AtlasProduct::load},
      {.name = "samples",
       .makes = "the points that transfer is computed at: vertices, or texels of the atlas",
       .inputs = {"scene", "atlas"},
       .onlyFor = {{"atlas", bakesAtTexels}},
       .derives = texelsText,
       .stored = false,
       .make = makeSamples},
      {.name = "field",
       .makes = "directions along which patches are laid",
       .version = 2,
       .inputs = {"scene"},
       .reads = {"field", "patch.model", "synthesis.mapping"},
       .wanted = grownPatch,
       .stored = false,
       .previews = false,
       .make = makeFieldStage},
      {.name = "frames",
       .makes = "a tangent frame at each corner of each triangle",
       .inputs = {"scene", "field"},
       .wanted = showsPatch,
       .stored = false,
       .make = makeFrames},
      {.name = "rays",
       .makes = "the tree that rays are traced through",
       .inputs = {"scene"},
       .stored = false,
       .make = makeRays},
      {.name = "direct",
       .makes = "what light from outside does at each sample, shadowed but not reflected",
       .version = 4,
       .inputs = {"scene", "samples", "rays"},
       .reads = {"transfer.bands", "transfer.rays", "transfer.seed"},
       .extends = {"transfer.rays"},
       .derives = directForm,
       .make = makeDirect,
       .load = DirectProduct::load},
      {.name = "transfer",
       .makes = "direct transfer and bounces, in the form that materials need",
       .version = 2,
       .inputs = {"scene", "samples", "rays", "direct"},
       .reads = {"objects[].material.albedo", "transfer.kind", "transfer.bounces", "transfer.threshold",
                 "transfer.storage", "transfer.compress"},
       .make = makeTransfer,
       .load = TransferProduct::load},
      {.name = "floor",
       .makes = "the error that interpolating between samples leaves, and the noise of the bake",
       .inputs = {"scene", "samples", "rays", "transfer"},
       .previews = false,
       .make = makeFloor,
       .load = FloorProduct::load},
      {.name = "patch",
       .makes = "one period of the surface's fine structure",
       .reads = {"patch"},
       .wanted = hasPatch,
       .make = makePatchStage,
       .load = PatchProduct::load},
      {.name = "rtt",
       .makes = "how the patch answers to light, for every texel and view",
       .version = 2,
       .inputs = {"patch"},
       .reads = {"rtt"},
       .wanted = hasPatch,
       .make = makeRttStage,
       .load = RttProduct::load},
      {.name = "layers",
       .makes = "the same for the patches that are painted over it",
       .reads = {"layers[].patch", "rtt"},
       .wanted = grownLayers,
       .previews = false,
       .make = makeLayersStage,
       .load = LayersProduct::load},
      {.name = "synthesis",
       .makes = "the place in the patch of every vertex of a dense mesh over the surface",
       .inputs = {"scene", "frames", "rtt", "layers"},
       .onlyFor = {{"layers", hasLayers}},
       .reads = {"field.symmetry", "synthesis", "layers[].spots"},
       .derives = plainObjectsText,
       .wanted = grownPatch,
       .previews = false,
       .make = makeSynthesisStage,
       .load = SynthesisProduct::load},
      {.name = "idmap",
       .makes = "the place in the patch of every texel of the atlas",
       .inputs = {"scene", "atlas", "synthesis"},
       .reads = {"idmap", "layers[].spots"},
       .wanted = grownPatch,
       .make = makeIdMapStage,
       .load = IdMapProduct::load},
  };
}

/// One object's mesh, built in or from its file.
std::shared_ptr<const TriMesh> meshOf(const MeshRecipe& mesh, StageRun& run, std::string& report,
                                      std::vector<DefectLine>& defects) {
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
  json["facts"] = factsText(repaired.after);
  defects = defectLines(repaired);
  report = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return loaded;
}

ProductPtr makeMeshes(StageRun& run) {
  auto product = std::make_shared<MeshProduct>();
  for (const ObjectRecipe& object : run.recipe().objects) {
    run.job().checkCancelled();
    std::string& report = product->reports.emplace_back("{}");
    std::vector<DefectLine>& defects = product->defects.emplace_back();
    product->meshes.push_back(meshOf(object.mesh, run, report, defects));
  }
  return product;
}

ProductPtr makeScene(StageRun& run) {
  const auto meshes = run.input<MeshProduct>("mesh");
  const auto nothing = std::make_shared<const TriMesh>();  // in the place of what is hidden: numbers stay
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < meshes->meshes.size(); ++i) {
    const ObjectRecipe& object = run.recipe().objects[i];
    Material geometryOnly;
    geometryOnly.twoSided = object.material.twoSided;
    objects.push_back(
        {object.name, object.visible ? meshes->meshes[i] : nothing, object.transform.matrix(), geometryOnly});
  }
  return std::make_shared<SceneProduct>(flattenScene(objects));
}

ProductPtr makeSamples(StageRun& run) {
  const Scene& scene = *run.input<SceneProduct>("scene")->scene;
  if (!bakesAtTexels(run.recipe()))
    return std::make_shared<SamplesProduct>(samplesAtVertices(scene, &run.job()));
  const Atlas& atlas = *run.input<AtlasProduct>("atlas")->atlas;
  return std::make_shared<SamplesProduct>(
      samplesAtTexels(scene, makeChartTexels(atlas, run.recipe().transfer.texels, run.job()), run.job()));
}

ProductPtr makeFrames(StageRun& run) {
  // Where patches are grown over the surface, their direction is everybody's tangent.
  if (const auto field = run.input<FieldProduct>("field"); field && field->field)
    return std::make_shared<FramesProduct>(field->field->frames);
  return std::make_shared<FramesProduct>(
      makeTangentFrames(run.input<SceneProduct>("scene")->scene->mesh, {}, run.job()));
}

ProductPtr makeRays(StageRun& run) {
  return std::make_shared<RaysProduct>(*run.input<SceneProduct>("scene")->scene);
}

/// What the direct product must hold; all that it has to know about materials.
std::string directForm(const Recipe& recipe) {
  const TransferSettings settings = transferSettings(recipe);
  if (settings.form == TransferForm::None) return "nothing";
  return directSettings(settings, *settings.form).visibility ? "visibility" : "diffuse";
}

constexpr int kTilesBetweenRests = 16;  // however short the time between checkpoints, work gets done

/// Goes on from saved sums, unless they hold more rays than are wanted: a product depends on the recipe
/// alone, not on what was baked before.
void restore(DirectBake& bake, const ProductData& saved, int rays) {
  const auto gathered = saved.arrays.find("direction_rays");
  if (gathered == saved.arrays.end() || gathered->second.dtype != DType::i32 ||
      gathered->second.bytes.size() != 4)
    return;
  if (gathered->second.as<std::int32_t>()[0] > rays) return;
  try {
    bake.restore(saved.arrays);
  } catch (const FileError& error) {
    logWarning(std::string("the saved part of the bake cannot be used and is made again: ") + error.what());
  }
}

ProductPtr makeDirect(StageRun& run) {
  const TransferSettings settings = transferSettings(run.recipe());
  if (settings.form == TransferForm::None) return std::make_shared<DirectProduct>();
  DirectBake bake(run.input<SceneProduct>("scene")->scene, run.input<RaysProduct>("rays")->rays,
                  run.input<SamplesProduct>("samples")->samples, directSettings(settings, *settings.form));
  if (const auto saved = run.checkpoint()) restore(bake, *saved, settings.rays);
  const auto checkpoint = [&] { return ProductData{"{}", bake.checkpoint()}; };
  try {
    while (!bake.done()) {
      const int level = bake.level();
      std::atomic<int> tiles{0};
      bake.advance(run.job(), [&] { return ++tiles > kTilesBetweenRests && run.checkpointDue(); });
      if (run.checkpointDue() && !bake.done()) run.keepCheckpoint(checkpoint);
      if (bake.level() > level && !bake.done() && run.wantsPreviews())
        run.preview(std::make_shared<DirectProduct>(bake.product(run.job())), bake.level(), bake.levels());
    }
  } catch (const Cancelled&) {
    run.keepCheckpoint(checkpoint);
    throw;
  }
  run.keepCheckpoint(checkpoint);  // from here more rays can be added
  return std::make_shared<DirectProduct>(bake.product(run.job()));
}

/// In clusters, where the recipe wants that and it can be. Previews are not worth the time.
Transfer compressed(Transfer transfer, StageRun& run) {
  const auto budget = double(run.recipe().transfer.compress);
  if (budget <= 0 || run.fromPreview() || transfer.form != TransferForm::Matrix) return transfer;
  if (auto few = clusteredTransfer(transfer, {.budget = budget}, run.job())) return *std::move(few);
  logWarning(
      "transfer.compress=" + fmt::format("{:g}", budget) +
      " leaves the matrices as they are: 32 terms a cluster do not keep to it, or save less than half of "
      "the memory");
  return transfer;
}

ProductPtr makeTransfer(StageRun& run) {
  TransferSettings settings = transferSettings(run.recipe());
  // The first preview comes at once, with shadows, in the form that is quick to make; bounces come with the
  // next.
  if (run.fromPreview() && run.inputState("direct").level == 1) {
    settings.bounces = 0;
    if (settings.form == TransferForm::Matrix) settings.form = TransferForm::Visibility;
  }
  const Scene scene = withMaterials(*run.input<SceneProduct>("scene")->scene, run.recipe());
  std::map<std::string, Array> state;  // after the last bounce
  const auto keep = [&] { run.keepCheckpoint([&] { return ProductData{"{}", state}; }); };
  BounceCheckpoint bounces;
  if (const auto saved = run.checkpoint()) bounces.saved = saved->arrays;
  bounces.keep = [&](std::map<std::string, Array> next) {
    state = std::move(next);
    if (run.checkpointDue()) keep();
  };
  try {
    return std::make_shared<TransferProduct>(
        compressed(finishTransfer(scene, *run.input<RaysProduct>("rays")->rays,
                                  *run.input<SamplesProduct>("samples")->samples,
                                  run.input<DirectProduct>("direct")->direct, settings, *settings.form,
                                  run.job(), nullptr, &bounces),
                   run));
  } catch (const Cancelled&) {
    if (!state.empty()) keep();
    throw;
  }
}

/// Reads through "transfer" everything that it asks the recipe for.
ProductPtr makeFloor(StageRun& run) {
  const auto scene =
      std::make_shared<const Scene>(withMaterials(*run.input<SceneProduct>("scene")->scene, run.recipe()));
  return std::make_shared<FloorProduct>(measureInterpolationFloor(
      scene, run.input<RaysProduct>("rays")->rays, *run.input<SamplesProduct>("samples")->samples,
      run.input<TransferProduct>("transfer")->transfer, transferSettings(run.recipe()), {}, run.job()));
}

}  // namespace

const std::vector<Stage>& stages() {
  static const std::vector<Stage> table = makeStages();
  return table;
}

std::vector<std::string> Stage::inputsFor(const Recipe& recipe) const {
  std::vector<std::string> needed;
  for (const std::string& input : inputs) {
    const auto only = onlyFor.find(input);
    if (only == onlyFor.end() || only->second(recipe)) needed.push_back(input);
  }
  return needed;
}

bool isWanted(const Stage& stage, const Recipe& recipe) {
  if (!stage.wanted || stage.wanted(recipe)) return true;
  return std::any_of(stages().begin(), stages().end(), [&](const Stage& user) {
    if (!user.wanted && !user.onlyFor.contains(stage.name)) return false;
    const std::vector<std::string> inputs = user.inputsFor(recipe);
    return std::find(inputs.begin(), inputs.end(), stage.name) != inputs.end() && isWanted(user, recipe);
  });
}

std::vector<std::string> stageNames() {
  std::vector<std::string> names;
  for (const Stage& stage : stages()) names.push_back(stage.name);
  return names;
}

}  // namespace prt
