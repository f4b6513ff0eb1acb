#include "libprt/basis/sh_zonal.h"
#include "libprt/basis/legendre.h"
#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "tests/basis/sh_test_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace prt {
namespace {

using test::evaluateSh;
using test::randomDirection;

/// 2 pi * integral of kernel(t) P_l(t) over [from, 1], by brute force.
double bandFactor(int l, const std::function<double(double)>& kernel, double from) {
  const IntervalRule rule = gaussLegendre(200);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = from + 0.5 * (1 - from) * (1 + rule.nodes[i]);
    sum += 0.5 * (1 - from) * rule.weights[i] * kernel(t) * LegendreTable(l + 1, t).value[l];
  }
  return 2 * kPi * sum;
}

TEST(ShZonal, LegendreEqualsTheStandardLibrary) {
  for (double t : {-1.0, -0.7, 0.0, 0.3, 1.0}) {
    const LegendreTable p(30, t);
    for (int l = 0; l < 30; ++l) {
      EXPECT_NEAR(p.value[l], std::legendre(l, t), 1e-14);
      // (1 - t^2) P_l' = l (P_{l-1} - t P_l)
      if (l > 0) {
        EXPECT_NEAR((1 - t * t) * p.slope[l], l * (p.value[l - 1] - t * p.value[l]), 1e-12);
      }
    }
    if (t == 1) {
      EXPECT_NEAR(p.slope[7], 28, 1e-13) << "l (l+1) / 2 at the pole";
    }
  }
}

TEST(ShZonal, ClampedCosineHasItsKnownFactors) {
  const std::vector<double> a = clampedCosineFactors(9);
  const double expected[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64};
  for (int l = 0; l < 7; ++l) EXPECT_NEAR(a[l], expected[l], 1e-15);
  // The closed form for even l: 2 pi (-1)^(l/2-1) / ((l+2)(l-1)) * l! / (2^l ((l/2)!)^2).
  EXPECT_NEAR(a[8], -2 * kPi / (10 * 7) * std::tgamma(9.0) / (256 * std::pow(std::tgamma(5.0), 2)), 1e-15);
}

TEST(ShZonal, TruncatedCosineLosesWhatItMust) {
  // Relative L2 error: 8.84 % with 3 or 4 bands, 4.42 % with 5 or 6, 2.76 % with 7 or 8.
  const std::vector<double> z = zonalFromFactors(clampedCosineFactors(9));
  const double norm = 2 * kPi / 3;  // integral of the squared clamped cosine
  double kept = 0;
  const double expected[] = {1, 1, 0.0884, 0.0884, 0.0442, 0.0442, 0.0276, 0.0276};
  for (int l = 0; l < 8; ++l) {
    kept += z[l] * z[l];
    if (l >= 2) {
      EXPECT_NEAR(std::sqrt(1 - kept / norm), expected[l], 1e-4) << l + 1 << " bands";
    }
  }
}

TEST(ShZonal, IrradianceOfLambertIsItsKnownVector) {
  // Exit radiance of a white Lambert surface: A_l sqrt((2l+1)/4pi) / pi.
  const std::vector<double> z = zonalFromFactors(clampedCosineFactors(5));
  const double expected[] = {0.282095, 0.325735, 0.157696, 0, -0.035262};
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(z[l] / kPi, expected[l], 1e-6);
}

TEST(ShZonal, PhongFactorsEqualTheIntegral) {
  for (double s : {0.0, 1.0, 2.5, 16.0, 37.3, 256.0}) {
    const std::vector<double> k = phongFactors(20, s);
    for (int l = 0; l < 20; ++l)
      EXPECT_NEAR(k[l],
                  bandFactor(
                      l, [s](double t) { return std::pow(t, s); }, 0),
                  1e-6 * k[0])
          << s << ", l = " << l;
  }
}

TEST(ShZonal, PhongNeedsTheBandsItIsSaidToNeed) {
  for (const auto& [exponent, bands] : {std::pair(4, 5), {8, 7}, {16, 9}, {32, 13}, {64, 18}, {256, 35}}) {
    const std::vector<double> z = zonalFromFactors(phongFactors(60, exponent));
    const double norm = 2 * kPi / (2 * exponent + 1);
    double kept = 0;
    int needed = 0;
    while (std::sqrt(std::max(0.0, 1 - kept / norm)) > 0.1) kept += z[needed] * z[needed], ++needed;
    EXPECT_EQ(needed, bands) << "exponent " << exponent;
  }
}

TEST(ShZonal, CapsHaveTheirGoldenCoefficients) {
  const std::vector<double> circle = capZonal(5, radians(55)), half = capZonal(9, kPi / 2),
                            whole = capZonal(5, kPi);
  const double golden55[] = {0.75582, 1.02999, 0.76269, 0.25368, -0.17832};
  const double goldenHalf[] = {1.772454, 1.534990, 0, -0.586184, 0, 0.367410, 0, -0.268152, 0};
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(circle[l], golden55[l], 5e-6);
  for (int l = 0; l < 9; ++l) EXPECT_NEAR(half[l], goldenHalf[l], 5e-7);
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(whole[l], l == 0 ? std::sqrt(4 * kPi) : 0, 1e-15);
}

TEST(ShZonal, CapsEqualTheDifferenceFormulaAndTheIntegral) {
  for (double degrees : {2.0, 20.0, 55.0, 120.0, 179.0}) {
    const double a = radians(degrees), c = std::cos(a);
    const std::vector<double> z = capZonal(12, a);
    const LegendreTable p(13, c);
    for (int l = 1; l < 12; ++l) {
      EXPECT_NEAR(z[l], std::sqrt(kPi / (2 * l + 1)) * (p.value[l - 1] - p.value[l + 1]), 1e-14);
      EXPECT_NEAR(z[l],
                  std::sqrt((2 * l + 1) / (4 * kPi)) * bandFactor(
                                                           l, [](double) { return 1.0; }, c),
                  1e-13);
    }
  }
}

TEST(ShZonal, TinyCapsEqualTheSeriesForSmallAngles) {
  // z_l = solid angle * sqrt((2l+1)/4pi) (1 - l(l+1) a^2 / 8 + ...).
  for (double degrees : {0.2665, 1e-2, 1e-4, 1e-6}) {
    const double a = radians(degrees), omega = 4 * kPi * std::pow(std::sin(a / 2), 2);
    const std::vector<double> z = capZonal(9, a);
    for (int l = 0; l < 9; ++l) {
      const double series = omega * std::sqrt((2 * l + 1) / (4 * kPi)) * (1 - l * (l + 1) * a * a / 8);
      EXPECT_NEAR(z[l] / series, 1, 2e-8) << degrees << " degrees, l = " << l;
    }
  }
  EXPECT_NEAR(capZonal(1, radians(0.2665))[0] * std::sqrt(4 * kPi), 6.7967e-5, 1e-9)
      << "the sun's solid angle";
  EXPECT_EQ(capZonal(3, 0)[2], 0);
}

TEST(ShZonal, RotatedZonalEqualsTheGeneralRotation) {
  std::mt19937 random(1);
  const std::vector<double> zonal = capZonal(6, 0.8);
  for (int i = 0; i < 10; ++i) {
    const DVec3 d = randomDirection(random);
    const DVec3 side = normalize(cross(d, DVec3(0.3, -0.9, 0.2))), up = cross(d, side);
    std::vector<double> about(shCount(6), 0.0), turned(shCount(6));
    for (int l = 0; l < 6; ++l) about[shIndex(l, 0)] = zonal[l];
    ShRotation(6, glm::dmat3(side, up, d)).apply(std::span<const double>(about), turned);
    const std::vector<double> direct = rotateZonal(zonal, d);
    for (int k = 0; k < shCount(6); ++k) EXPECT_NEAR(direct[k], turned[k], 1e-13);
  }
}

TEST(ShZonal, ConvolutionEqualsItsIntegral) {
  // Irradiance in direction n of a light of 4 bands: sum over directions of light times clamped cosine.
  std::mt19937 random(2);
  const std::vector<double> light = test::randomVector(shCount(4), random);
  std::vector<double> convolved = light;
  scaleBands(clampedCosineFactors(4), 4, std::span(convolved));
  const DVec3 n = randomDirection(random);
  const DVec3 side = normalize(cross(n, DVec3(0.1, 0.2, 0.97))), up = cross(n, side);
  const SphereRule rule = hemisphereRule(4);  // 3 for the light, 1 for the cosine
  double integral = 0;
  for (std::size_t s = 0; s < rule.weights.size(); ++s) {
    const DVec3& local = rule.directions[s];
    const std::vector<double> y = evaluateSh(4, side * local.x + up * local.y + n * local.z);
    for (int k = 0; k < shCount(4); ++k) integral += rule.weights[s] * local.z * light[k] * y[k];
  }
  const std::vector<double> y = evaluateSh(4, n);
  double value = 0;
  for (int k = 0; k < shCount(4); ++k) value += convolved[k] * y[k];
  EXPECT_NEAR(value, integral, 1e-13);
}

TEST(ShZonal, ScalingTreatsAllContainersAlikeAndDropsMissingBands) {
  ShRgb light(3);
  std::vector<float> floats(9);
  for (int k = 0; k < 9; ++k) light.c[k] = Rgb(floats[k] = float(k + 1));
  const std::vector<double> factors{2, 3};
  scaleBands(factors, light);
  scaleBands(factors, 3, std::span(floats));
  const float expected[] = {2, 6, 9, 12, 0, 0, 0, 0, 0};
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(light.c[k], Rgb(expected[k]));
    EXPECT_EQ(floats[k], expected[k]);
  }
}

TEST(ShZonal, BadParametersAreErrors) {
  EXPECT_THROW(phongFactors(5, -1), ValueError);
  EXPECT_THROW(phongFactors(5, std::numeric_limits<double>::quiet_NaN()), ValueError);
  EXPECT_THROW(capZonal(5, -0.1), ValueError);
  EXPECT_THROW(capZonal(5, 3.2), ValueError);
  EXPECT_THROW(capZonal(0, 1), ValueError);
  EXPECT_THROW(clampedCosineFactors(kMaxShBands + 1), ValueError);
}

}  // namespace
}  // namespace prt
