#include "libprt/shade/metrics.h"
#include "libprt/core/error.h"
#include "libprt/shade/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace prt {
namespace {

Image filled(int width, int height, std::initializer_list<float> pixel) {
  Image image(width, height, int(pixel.size()));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = *(pixel.begin() + i % pixel.size());
  return image;
}

TEST(Metrics, KnownErrors) {
  Image a = filled(4, 2, {1, 2, 2}), r = filled(4, 2, {1, 2, 2});
  a.pixel(1, 1)[2] = 5;
  const ImageErrors e = compareImages(a, r);
  EXPECT_EQ(e.pixels, 8u);
  EXPECT_NEAR(e.rmse, std::sqrt(9.0 / 24), 1e-12);
  EXPECT_NEAR(e.relativeRmse, std::sqrt(9.0 / (8 * 9)), 1e-12);
  EXPECT_EQ(e.maximum, 3);
  EXPECT_EQ(e.percentile95, 0);  // one value of 24 is off: fewer than 5 %
}

TEST(Metrics, PercentileIsRelativeWithAFloor) {
  const Image a = filled(10, 10, {1.1f}), r = filled(10, 10, {1.0f});
  EXPECT_NEAR(compareImages(a, r).percentile95, 0.1 / 1.01, 1e-6);
}

TEST(Metrics, PercentileIgnoresTheRarestFivePercent) {
  Image a = filled(100, 1, {1.0f}), r = a;
  for (int x = 0; x < 4; ++x) a.data[std::size_t(x)] = 9;
  EXPECT_EQ(compareImages(a, r).percentile95, 0);
  for (int x = 0; x < 7; ++x) a.data[std::size_t(x)] = 9;
  EXPECT_GT(compareImages(a, r).percentile95, 5);
}

TEST(Metrics, OnlyCountedPixelsMatter) {
  Image a = filled(2, 1, {1, 1, 1, 1}), r = filled(2, 1, {1, 1, 1, 1});
  a.pixel(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  a.pixel(1, 0)[3] = 0.5f;
  EXPECT_THROW(compareImages(a, r), ValueError);
  EXPECT_EQ(compareImages(a, r, coveredPixels(a)).rmse, 0);
  EXPECT_EQ(compareImages(a, r, bothMasks(coveredPixels(r), coveredPixels(a))).pixels, 1u);
  EXPECT_THROW(compareImages(a, r, PixelMask(2, 0)), ValueError);
}

TEST(Metrics, BlackReferences) {
  const Image black(3, 3, 3), grey = filled(3, 3, {0.5f, 0.5f, 0.5f});
  EXPECT_EQ(compareImages(black, black).relativeRmse, 0);
  EXPECT_TRUE(std::isinf(compareImages(grey, black).relativeRmse));
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(compareImages(Image(2, 2, 3), Image(2, 3, 3)), ValueError);
  EXPECT_THROW(compareImages(Image(2, 2, 3), Image(2, 2, 1)), ValueError);
  EXPECT_THROW(compareImages(Image(2, 2, 3), Image(2, 2, 3), PixelMask(3, 1)), ValueError);
  EXPECT_THROW(noiseFreeError(std::vector<float>(3), std::vector<float>(3), std::vector<float>(2), 1),
               ValueError);
  EXPECT_THROW(noiseFreeError(std::vector<float>(3), std::vector<float>(3), std::vector<float>(3), 5),
               ValueError);
}

/// Images of a known signal: `a` is off by `error` relative RMSE, the references by noise only.
struct Noisy {
  Image a{128, 128, 3}, r1{128, 128, 3}, r2{128, 128, 3};
  Noisy(double error, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
      a.data[i] = float(1 + error * gauss(random));
      r1.data[i] = float(1 + noise * gauss(random));
      r2.data[i] = float(1 + noise * gauss(random));
    }
  }
};

TEST(Metrics, NoiseOfTheReferencesCancels) {
  int inside = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Noisy n(0.01, 0.05, seed);  // five times more noise than error
    EXPECT_GT(compareImages(n.a, n.r1).relativeRmse, 0.04);
    const NoiseFreeError e = noiseFreeError(n.a, n.r1, n.r2);
    EXPECT_NEAR(e.relative(), 0.01, 0.005);
    EXPECT_NEAR(e.signal, 1, 1e-3);
    inside += e.relativeLow() <= 0.01 && 0.01 <= e.relativeHigh();
  }
  EXPECT_GE(inside, 34);  // 95 % of 40 is 38; fewer than 34 has probability below 1 %
  EXPECT_LE(inside, 40);
}

TEST(Metrics, ExactImageHasAnIntervalThatHoldsZero) {
  const NoiseFreeError e = noiseFreeError(Noisy(0, 0.05, 3).a, Noisy(0, 0.05, 3).r1, Noisy(0, 0.05, 3).r2);
  EXPECT_EQ(e.relativeLow(), 0);
  EXPECT_GT(e.relativeHigh(), 0);
  EXPECT_LT(e.relativeHigh(), 0.01);
}

TEST(Metrics, NoiseFreeErrorOfRowsEqualsThatOfImages) {
  const Noisy n(0.02, 0.01, 8);
  const NoiseFreeError image = noiseFreeError(n.a, n.r1, n.r2);
  const NoiseFreeError row = noiseFreeError(n.a.data, n.r1.data, n.r2.data, 768);
  EXPECT_NEAR(image.meanSquare, row.meanSquare, 1e-12);
  EXPECT_NEAR(image.signal, row.signal, 1e-12);
  EXPECT_NEAR(row.standardError / image.standardError, 1, 0.5);
}

TEST(Metrics, HeatMapRisesInLuminance) {
  Image ramp(256, 1, 1);
  for (int i = 0; i < 256; ++i) ramp.data[std::size_t(i)] = float(i) / 255;
  const Image heat = heatMap(ramp, 1);
  float last = -1;
  for (int x = 0; x < 256; ++x) {
    const Rgb c = heat.rgb(x, 0);
    const float y = luminance({decodeSrgb(c.x), decodeSrgb(c.y), decodeSrgb(c.z)});
    EXPECT_GT(y, last) << x;
    last = y;
  }
  EXPECT_LT(luminance(heat.rgb(0, 0)), 0.1f);
  EXPECT_GT(last, 0.75f);
}

TEST(Metrics, HeatMapMarksWhatIsLeftOut) {
  Image values(2, 1, 1);
  values.data = {std::numeric_limits<float>::quiet_NaN(), 3};
  const Image heat = heatMap(values, 1, {1, 0});
  EXPECT_EQ(heat.rgb(1, 0), Rgb(0.5f));
  EXPECT_TRUE(isFinite(heat.rgb(0, 0)));
}

}  // namespace
}  // namespace prt
