#include "libprt/atlas/chart_texels.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/generate.h"
#include "tests/support/atlases.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

const Atlas& vase() {
  static const Atlas atlas = test::automaticAtlas(makeVase({.segments = 24, .rings = 32}));
  return atlas;
}

/// Of a point of a triangle, in texels from the centre of the atlas's first one, v up.
DVec2 inTexels(const Atlas& atlas, std::uint32_t t, const Vec2& b, int size) {
  const UVec3& u = atlas.uvTriangles[t];
  const DVec2 a(atlas.uv[u.x]);
  return (a + double(b.x) * (DVec2(atlas.uv[u.y]) - a) + double(b.y) * (DVec2(atlas.uv[u.z]) - a)) *
             double(size) -
         0.5;
}

Vec2 randomPlace(std::uint64_t i) {
  const float root = std::sqrt(hashUniform(3, i, 1)), turn = hashUniform(3, i, 2);
  return {root * (1 - turn), root * turn};
}

// Whatever the size: what is interpolated comes from texels of the point's own chart, near to the point.
TEST(ChartTexels, EveryPointLiesBetweenTexelsOfItsOwnChart) {
  Job job;
  for (const int size : {4, 17, 64, 300}) {
    const ChartTexels texels = makeChartTexels(vase(), size, job);
    const TexelGrid& grid = *texels.grid;
    ASSERT_EQ(texels.triangle.size(), grid.count);
    for (std::uint32_t t = 0; t < vase().triangleCount(); ++t)
      for (std::uint64_t k = 0; k < 12; ++k) {
        const Vec2 b = k == 0   ? Vec2(0)
                       : k == 1 ? Vec2(1, 0)
                       : k == 2 ? Vec2(0, 1)
                       : k == 3 ? Vec2(0.5f)
                                : randomPlace(16 * t + k);
        const TexelPlace place = grid.at(t, b);
        const DVec2 p = inTexels(vase(), t, b, size);
        float sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          sum += place.weight[i];
          ASSERT_GE(place.weight[i], 0);
          const std::uint32_t texel = place.texel[i];
          ASSERT_LT(texel, grid.count);
          ASSERT_EQ(vase().chartOf[texels.triangle[texel]], vase().chartOf[t]);
          // The point that a texel shows is no farther away than its centre and what lies beyond the rim.
          const DVec2 shown = inTexels(vase(), texels.triangle[texel], texels.barycentric[texel], size);
          ASSERT_LT(glm::distance(p, shown), 2 * std::sqrt(2.0) + 0.02) << size << " " << t << " " << k;
        }
        ASSERT_NEAR(sum, 1, 1e-5);
      }
  }
}

// Inside of a chart interpolation is exact for what is linear in the texture.
TEST(ChartTexels, LinearFunctionsAreInterpolatedExactlyAwayFromTheRim) {
  Job job;
  constexpr int kSize = 200;
  const ChartTexels texels = makeChartTexels(vase(), kSize, job);
  std::size_t exact = 0, all = 0;
  double worst = 0;
  for (std::uint32_t t = 0; t < vase().triangleCount(); ++t)
    for (std::uint64_t k = 0; k < 4; ++k, ++all) {
      const Vec2 b = randomPlace(8 * t + k);
      const TexelPlace place = texels.grid->at(t, b);
      DVec2 mean(0);
      for (std::size_t i = 0; i < 4; ++i)
        mean += double(place.weight[i]) *
                inTexels(vase(), texels.triangle[place.texel[i]], texels.barycentric[place.texel[i]], kSize);
      const double off = glm::distance(mean, inTexels(vase(), t, b, kSize));
      exact += off < 1e-3;
      worst = std::max(worst, off);
    }
  EXPECT_GT(double(exact), 0.85 * double(all));
  EXPECT_LT(worst, 1.5);
}

// A square alone in its atlas: texels inside of it, and one ring around.
TEST(ChartTexels, TakesOneRingBeyondTheRim) {
  Atlas atlas;
  atlas.uv = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.75f, 0.75f}, {0.25f, 0.75f}};
  atlas.uvTriangles = {{0, 1, 2}, {0, 2, 3}};
  atlas.chartOf = {0, 0};
  atlas.chartCount = 1;
  Job job;
  const ChartTexels texels = makeChartTexels(atlas, 16, job);
  EXPECT_EQ(texels.grid->count, 10u * 10u);  // 8 inside
  for (std::size_t i = 0; i < texels.triangle.size(); ++i) {
    const Vec2 b = texels.barycentric[i];
    EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1 + 1e-6f);
  }
}

TEST(ChartTexels, DoNotDependOnThreads) {
  Job job;
  setThreadCount(1);
  const ChartTexels one = makeChartTexels(vase(), 64, job);
  setThreadCount(3);
  const ChartTexels three = makeChartTexels(vase(), 64, job);
  setThreadCount(0);
  EXPECT_EQ(one.triangle, three.triangle);
  EXPECT_EQ(one.barycentric, three.barycentric);
  EXPECT_EQ(one.grid->texels, three.grid->texels);
}

TEST(ChartTexels, RefusesSizesAndEndsWhenCancelled) {
  Job job;
  EXPECT_THROW(makeChartTexels(vase(), 2, job), ValueError);
  EXPECT_THROW(makeChartTexels(vase(), 20000, job), ValueError);
  job.cancel();
  EXPECT_THROW(makeChartTexels(vase(), 256, job), Cancelled);
}

}  // namespace
}  // namespace prt
