#include "libprt/project/bake.h"

#include "libprt/core/error.h"
#include "libprt/core/log.h"
#include "libprt/meso/rtt_seam.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/products.h"
#include "libprt/project/project_file.h"
#include "libprt/project/synthesis_stages.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

/// Times the stages and passes everything on.
class Timer : public PipelineListener {
 public:
  explicit Timer(PipelineListener* next) : next_(next) {}

  void stageBegun(const Stage& stage) override {
    begun_ = Clock::now();
    if (next_) next_->stageBegun(stage);
  }
  void stageDone(const Stage& stage, const ProductState& state, bool made) override {
    const double seconds = made ? std::chrono::duration<double>(Clock::now() - begun_).count() : 0;
    times.push_back({stage.name, state.key, made, seconds});
    if (next_) next_->stageDone(stage, state, made);
  }
  void preview(const Stage& stage, const ProductState& state) override {
    if (next_) next_->preview(stage, state);
  }
  bool wantsPreviews() const override { return next_ && next_->wantsPreviews(); }

  std::vector<BakeSummary::StageTime> times;

 private:
  PipelineListener* next_;
  Clock::time_point begun_;
};

std::vector<std::string> storedStages(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const Stage& stage : stages())
    if (stage.stored && isWanted(stage, recipe)) names.push_back(stage.name);
  return names;
}

std::unique_ptr<ProjectFile> openOutput(const RecipeSource& source, const fs::path& output) {
  std::error_code error;
  if (!fs::is_directory(folderOf(output), error))
    throw FileError("its folder does not exist", output.string(), "make the folder first");
  auto project = ProjectFile::openForWork(output);
  if (!source.project.empty() && !sameFile(source.project, output))
    project->importFrom(*ProjectFile::open(source.project));
  return project;
}

std::vector<BakeSummary::Object> describeObjects(const Recipe& recipe, const MeshProduct& meshes) {
  std::vector<BakeSummary::Object> objects;
  for (std::size_t i = 0; i < meshes.meshes.size(); ++i)
    objects.push_back({recipe.objects[i].name, meshes.meshes[i]->vertexCount(),
                       meshes.meshes[i]->triangleCount(), meshes.repairText(i)});
  return objects;
}

BakeSummary::TransferFacts describeTransfer(const Transfer& t) {
  const std::size_t bytes = t.bytes() + t.diffuse.bytes.size() + t.surface.bytes.size();
  return {toString(t.form), t.bands, t.raysPerSample, t.bounces, t.samples, bytes, t.storageError};
}

BakeSummary::RttFacts describeRtt(const RttProduct& product, const PatchProduct* patch) {
  const Rtt& r = *product.rtt;
  return {r.texels,
          r.views,
          r.bands,
          r.channels,
          r.bounces,
          patch && patch->patch ? double(patch->patch->depth()) : 0,
          patch && patch->patch ? thinPatchWarning(*patch->patch, r.views) : "",
          product.storageError,
          product.viewError,
          patch && !patch->patch ? seamStep(r) : 1};
}

}  // namespace

std::string toString(TransferForm form) {
  switch (form) {
    case TransferForm::None:
      return "none";
    case TransferForm::Diffuse:
      return "diffuse";
    case TransferForm::Visibility:
      return "visibility";
    default:
      return "matrix";
  }
}

BakeSummary bakeProject(const RecipeSource& source, const BakeOptions& options, Job& job,
                        PipelineListener* listener) {
  const auto project = openOutput(source, options.output);
  try {
    BakeSummary summary;
    summary.file = options.output;
    summary.resumed = project->resumed();
    summary.notes = contradictions(source.recipe);
    for (const std::string& note : summary.notes) logWarning(note);
    Recipe recipe = source.recipe;
    rebasePaths(recipe, source.folder, folderOf(options.output));
    const bool sameRecipe = recipe == project->recipe();
    project->setRecipe(recipe);
    Pipeline pipeline(project.get(), {folderOf(options.output), options.checkpointSeconds});
    Timer timer(listener);
    const Products products =
        pipeline.run(recipe, options.stages.empty() ? storedStages(recipe) : options.stages, job, &timer);
    if (project->hasNewWork() || !sameRecipe || !project->saved()) {
      project->keepOnly(pipeline.liveKeys(recipe));
      project->save();
    } else {
      project->discardWork();
    }
    summary.stages = timer.times;
    summary.bytes = project->bytes();
    if (const auto meshes = products.get<MeshProduct>("mesh"))
      summary.objects = describeObjects(recipe, *meshes);
    if (const auto transfer = products.get<TransferProduct>("transfer"))
      summary.transfer = describeTransfer(transfer->transfer);
    if (const auto rtt = products.get<RttProduct>("rtt"); rtt && rtt->rtt)
      summary.rtt = describeRtt(*rtt, products.get<PatchProduct>("patch").get());
    if (const auto laid = products.get<SynthesisProduct>("synthesis"); laid && laid->meso)
      summary.synthesis = {laid->meso->vertexCount(), laid->patchWidth, laid->quality.distance,
                           laid->quality.coherence, laid->quality.longestRepeat};
    if (const auto charts = products.get<ChartsProduct>("charts"))
      if (const std::string note = stretchNote(recipe, *charts); !note.empty()) summary.notes.push_back(note);
    if (const auto atlas = products.get<AtlasProduct>("atlas")) {
      const AtlasFacts& f = atlas->facts;
      summary.atlas = {f.charts, f.l2, f.lInf, f.seam, f.filled};
    }
    if (const auto floor = products.get<FloorProduct>("floor")) summary.floor = floor->floor;
    return summary;
  } catch (...) {
    if (!project->hasNewWork()) project->discardWork();
    throw;
  }
}

nlohmann::json toJson(const BakeSummary& s) {
  nlohmann::json objects = nlohmann::json::array(), stageList = nlohmann::json::array();
  for (const BakeSummary::Object& o : s.objects)
    objects.push_back(
        {{"name", o.name}, {"vertices", o.vertices}, {"triangles", o.triangles}, {"repair", o.repair}});
  for (const BakeSummary::StageTime& t : s.stages)
    stageList.push_back({{"name", t.name}, {"key", t.key}, {"made", t.made}, {"seconds", t.seconds}});
  nlohmann::json json{{"file", s.file.string()}, {"bytes", s.bytes},   {"resumed", s.resumed},
                      {"notes", s.notes},        {"objects", objects}, {"stages", stageList}};
  if (s.transfer) {
    const BakeSummary::TransferFacts& t = *s.transfer;
    json["transfer"] = {{"form", t.form},
                        {"bands", t.bands},
                        {"rays", t.rays},
                        {"bounces", t.bounces},
                        {"samples", t.samples},
                        {"bytes", t.bytes},
                        {"storage_error", t.storageError}};
  }
  if (s.rtt)
    json["rtt"] = {{"texels", s.rtt->texels},     {"views", s.rtt->views},
                   {"bands", s.rtt->bands},       {"channels", s.rtt->channels},
                   {"bounces", s.rtt->bounces},   {"depth", s.rtt->depth},
                   {"warning", s.rtt->warning},   {"storage_error", s.rtt->storageError},
                   {"seam_step", s.rtt->seamStep}};
  if (s.rtt && s.rtt->viewError) {
    json["rtt"]["view_error_between"] = s.rtt->viewError->between;
    json["rtt"]["view_error_beyond"] = s.rtt->viewError->beyond;
  }
  if (s.synthesis)
    json["synthesis"] = {{"vertices", s.synthesis->vertices},
                         {"patch_width", s.synthesis->patchWidth},
                         {"distance", s.synthesis->distance},
                         {"coherence", s.synthesis->coherence},
                         {"longest_repeat", s.synthesis->longestRepeat}};
  if (s.atlas)
    json["atlas"] = {{"charts", s.atlas->charts},
                     {"stretch_l2", s.atlas->l2},
                     {"stretch_max", s.atlas->lInf},
                     {"seam", s.atlas->seam},
                     {"filled", s.atlas->filled}};
  if (s.floor)
    json["floor"] = {{"interpolation", s.floor->interpolation},
                     {"standard_error", s.floor->interpolationError},
                     {"monte_carlo", s.floor->sampling},
                     {"total", s.floor->product},
                     {"points", s.floor->points}};
  return json;
}

}  // namespace prt
