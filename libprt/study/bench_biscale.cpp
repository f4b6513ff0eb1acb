// Frames of both scales together, as the paper measured them: 512 x 512, a mesh of about 10 800 vertices with
// matrices of 25 x 25, a weave of 64 x 64 texels and 8 x 8 views, light and view both changing in every
// frame, against the paper's 14.5 frames a second (Radeon 9700).

#include "libprt/light/light_rig.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/shade/live_renderer.h"
#include "libprt/study/bench_list.h"

#include <cmath>

namespace prt {
namespace {

constexpr double kPaper = 14.5;
constexpr int kSide = 512;

/// What a frame is drawn from, and its parts one by one.
class Stage512 {
 public:
  Stage512(const Recipe& recipe, const Products& products) : recipe_(recipe) {
    const auto transfer = products.get<TransferProduct>("transfer");
    scene_.scene = products.get<SceneProduct>("scene")->scene;
    scene_.samples = products.get<SamplesProduct>("samples")->samples;
    scene_.transfer = std::shared_ptr<const Transfer>(transfer, &transfer->transfer);
    scene_.materials = scene_.scene->materials;
    scene_.patch = laidPatch(products, recipe);
    EnvironmentCache environments;
    rig_ = makeLightRig(recipe.lights, ".", environments);
    LightRig environment;
    environment.environment = rig_.environment;
    environment_ = projectLights(environment, scene_.transfer->bands);
    home_ = frameBox(scene_.scene->mesh.bounds());
    picture_.width = picture_.height = kSide;
  }

  void step(int frame) {
    rig_.rotation = 0.05f * float(frame);
    const float turn = 0.03f * float(frame);
    const Vec3 d = home_.eye - home_.target;
    picture_.camera = home_;
    picture_.camera.eye = home_.target + Vec3(std::cos(turn) * d.x + std::sin(turn) * d.z, d.y,
                                              std::cos(turn) * d.z - std::sin(turn) * d.x);
  }
  void light() { scene_.light = lightFor(rig_, environment_, recipe_.method); }
  void raster(Job& job) { view_ = makeBiscaleView(*scene_.patch, picture_.camera, kSide, kSide, {}, job); }
  void transfer(Job& job) {
    surface_ =
        BiscaleLight(*scene_.patch, view_.frames, *scene_.samples, *scene_.transfer, scene_.light, job);
  }
  void draw(Job& job) { renderer_.draw(scene_, picture_, pixels_, job); }

  const LiveScene& scene() const { return scene_; }
  double seenFrames() const { return double(view_.frames.size()); }
  double covered() const {
    double sum = 0;
    for (const BiscaleTile& tile : view_.tiles)
      for (const BiscaleFragment& f : tile.fragments) sum += double(f.share);
    return sum / (double(kSide) * kSide);
  }

 private:
  const Recipe& recipe_;
  LiveScene scene_;
  LivePicture picture_;
  LightRig rig_;
  ShRgb environment_;
  Camera home_;
  BiscaleView view_;
  BiscaleLight surface_;
  LiveRenderer renderer_;
  std::vector<std::uint32_t> pixels_ = std::vector<std::uint32_t>(std::size_t(kSide) * kSide);
};

}  // namespace

Recipe biscaleBenchRecipe() {
  Recipe recipe;
  recipe.objects[0].mesh.path = "builtin:rock";
  recipe.patch.model = PatchModel::Weave;
  recipe.method.name = "biscale";
  recipe.transfer.kind = TransferKind::Matrix;
  recipe.transfer.rays = 256;  // how exact they are does not change what applying them takes
  recipe.transfer.bounces = 1;
  recipe.synthesis.vertices = 120'000;
  recipe.lights.push_back({.kind = LightKind::Circle});
  return recipe;
}

BiscaleFrame biscaleFrame(const Recipe& recipe, const Products& products, int frames, Job& job) {
  Stage512 stage(recipe, products);
  std::vector<double> whole, light, raster, transfer;
  for (int frame = 0; frame < frames; ++frame) {
    stage.step(frame);
    light.push_back(secondsOf([&] { stage.light(); }));
    whole.push_back(light.back() + secondsOf([&] { stage.draw(job); }));
    raster.push_back(secondsOf([&] { stage.raster(job); }));
    transfer.push_back(secondsOf([&] { stage.transfer(job); }));
  }
  return {median(whole),
          median(light),
          median(raster),
          median(transfer),
          double(stage.scene().scene->mesh.vertexCount()),
          stage.seenFrames(),
          stage.covered()};
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
