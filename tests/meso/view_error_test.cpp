// The error of interpolating between views, against the same thing done the slow way, and where it must
// vanish.
#include "libprt/meso/view_error.h"

#include "libprt/basis/view_square.h"
#include "libprt/meso/patch_build.h"

#include <gtest/gtest.h>

#include <random>

namespace prt {
namespace {

struct Baked {
  PatchScene scene;
  PatchLight light;
  Rtt rtt;

  Baked(const PatchOptions& options, const RttSettings& settings)
      : scene(makePatchScene(std::make_shared<const Patch>(buildPatch(options, {}, job())), job())),
        light(bakePatchLight(scene, settings, job())),
        rtt(viewsOfPatch(scene, light, settings, job())) {}

  static Job& job() {
    static Job quiet;
    return quiet;
  }
};

RttSettings settingsWith(int views) {
  RttSettings settings;
  settings.texels = 16, settings.views = views, settings.rays = 128, settings.bounces = 0;
  return settings;
}

PatchOptions weave(float thinner = 1) {
  PatchOptions options;
  options.model = PatchModel::Weave;
  options.depth *= thinner;
  return options;
}

double betweenOf(const PatchOptions& options, const RttSettings& settings) {
  const Baked baked(options, settings);
  return measureViewError(baked.scene, baked.light, settings, baked.rtt, Baked::job()).between;
}

TEST(ViewError, AFlatPatchHasNone) {
  PatchOptions options;
  options.model = PatchModel::Flat;
  const RttSettings settings = settingsWith(8);
  const Baked baked(options, settings);
  const ViewError error = measureViewError(baked.scene, baked.light, settings, baked.rtt, Baked::job());
  EXPECT_LT(error.between, 1e-5);
  EXPECT_LT(error.beyond, 1e-5);
}

/// Every row, many random views, the square's corners by hand; the estimate uses few of both.
TEST(ViewError, IsWhatManyViewsGive) {
  const RttSettings settings = settingsWith(8);
  const Baked baked(weave(), settings);
  const ViewError error = measureViewError(baked.scene, baked.light, settings, baked.rtt, Baked::job());
  std::mt19937 random(5);
  std::uniform_real_distribution<float> inside(0.5f / 8, 1 - 0.5f / 8);
  std::vector<Vec3> views;
  for (int i = 0; i < 64; ++i) views.push_back(viewFromSquare({inside(random), inside(random)}));
  const Rtt exact = picturesOfPatch(baked.scene, baked.light, settings, views, 1, Baked::job());
  double wrong = 0, right = 0;
  std::vector<Rgb> b(25);
  for (int t = 0; t < 16 * 16; ++t)
    for (int i = 0; i < 64; ++i) {
      baked.rtt.response(t % 16, t / 16, views[std::size_t(i)], b);
      const float* truth = exact.block(t % 16, t / 16, i);
      for (int l = 0; l < 5; ++l)
        for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
          const double weight = 1.0 / (l + 1) / (l + 1), colour = exact.colour.x;
          wrong += weight * std::pow(double(b[std::size_t(k)].x) - colour * truth[k], 2);
          right += weight * std::pow(colour * truth[k], 2);
        }
    }
  EXPECT_NEAR(error.between, std::sqrt(wrong / right), 0.2 * std::sqrt(wrong / right));
  EXPECT_GT(error.beyond, error.between);
}

TEST(ViewError, FallsWithMoreViewsAndThinnerPatches) {
  const double eight = betweenOf(weave(), settingsWith(8));
  EXPECT_GT(eight, 0.02);
  EXPECT_LT(betweenOf(weave(), settingsWith(16)), 0.7 * eight);
  EXPECT_LT(betweenOf(weave(0.25f), settingsWith(8)), 0.6 * eight);
}

}  // namespace
}  // namespace prt
