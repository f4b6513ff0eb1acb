// From a mesh to the first lit frame with a woven patch, everything at its default: charts, atlas, radiance
// transfer texture, synthesis, id map, transfer matrices, picture. (The paper: about 8 hours.)

#include "libprt/core/parallel.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/project/relight.h"
#include "libprt/study/bench_list.h"

#include <chrono>

namespace prt {
namespace {

constexpr double kLimit = 120;

/// Seconds of every stage.
class StageTimes : public PipelineListener {
 public:
  void stageBegun(const Stage&) override { begun_ = std::chrono::steady_clock::now(); }
  void stageDone(const Stage& stage, const ProductState&, bool made) override {
    if (made)
      seconds["seconds_" + stage.name] =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }
  bool wantsPreviews() const override { return false; }
  std::map<std::string, double> seconds;

 private:
  std::chrono::steady_clock::time_point begun_;
};

/// The first frame: 512 x 512 as the paper's.
Image firstFrame(const Recipe& recipe, const Products& products, Job& job) {
  BakedScene baked = bakedScene(products);
  baked.patch = laidPatch(products, recipe);
  EnvironmentCache environments;
  return relight(baked, recipe, makeLightRig(recipe.lights, ".", environments),
                 frameBox(baked.geometry->scene->mesh.bounds()), {512, 512, 2}, job);
}

}  // namespace

Recipe pipelineBenchRecipe(const std::string& mesh) {
  Recipe recipe;
  recipe.objects[0].mesh.path = mesh;
  recipe.patch.model = PatchModel::Weave;
  recipe.transfer.kind = TransferKind::Matrix;
  recipe.method.name = "biscale";
  return recipe;
}

BenchResult runPipelineBench(const Recipe& recipe, Job& job) {
  InnerJob inner(job);
  job.begin("bench pipeline", 1, "runs");
  StageTimes times;
  Pipeline pipeline(nullptr, {});
  Image frame;
  Products products;
  const double seconds = secondsOf([&] {
    products =
        pipeline.run(recipe, {"rtt", "idmap", "atlas", "frames", "samples", "transfer"}, inner.job, &times);
    times.seconds["seconds_frame"] = secondsOf([&] { frame = firstFrame(recipe, products, inner.job); });
  });
  job.advance(1);
  double covered = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) covered += double(frame.data[4 * i + 3]);
  BenchResult result;
  result.name = "pipeline";
  result.ratio = kLimit / seconds;
  result.ours = {seconds, "s"};
  result.againstWhat = "two minutes";
  result.against = {kLimit, "s"};
  result.details = times.seconds;
  result.details["threads"] = threadCount();
  result.details["vertices"] = double(products.get<SceneProduct>("scene")->scene->mesh.vertexCount());
  result.details["covered"] = covered / double(frame.pixels());
  return result;
}

BenchResult benchPipeline(Job& job, int) {
  return runPipelineBench(pipelineBenchRecipe("builtin:bird"), job);
}

}  // namespace prt
