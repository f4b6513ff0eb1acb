#include "app/cli/bench_gl.h"

#include "libprt/core/parallel.h"
#include "libprt/gl/headless_context.h"
#include "libprt/gl/scene_renderer.h"
#include "libprt/project/laid_patch.h"
#include "libprt/study/bench_list.h"
#include "libprt/study/biscale_stage.h"

#include <algorithm>

namespace prt::cli {
namespace {

constexpr int kSide = BiscaleStage::kSide;

/// A frame in OpenGL, and its parts one by one. Each ends when the picture is there.
class Parts {
 public:
  Parts(const BiscaleStage& stage, int samples)
      : stage_(stage), target_(gl::Framebuffer::create(kSide, kSide, gl::PixelFormat::Rgba8, false)) {
    renderer_.setScene(*stage.scene().scene);
    renderer_.setPatch(stage.scene().patch);
    picture_.width = picture_.height = kSide;
    picture_.samples = samples;
  }

  void transfer(Job& job) {
    const LiveScene& scene = stage_.scene();
    renderer_.setPatchLight(*scene.samples, *scene.transfer, scene.light, job);
    gl::finish();
  }
  /// By the compute shader; false where the driver keeps no matrices.
  bool keep(Job& job) {
    const LiveScene& scene = stage_.scene();
    kept_ = renderer_.keepPatchTransfer(
        turnedTransfer(*scene.patch, *scene.samples, *scene.transfer, gl::TransferPass::mostBytes(), job));
    return kept_;
  }
  void transferThere() {
    if (kept_) renderer_.setPatchLight(stage_.scene().light);
    gl::finish();
  }
  void draw() {
    picture_.camera = stage_.picture().camera;
    renderer_.draw(picture_, target_.id());
    gl::finish();
  }

 private:
  const BiscaleStage& stage_;
  gl::SceneRenderer renderer_;
  gl::Framebuffer target_;
  gl::Picture picture_;
  bool kept_ = false;
};

}  // namespace

const BenchInfo& glBenchInfo() {
  static const BenchInfo info{"gl", "the frames of bench biscale in OpenGL: rate against the CPU renderer's"};
  return info;
}

BenchResult runGlBench(Job& job, int repetitions) {
  constexpr int kFrames = 60, kWarmUp = 3;
  const int frames = repetitions > 0 ? repetitions : kFrames;
  InnerJob inner(job);
  job.begin("bench gl", 1, "runs");
  const Recipe recipe = biscaleBenchRecipe();
  Pipeline pipeline(nullptr, {});
  const Products products = pipeline.run(recipe, stagesOfPicture(recipe), inner.job);
  BiscaleStage stage(recipe, products);
  const gl::HeadlessContext context;
  Parts plain(stage, 1), smooth(stage, 4);
  LiveRenderer cpu;
  std::vector<std::uint32_t> pixels(std::size_t(kSide) * kSide);
  std::vector<double> light, transfer, computed, draw, multisampled, rival;
  const bool kept = plain.keep(inner.job);
  for (int frame = -kWarmUp; frame < frames; ++frame) {
    stage.step(frame);
    const double projected = secondsOf([&] { stage.light(); });
    const double transferred = secondsOf([&] { plain.transfer(inner.job); });
    const double there = secondsOf([&] { plain.transferThere(); });
    const double drawn = secondsOf([&] { plain.draw(); });
    smooth.transfer(inner.job);
    const double drawnSmooth = secondsOf([&] { smooth.draw(); });
    const double onCpu = secondsOf([&] { cpu.draw(stage.scene(), stage.picture(), pixels, inner.job); });
    if (frame < 0) continue;  // shaders are compiled, buffers found
    light.push_back(projected), transfer.push_back(transferred), computed.push_back(there),
        draw.push_back(drawn);
    multisampled.push_back(drawnSmooth), rival.push_back(projected + onCpu);
  }
  job.advance(1);
  const double fastest = kept ? std::min(median(transfer), median(computed)) : median(transfer);
  const double ours = median(light) + fastest + median(draw);
  BenchResult result;
  result.name = glBenchInfo().name;
  result.ratio = median(rival) / ours;
  result.ours = {1 / ours, "frames/s"};
  result.againstWhat = "the CPU renderer; OpenGL: " + gl::describeContext();
  result.against = {1 / median(rival), "frames/s"};
  result.details = {{"ms_light", 1e3 * median(light)},
                    {"ms_transfer_cpu", 1e3 * median(transfer)},
                    {"ms_transfer_compute", kept ? 1e3 * median(computed) : 0},
                    {"ms_draw", 1e3 * median(draw)},
                    {"ms_draw_4_samples", 1e3 * median(multisampled)},
                    {"threads", double(threadCount())},
                    {"vertices", double(stage.scene().scene->mesh.vertexCount())}};
  return result;
}

}  // namespace prt::cli
