#include "libprt/meso/weave.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using namespace test;

/// Least value of the other direction's tubes' implicit function over the surface of the yarns along u: below
/// 1 is inside.
double closestApproach(const WeaveOptions& o) {
  const Patch patch = weave(o);
  const WeaveShape shape = weaveShape(o);
  const double wave = kPi * o.yarns, half = double(o.radius) / o.yarns;
  const std::size_t perYarn = std::size_t(o.sides) * std::size_t(o.yarns * o.along + 1);
  double least = 1e9;
  for (int yarn = 0; yarn < 2 * o.yarns; yarn += 2)
    for (std::size_t i = 0; i < perYarn; ++i) {
      const DVec3 p(patch.mesh.positions[std::size_t(yarn) * perYarn + i]);
      for (int other = 0; other < o.yarns; ++other) {
        const double height = (other % 2 == 0 ? -1 : 1) * shape.wave * std::cos(wave * (p.y - 0.5 / o.yarns));
        const double x = (p.x - (other + 0.5) / o.yarns) / half, z = (p.z - height) / shape.tube;
        least = std::min(least, x * x + z * z);
      }
    }
  return least;
}

TEST(Weave, YarnsNeverMeet) {
  for (const float radius : {0.2f, 0.35f, 0.42f, 0.49f})
    for (const float amplitude : {1.0f, 1.1f, 2.0f}) {
      WeaveOptions options;
      options.radius = radius, options.amplitude = amplitude;
      EXPECT_GE(closestApproach(options), 1 - 1e-4) << radius << " " << amplitude;
    }
  // The least amplitude is the least: wide yarns that wind as ALGORITHMS 6.3 has it cut each other.
  WeaveOptions options;
  options.amplitude = 1;
  EXPECT_LT(closestApproach(options), 1.05);
}

TEST(Weave, FacesOutwards) {
  const Patch patch = weave({});
  for (std::size_t t = 0; t < patch.mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k)
      ASSERT_GT(dot(normalize(patch.mesh.areaNormal(t)), patch.mesh.normals[patch.mesh.triangles[t][k]]),
                0.8);
}

TEST(Weave, HasTheDepthAskedForAndABacking) {
  WeaveOptions options;
  options.depth = 0.2f;
  const Patch patch = weave(options);
  EXPECT_NEAR(patch.depth(), 0.2f, 1e-5);
  EXPECT_NEAR(patch.middle(), 0, 1e-5);
  EXPECT_TRUE(patch.backed);
  EXPECT_LT(patch.mesh.bounds().low.z, patch.low);
  // No view ray gets through.
  const PatchScene scene = sceneOf(patch);
  for (const int view : {0, 5, 27, 63})
    for (int i = 0; i < 1000; ++i)
      ASSERT_TRUE(
          scene.rays->intersect(viewRay(patch, sobol2(std::uint32_t(i), 0, 1), ViewSquare(8).centre(view)))
              .valid());
}

TEST(Weave, WhiteFurnaceGivesOne) {
  WeaveOptions options;
  options.yarns = 2, options.along = 12, options.sides = 16;
  options.weft = options.warp = options.backing = Rgb(1);
  const Rtt rtt = baked(weave(options), small(24, 4, 256, 40));
  expectWhiteFurnace(rtt);
}

TEST(Weave, RefusesWhatIsOutOfRange) {
  const auto with = [](auto change) {
    WeaveOptions o;
    change(o);
    return weave(o);
  };
  EXPECT_THROW(with([](WeaveOptions& o) { o.yarns = 3; }), ValueError);
  EXPECT_THROW(with([](WeaveOptions& o) { o.yarns = 0; }), ValueError);
  EXPECT_THROW(with([](WeaveOptions& o) { o.radius = 0.5f; }), ValueError);
  EXPECT_THROW(with([](WeaveOptions& o) { o.amplitude = 0.9f; }), ValueError);
  EXPECT_THROW(with([](WeaveOptions& o) { o.depth = 0; }), ValueError);
}

}  // namespace
}  // namespace prt
