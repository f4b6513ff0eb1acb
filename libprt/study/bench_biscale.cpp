// Frames of both scales together, as the paper measured them: 512 x 512, a mesh of about 10 800 vertices with
// matrices of 25 x 25, a weave of 64 x 64 texels and 8 x 8 views, light and view both changing in every
// frame, against the paper's 14.5 frames a second (Radeon 9700).

#include "libprt/project/laid_patch.h"
#include "libprt/study/bench_list.h"
#include "libprt/study/biscale_stage.h"

namespace prt {
namespace {

constexpr double kPaper = 14.5;
constexpr int kSide = BiscaleStage::kSide;

/// A frame on the CPU, and its parts one by one.
class Parts {
 public:
  explicit Parts(const BiscaleStage& stage) : stage_(stage) {}

  void raster(Job& job) {
    view_ = makeBiscaleView(*stage_.scene().patch, stage_.picture().camera, kSide, kSide, {}, job);
  }
  void transfer(Job& job) {
    const LiveScene& scene = stage_.scene();
    surface_ = BiscaleLight(*scene.patch, view_.frames, *scene.samples, *scene.transfer, scene.light, job);
  }
  void draw(Job& job) { renderer_.draw(stage_.scene(), stage_.picture(), pixels_, job); }

  double seenFrames() const { return double(view_.frames.size()); }
  double covered() const {
    double sum = 0;
    for (const BiscaleTile& tile : view_.tiles)
      for (const BiscaleFragment& f : tile.fragments) sum += double(f.share);
    return sum / (double(kSide) * kSide);
  }

 private:
  const BiscaleStage& stage_;
  BiscaleView view_;
  BiscaleLight surface_;
  LiveRenderer renderer_;
  std::vector<std::uint32_t> pixels_ = std::vector<std::uint32_t>(std::size_t(kSide) * kSide);
};

}  // namespace

BiscaleFrame biscaleFrame(const Recipe& recipe, const Products& products, int frames, Job& job) {
  BiscaleStage stage(recipe, products);
  Parts parts(stage);
  std::vector<double> whole, light, raster, transfer;
  for (int frame = 0; frame < frames; ++frame) {
    stage.step(frame);
    light.push_back(secondsOf([&] { stage.light(); }));
    whole.push_back(light.back() + secondsOf([&] { parts.draw(job); }));
    raster.push_back(secondsOf([&] { parts.raster(job); }));
    transfer.push_back(secondsOf([&] { parts.transfer(job); }));
  }
  return {median(whole),
          median(light),
          median(raster),
          median(transfer),
          double(stage.scene().scene->mesh.vertexCount()),
          parts.seenFrames(),
          parts.covered()};
}

BenchResult benchBiscale(Job& job, int repetitions) {
  InnerJob inner(job);
  job.begin("bench biscale", 1, "runs");
  const Recipe recipe = biscaleBenchRecipe();
  Pipeline pipeline(nullptr, {});
  const Products products = pipeline.run(recipe, stagesOfPicture(recipe), inner.job);
  const BiscaleFrame frame = biscaleFrame(recipe, products, repetitions, inner.job);
  job.advance(1);
  BenchResult result;
  result.name = "biscale";
  result.ratio = 1 / frame.whole / kPaper;
  result.ours = {1 / frame.whole, "frames/s"};
  result.againstWhat = "the paper's rate on a Radeon 9700";
  result.against = {kPaper, "frames/s"};
  result.details = {{"vertices", frame.vertices},
                    {"vertices_seen", frame.framesSeen},
                    {"covered", frame.covered},
                    {"ms_light", 1e3 * frame.light},
                    {"ms_raster", 1e3 * frame.raster},
                    {"ms_transfer", 1e3 * frame.transfer},
                    {"ms_shade", 1e3 * (frame.whole - frame.light - frame.raster - frame.transfer)}};
  return result;
}

}  // namespace prt
