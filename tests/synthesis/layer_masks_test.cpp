#include "libprt/synthesis/layer_masks.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/synthesis/orientation_field.h"
#include "tests/synthesis/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using namespace test;

MesoMesh mesoOf(Ready& ready, std::size_t vertices = 4000) {
  return makeMesoMesh(ready.mesh, ready.sheets, {.vertices = vertices, .coarsest = 30}, ready.job);
}

TEST(LayerMask, IsFullInTheMiddleAndGoneAtTheRim) {
  Ready ready(makePlane({.columns = 4, .rows = 4}));
  const MesoMesh meso = mesoOf(ready);
  const LayerSpot spot{{0.1f, 0, 0}, 0.2f, 0.75f};
  const LayerMask mask(meso, std::span(&spot, 1));
  const Vec3 up(0, 1, 0);
  for (const float part : {0.0f, 0.25f, 0.49f})
    EXPECT_FLOAT_EQ(mask.at({0.1f + 0.2f * part, 0, 0}, up), 0.75f);
  EXPECT_NEAR(mask.at({0.25f, 0, 0}, up), 0.375f, 1e-5f) << "half of it in the middle of the rim";
  EXPECT_LT(mask.at({0.295f, 0, 0}, up), 0.01f);
  EXPECT_EQ(mask.at({0.3001f, 0, 0}, up), 0);
  EXPECT_EQ(mask.at({-5, 3, 0}, up), 0);
}

TEST(LayerMask, StaysOnItsSideOfAThinSheet) {
  Ready ready(twoSheets(0.01f, false));
  MesoMesh meso = mesoOf(ready);
  for (std::size_t i = 0; i < meso.vertexCount(); ++i)  // the lower one faces down: a plate
    if (meso.positions[i].y < 0.005f) meso.normals[i] = {0, -1, 0};
  const LayerSpot spot{{0.5f, 0.01f, 0.5f}, 0.3f, 1};
  const LayerMask mask(meso, std::span(&spot, 1));
  EXPECT_EQ(mask.at({0.5f, 0.01f, 0.5f}, {0, 1, 0}), 1);
  EXPECT_EQ(mask.at({0.5f, 0, 0.5f}, {0, -1, 0}), 0);
}

/// All spots, one by one.
float slowMask(std::span<const LayerSpot> spots, const Vec3& p) {
  float mask = 0;
  for (const LayerSpot& s : spots) {
    const double d = distance(DVec3(p), DVec3(s.centre)) / double(s.radius);
    if (d >= 1) continue;
    const double x = std::min(1.0, 2 * (1 - d));
    mask = std::max(mask, float(double(s.strength) * x * x * (3 - 2 * x)));
  }
  return mask;
}

TEST(LayerMask, AreTheStrongestOfAllSpots) {
  Ready ready(makePlane({.columns = 4, .rows = 4}));
  const MesoMesh meso = mesoOf(ready);
  std::vector<LayerSpot> spots;
  for (std::uint64_t i = 0; i < 60; ++i)
    spots.push_back({{hashUniform(1, i, 0) - 0.5f, 0, hashUniform(1, i, 1) - 0.5f},
                     0.01f + 0.15f * hashUniform(1, i, 2),
                     hashUniform(1, i, 3)});
  const LayerMask mask(meso, spots);
  int covered = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Vec3 p(1.4f * (hashUniform(2, i, 0) - 0.5f), 0, 1.4f * (hashUniform(2, i, 1) - 0.5f));
    const float expected = slowMask(spots, p);
    covered += expected > 0;
    ASSERT_NEAR(mask.at(p, {0, 1, 0}), expected, 1e-4f);
  }
  EXPECT_GT(covered, 500);
}

TEST(LayerWeights, UpperLayersCoverLowerOnes) {
  Ready ready(makePlane({.columns = 4, .rows = 4}));
  const MesoMesh meso = mesoOf(ready);
  const LayerSpot low{{0, 0, 0}, 0.8f, 0.5f}, high{{0, 0, 0}, 0.4f, 1};
  std::vector<LayerMask> masks;
  masks.emplace_back(meso, std::span(&low, 1));
  masks.emplace_back(meso, std::span(&high, 1));
  const auto at = [&](float x) {
    std::array<float, 3> out;
    layerWeights(masks, {x, 0, 0}, {0, 1, 0}, out);
    return out;
  };
  EXPECT_EQ(at(0.1f), (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(at(0.4f), (std::array<float, 3>{0.5f, 0.5f, 0}));
  EXPECT_EQ(at(0.9f), (std::array<float, 3>{1, 0, 0}));
  Job job;
  const std::vector<float> all = vertexLayerWeights(meso, masks, job);
  ASSERT_EQ(all.size(), 3 * meso.vertexCount());
  for (std::size_t i = 0; i < all.size(); i += 3) ASSERT_NEAR(all[i] + all[i + 1] + all[i + 2], 1, 1e-6f);
  EXPECT_TRUE(vertexLayerWeights(meso, {}, job).empty());
}

TEST(LayerWeights, OfTheIdMapAreBytesThatNeverAddUpToMoreThanAll) {
  Ready ready(makePlane({.columns = 4, .rows = 4}));
  const MesoMesh meso = mesoOf(ready);
  const std::vector<LayerSpot> spots{{{0, 0, 0}, 0.5f, 0.501f}, {{0.2f, 0, 0}, 0.5f, 0.333f}};
  std::vector<LayerMask> masks;
  for (int k = 0; k < kMostLayers; ++k) masks.emplace_back(meso, spots);
  IdMap map;
  map.size = 32;
  TexelSurface texels;
  for (int i = 0; i < 32 * 32; ++i) {
    const bool empty = i % 7 == 0;
    for (int c = 0; c < 2; ++c) map.ids.push_back(empty ? IdMap::kEmpty : std::uint16_t(5));
    texels.position.push_back({float(i % 32) / 32 - 0.5f, 0, float(i / 32) / 32 - 0.5f});
    texels.normal.push_back({0, 1, 0});
  }
  Job job;
  addLayers(map, texels, masks, job);
  ASSERT_EQ(map.layers, kMostLayers);
  ASSERT_EQ(map.weights.size(), 32u * 32 * 3);
  std::array<float, 4> exact;
  for (std::size_t i = 0; i < 32 * 32; ++i) {
    layerWeights(masks, texels.position[i], texels.normal[i], exact);
    int sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int w = map.weights[3 * i + k];
      sum += w;
      ASSERT_NEAR(float(w) / 255, map.empty(i) ? 0 : exact[k + 1], 2.0f / 255);
    }
    ASSERT_LE(sum, 255);
  }
  masks.emplace_back(meso, spots);
  EXPECT_THROW(addLayers(map, texels, masks, job), ValueError);
  EXPECT_THROW(vertexLayerWeights(meso, masks, job), ValueError);
}

}  // namespace
}  // namespace prt
