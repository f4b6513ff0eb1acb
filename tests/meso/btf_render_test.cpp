// Equation (5) taken literally against the fast bake.

#include "libprt/meso/btf_render.h"

#include "libprt/meso/weave.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using namespace test;

RttSettings settings() {
  RttSettings s = small(8, 3, 1024, 2);
  s.supersamples = 4;
  return s;
}

TEST(BtfRender, FlatPatchIsTheCosine) {
  const PatchScene patch = sceneOf(flatPatch(Rgb(0.6f)));
  Job job;
  const LightSet lights = lightGrid();
  int views = 0;
  renderBtf(patch, small(3, 2), lights, job, [&](const BtfView& view) {
    EXPECT_EQ(view.index, views++);
    for (std::size_t l = 0; l < lights.size(); ++l)
      EXPECT_NEAR(view.picture(l).rgb(1, 1).y, 0.6f / kPiF * lights.directions[l].z, 1e-6);
  });
  EXPECT_EQ(views, 4);
  EXPECT_EQ(job.snapshot().total, 4 * 128);
}

TEST(BtfRender, FlatPatchDiffersByTheQuadraturesErrorExactly) {
  const PatchScene patch = sceneOf(flatPatch(Rgb(0.6f)));
  Job job;
  const Rtt fast = bakeRtt(patch, small(2, 2), job);
  const Rtt literal = bakeRttByImages(patch, small(2, 2), lightGrid(), LightFit::Quadrature, job);
  EXPECT_NEAR(relativeDifference(literal, fast), quadratureError(lightGrid(), 5), 1e-4);
  const Rtt fitted = bakeRttByImages(patch, small(2, 2), lightGrid(), LightFit::Fit, job);
  EXPECT_LT(relativeDifference(fitted, fast), 5e-4);
}

/// ALGORITHMS 6.1: 128 lights leave about 3 % on hard shadows, whichever the rule; more lights leave less.
TEST(BtfRender, AgreesWithTheFastBakeWithinItsQuadrature) {
  const PatchScene bumpy = sceneOf(heightField(bumps(48, 0.25f), Rgb(0.8f)));
  WeaveOptions cloth;
  cloth.yarns = 2, cloth.along = 24, cloth.sides = 24;
  const PatchScene woven = sceneOf(weave(cloth));
  for (const PatchScene* patch : {&bumpy, &woven}) {
    Job job;
    const Rtt fast = bakeRtt(*patch, settings(), job);
    const Rtt grid = bakeRttByImages(*patch, settings(), lightGrid(), LightFit::Quadrature, job);
    const Rtt fitted = bakeRttByImages(*patch, settings(), lightGrid(), LightFit::Fit, job);
    const Rtt finer = bakeRttByImages(*patch, settings(), lightGrid(12, 24), LightFit::Fit, job);
    EXPECT_LT(relativeDifference(grid, fast), 0.031);
    EXPECT_LT(relativeDifference(fitted, fast), 0.025);
    EXPECT_LT(relativeDifference(finer, fast), 0.02);
    EXPECT_LT(relativeDifference(finer, fast), relativeDifference(grid, fast));
  }
}

TEST(BtfRender, GlossGoesTheSameTwoWays) {
  Patch glossy = heightField(bumps(32, 0.15f), Rgb(0.3f));
  glossy.specular = Rgb(0.4f), glossy.exponent = 6;
  RttSettings s = settings();
  s.texels = 8, s.lobeRays = 32;
  const PatchScene patch = sceneOf(glossy);
  Job job;
  const Rtt fast = bakeRtt(patch, s, job);
  const Rtt literal = bakeRttByImages(patch, s, lightGrid(12, 24), LightFit::Fit, job);
  EXPECT_LT(relativeDifference(literal, fast), 0.031);
}

TEST(BtfRender, ColourGoesTheSameTwoWays) {
  Patch patch = heightField(bumps(32, 0.25f), Rgb(0.9f, 0.4f, 0.2f));
  const PatchScene scene = sceneOf(patch);
  Job job;
  const Rtt fast = bakeRtt(scene, settings(), job);
  const Rtt literal = bakeRttByImages(scene, settings(), lightGrid(), LightFit::Fit, job);
  EXPECT_EQ(literal.channels, 3);
  EXPECT_LT(relativeDifference(literal, fast), 0.025);
}

}  // namespace
}  // namespace prt
