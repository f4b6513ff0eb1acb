#include "libprt/meso/patch_generate.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

TEST(PatchGenerate, HeightsCloseUpAndHaveTheirDepth) {
  for (const std::string& name : heightGeneratorNames())
    for (const int count : {0, 3, 4}) {
      HeightOptions options;
      options.name = name, options.depth = 0.25f, options.count = count;
      const HeightGrid grid = generateHeights(options);
      const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
      EXPECT_FLOAT_EQ(*low, 0);
      EXPECT_NEAR(*high, 0.25f, 1e-6);
      // Where the cell closes, heights step no more than they do inside.
      float inside = 0, seam = 0;
      for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
          const float step = std::max(std::abs(grid.at(i + 1, j) - grid.at(i, j)),
                                      std::abs(grid.at(i, j + 1) - grid.at(i, j)));
          float& most = i == grid.columns - 1 || j == grid.rows - 1 ? seam : inside;
          most = std::max(most, step);
        }
      EXPECT_LE(seam, 1.01f * inside) << name << " " << count;
    }
}

TEST(PatchGenerate, NoiseRepeats) {
  for (const Vec2 uv : {Vec2(0.13f, 0.71f), Vec2(0.999f, 0.002f)}) {
    EXPECT_NEAR(periodicNoise(uv, 5, 1), periodicNoise(uv + Vec2(1, 0), 5, 1), 1e-4);
    EXPECT_NEAR(periodicNoise(uv, 5, 1), periodicNoise(uv - Vec2(2, 3), 5, 1), 1e-4);
    EXPECT_NE(periodicNoise(uv, 5, 1), periodicNoise(uv, 5, 2));
  }
  EXPECT_NEAR(periodicNoise(Vec2(0), 4, 1), 0, 1e-6);
}

TEST(PatchGenerate, TexturesAreColours) {
  for (const std::string& name : textureGeneratorNames()) {
    const Image image = generateTexture(name, 64);
    EXPECT_EQ(image.pixels(), 64u * 64u);
    for (const float x : image.data) EXPECT_TRUE(x >= 0 && x <= 1);
  }
  const Image checker = generateTexture("checker", 8);
  EXPECT_GT(checker.rgb(1, 6).x, 3 * checker.rgb(1, 6).y);  // bottom left: (u, v) = (0, 0)
}

TEST(PatchGenerate, RefusesUnknownNamesAndValues) {
  HeightOptions options;
  options.name = "stuco";
  try {
    generateHeights(options);
    FAIL();
  } catch (const ValueError& error) {
    EXPECT_NE(std::string(error.what()).find("bins, holes, ripples, scales, stucco"), std::string::npos);
  }
  options = {};
  options.depth = 3;
  EXPECT_THROW(generateHeights(options), ValueError);
  options = {};
  options.grid = 4;
  EXPECT_THROW(generateHeights(options), ValueError);
  EXPECT_THROW(generateTexture("rose"), ValueError);
}

}  // namespace
}  // namespace prt
