#include "libprt/basis/sh_window.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "tests/basis/sh_test_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::evaluateSh;
using test::randomDirection;

/// A directional light from `d`, windowed.
ShRgb deltaLight(int bands, const DVec3& d, std::span<const double> window = {}, const Rgb& colour = Rgb(1)) {
  ShRgb light(bands);
  const std::vector<double> y = evaluateSh(bands, d);
  for (int k = 0; k < shCount(bands); ++k) light.c[k] = float(y[k]) * colour;
  if (!window.empty()) scaleBands(window, light);
  return light;
}

std::vector<float> channel(const ShRgb& light, int index) {
  std::vector<float> c;
  for (const Rgb& value : light.c) c.push_back(value[index]);
  return c;
}

double minimumOf(const ShRgb& light, int index = 0) {
  return findMinimum(light.bands, channel(light, index)).value;
}

/// Lowest value over the peak of a windowed delta.
double undershoot(int bands, std::span<const double> window) {
  const ShRgb light = deltaLight(bands, DVec3(0, 0, 1), window);
  return minimumOf(light) / light.evaluate(Vec3(0, 0, 1)).r;
}

double peak(int bands, std::span<const double> window) {
  return deltaLight(bands, DVec3(0, 0, 1), window).evaluate(Vec3(0, 0, 1)).r / (bands * bands / (4 * kPi));
}

TEST(ShWindow, UnwindowedDeltasRing) {
  EXPECT_NEAR(deltaLight(5, DVec3(0, 0, 1)).evaluate(Vec3(0, 0, 1)).r, 1.989437, 1e-5) << "n^2 / 4pi";
  EXPECT_NEAR(undershoot(3, {}), -0.20, 5e-3);
  EXPECT_NEAR(undershoot(4, {}), -0.25, 5e-3);
  EXPECT_NEAR(undershoot(5, {}), -0.1517, 1e-4);
  EXPECT_NEAR(undershoot(6, {}), -0.17, 5e-3);
}

TEST(ShWindow, HannAndLanczosLeaveSomeOfIt) {
  EXPECT_NEAR(undershoot(5, hannWindow(5)), -0.038, 5e-4);
  EXPECT_NEAR(peak(5, hannWindow(5)), 0.41, 5e-3);
  EXPECT_NEAR(undershoot(5, lanczosWindow(5)), -0.056, 5e-4);
  EXPECT_NEAR(peak(5, lanczosWindow(5)), 0.53, 5e-3);
}

TEST(ShWindow, FejerHasItsKnownFactors) {
  const std::vector<std::vector<double>> expected{{1},
                                                  {1, 1.0 / 3},
                                                  {1, 0.5, 0.3},
                                                  {1, 0.6, 0.4, 0.171429},
                                                  {1, 0.666667, 0.514286, 0.285714, 0.158730},
                                                  {1, 0.714286, 0.571429, 0.380952, 0.238095, 0.108225}};
  for (const std::vector<double>& f : expected) {
    const std::vector<double> window = fejerWindow(int(f.size()));
    for (std::size_t l = 0; l < f.size(); ++l)
      EXPECT_NEAR(window[l], f[l], 1e-6) << f.size() << " bands, l = " << l;
  }
  EXPECT_NEAR(peak(5, fejerWindow(5)), 0.36, 5e-3);
}

TEST(ShWindow, FejerKernelsAreNonNegative) {
  for (int bands : {2, 3, 4, 5, 6, 9, 10, 17, 20})
    EXPECT_GT(undershoot(bands, fejerWindow(bands)), -2e-7 * bands) << bands << " bands";
}

TEST(ShWindow, FejerKernelsAreTheSharpestOnes) {
  // Any non-negative kernel of degree 2K is the square of a polynomial of degree K with integral 1: none has
  // a larger peak.
  std::mt19937 random(1);
  for (int bands : {3, 5, 7}) {
    double largest = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const std::vector<double> q = test::randomVector(bands / 2 + 1, random);
      double integral = 0, atOne = 0;  // q in the Legendre basis
      for (std::size_t l = 0; l < q.size(); ++l)
        integral += 2 * kPi * q[l] * q[l] * 2 / (2.0 * l + 1), atOne += q[l];
      largest = std::max(largest, atOne * atOne / integral);
    }
    const double fejer = peak(bands, fejerWindow(bands)) * bands * bands / (4 * kPi);
    EXPECT_LE(largest, fejer * (1 + 1e-6)) << bands << " bands";
    EXPECT_GT(largest, 0.7 * fejer) << "the random search came nowhere near";
  }
}

TEST(ShWindow, MinimumIsFoundWhereverItIs) {
  std::mt19937 random(2);
  for (int bands : {1, 2, 3, 5, 8}) {
    for (int trial = 0; trial < 5; ++trial) {
      const std::vector<double> v = test::randomVector(shCount(bands), random);
      const std::vector<float> c(v.begin(), v.end());
      const ShMinimum found = findMinimum(bands, c);
      double sampled = 1e9;
      for (int i = 0; i < 20'000; ++i) {
        const std::vector<double> y = evaluateSh(bands, randomDirection(random));
        double value = 0;
        for (int k = 0; k < shCount(bands); ++k) value += c[k] * y[k];
        sampled = std::min(sampled, value);
      }
      EXPECT_LE(found.value, sampled + 1e-9);
      EXPECT_NEAR(found.value, sampled, 0.02) << "far below all samples";
    }
  }
  // 2 bands: minus the length of the linear part, in the opposite direction.
  const ShMinimum linear = findMinimum(2, std::vector<float>{0, 0, 1, 0});
  EXPECT_NEAR(linear.value, -std::sqrt(3 / (4 * kPi)), 1e-9);
  EXPECT_LT(length(linear.direction - DVec3(0, 0, -1)), 1e-4);
}

TEST(ShWindow, DeringRemovesNegativeLightAndKeepsTheMean) {
  std::mt19937 random(3);
  for (int bands : {3, 4, 5, 6, 9}) {
    for (int trial = 0; trial < 4; ++trial) {
      // A dim sky, and two suns of different colours.
      ShRgb light = deltaLight(bands, randomDirection(random), {}, Rgb(5, 4, 3));
      const ShRgb other = deltaLight(bands, randomDirection(random), {}, Rgb(0.1f, 0.3f, 1));
      for (int k = 0; k < shCount(bands); ++k) light.c[k] += other.c[k];
      light.c[0] += Rgb(0.2f * trial);
      const Deringed deringed = dering(light);
      const float scale = light.c[0].r;
      for (int c = 0; c < 3; ++c) EXPECT_GE(minimumOf(deringed.light, c), -1e-5 * scale);
      EXPECT_NEAR(deringed.minimum,
                  std::min({minimumOf(deringed.light, 0), minimumOf(deringed.light, 1),
                            minimumOf(deringed.light, 2)}),
                  1e-5);
      EXPECT_EQ(deringed.light.c[0], light.c[0]);
      EXPECT_TRUE(deringed.blend > 0 && deringed.blend <= 1);
      for (int l = 0; l < bands; ++l)
        EXPECT_NEAR(deringed.window[l], 1 + deringed.blend * (fejerWindow(bands)[l] - 1), 1e-12);
    }
  }
}

TEST(ShWindow, DeringDoesNoMoreThanItMust) {
  const ShRgb sun = deltaLight(5, DVec3(0, 0, 1));
  const Deringed full = dering(sun);
  EXPECT_NEAR(full.blend, 0.9, 0.1);
  EXPECT_NEAR(full.minimum, 0, 1e-5) << "the least blend touches zero";

  ShRgb sky(5);
  sky.c[0] = Rgb(1);
  sky.c[2] = Rgb(0.3f);
  EXPECT_EQ(dering(sky).blend, 0);
  EXPECT_EQ(dering(sky).light.c, sky.c);

  // The same sun under a sky as bright as the undershoot needs half of it, and so on.
  ShRgb both = sun;
  both.c[0] += Rgb(0.15f);
  const Deringed less = dering(both);
  EXPECT_LT(less.blend, full.blend);
  EXPECT_GT(less.light.evaluate(Vec3(0, 0, 1)).r, full.light.evaluate(Vec3(0, 0, 1)).r);
}

TEST(ShWindow, CurvatureWindowsForADeltaLeaveAnEighth) {
  const auto window = [](double lambda) {
    std::vector<double> w;
    for (int l = 0; l < 5; ++l) w.push_back(1 / (1 + lambda * l * l * (l + 1) * (l + 1)));
    return w;
  };
  EXPECT_LT(undershoot(5, window(0.31)), -1e-4);
  EXPECT_GT(undershoot(5, window(0.32)), -1e-4);
  EXPECT_NEAR(peak(5, window(0.317)), 0.118, 1e-3);
}

TEST(ShWindow, SunAndSkyKeepMoreContrastThanACurvatureWindow) {
  // Uniform sky of radiance 1 and a sun of irradiance 50, against the smallest window
  // 1 / (1 + lambda l^2 (l+1)^2) that leaves nothing negative.
  ShRgb light = deltaLight(5, DVec3(0, 0, 1), {}, Rgb(50));
  light.c[0] += Rgb(float(std::sqrt(4 * kPi)));
  const Deringed deringed = dering(light);

  double lambda = 0;
  ShRgb curved = light;
  for (; minimumOf(curved) < 0; lambda += 0.002) {
    std::vector<double> window;
    for (int l = 0; l < 5; ++l) window.push_back(1 / (1 + lambda * l * l * (l + 1) * (l + 1)));
    curved = light;
    scaleBands(window, curved);
  }
  EXPECT_GT(deringed.light.evaluate(Vec3(0, 0, 1)).r, 2.4 * curved.evaluate(Vec3(0, 0, 1)).r);
}

TEST(ShWindow, IrradianceNeedsLessThanRadiance) {
  const ShRgb sun = deltaLight(5, normalize(DVec3(1, 2, 3)));
  const std::vector<double> cosine = clampedCosineFactors(5);
  const Deringed forLight = dering(sun), forDiffuse = dering(sun, cosine);
  EXPECT_LT(forDiffuse.blend, forLight.blend);
  ShRgb irradiance = forDiffuse.light;
  scaleBands(cosine, irradiance);
  EXPECT_GE(minimumOf(irradiance), -1e-6);
  EXPECT_LT(minimumOf(forDiffuse.light), 0) << "radiance itself may stay negative";
}

TEST(ShWindow, LightThatIsNegativeItselfIsReported) {
  ShRgb dark(3);
  dark.c[0] = Rgb(-1);
  dark.c[3] = Rgb(0.5f);
  const Deringed deringed = dering(dark);
  EXPECT_EQ(deringed.blend, 1);
  EXPECT_LT(deringed.minimum, -0.2);
}

TEST(ShWindow, BadBandCountsAreErrors) {
  EXPECT_THROW(hannWindow(0), ValueError);
  EXPECT_THROW(fejerWindow(kMaxShBands + 1), ValueError);
  EXPECT_THROW(dering(ShRgb(kMaxWindowBands + 1)), ValueError);
  EXPECT_THROW(dering(ShRgb()), ValueError);
}

}  // namespace
}  // namespace prt
