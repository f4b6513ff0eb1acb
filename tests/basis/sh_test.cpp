#include "libprt/basis/sh.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace prt {
namespace {

DVec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalize(DVec3(normal(random), normal(random), normal(random)));
}

std::vector<double> evaluate(int bands, const DVec3& d) {
  std::vector<double> y(shCount(bands));
  shEvaluate(bands, d, std::span(y));
  return y;
}

std::vector<float> evaluate(int bands, const Vec3& d) {
  std::vector<float> y(shCount(bands));
  shEvaluate(bands, d, std::span(y));
  return y;
}

/// The textbook formula, through the standard library's associated Legendre functions.
std::vector<double> evaluateSlowly(int bands, const DVec3& d) {
  const double theta = std::acos(d.z), phi = std::atan2(d.y, d.x);
  std::vector<double> y(shCount(bands));
  for (int l = 0; l < bands; ++l) {
    y[shIndex(l, 0)] = std::sph_legendre(l, 0, theta);
    for (int m = 1; m <= l; ++m) {
      const double q = (m % 2 ? -1 : 1) * std::sqrt(2.0) * std::sph_legendre(l, m, theta);
      y[shIndex(l, m)] = q * std::cos(m * phi);
      y[shIndex(l, -m)] = q * std::sin(m * phi);
    }
  }
  return y;
}

TEST(Sh, FirstFunctionsAreTheConstantAndTheAxesYZX) {
  const double c = std::sqrt(3 / (4 * kPi));
  const DVec3 d = normalize(DVec3(0.3, -0.5, 0.7));
  const std::vector<double> y = evaluate(2, d);
  EXPECT_NEAR(y[0], 0.28209479177387814, 1e-16);
  EXPECT_NEAR(y[1], c * d.y, 1e-16);
  EXPECT_NEAR(y[2], c * d.z, 1e-16);
  EXPECT_NEAR(y[3], c * d.x, 1e-16);
}

TEST(Sh, EqualsTheTextbookFormula) {
  std::mt19937 random(1);
  for (int bands : {1, 2, 3, 4, 5, 6, 7, 9, 20}) {
    for (int i = 0; i < 50; ++i) {
      const DVec3 d = randomDirection(random);
      const std::vector<double> y = evaluate(bands, d), slow = evaluateSlowly(bands, d);
      for (int k = 0; k < shCount(bands); ++k)
        EXPECT_NEAR(y[k], slow[k], 1e-12) << bands << " bands, k = " << k;
    }
  }
}

TEST(Sh, AdditionTheoremHoldsInEveryBand) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> y = evaluate(kMaxShBands, randomDirection(random));
    for (int l = 0; l < kMaxShBands; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += y[shIndex(l, m)] * y[shIndex(l, m)];
      EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi), 1e-12) << "l = " << l;
    }
  }
}

TEST(Sh, PolesAndAxesAreFiniteAndKeepTheAdditionTheorem) {
  for (const Vec3 d :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1e-30f, 1e-38f, 1)}) {
    double sum = 0;
    for (float y : evaluate(kMaxShBands, d)) sum += double(y) * y;
    EXPECT_NEAR(sum, shCount(kMaxShBands) / (4 * kPi), 2e-3);
  }
}

/// Largest |<Y_i, Y_j> - delta_ij| under a rule exact for such products.
double gramError(int bands) {
  const SphereRule rule = sphereRule(2 * bands - 2);
  const int n2 = shCount(bands);
  std::vector<double> gram(std::size_t(n2) * n2, 0.0);
  for (std::size_t s = 0; s < rule.directions.size(); ++s) {
    const std::vector<double> y = evaluate(bands, rule.directions[s]);
    for (int i = 0; i < n2; ++i)
      for (int j = 0; j <= i; ++j) gram[std::size_t(i) * n2 + j] += rule.weights[s] * y[i] * y[j];
  }
  double error = 0;
  for (int i = 0; i < n2; ++i)
    for (int j = 0; j <= i; ++j) error = std::max(error, std::abs(gram[std::size_t(i) * n2 + j] - (i == j)));
  return error;
}

TEST(Sh, IsOrthonormal) {
  for (int bands : {1, 3, 5, 6, 10, 17}) EXPECT_LT(gramError(bands), 2e-14) << bands << " bands";
}

TEST(Sh, IsOrthonormalAtTheMostBandsToo) {
  // All of the 4225 x 4225 products would take minutes: a stride that is coprime to the row lengths
  // keeps functions of every band and order.
  const SphereRule rule = sphereRule(2 * kMaxShBands - 2);
  std::vector<int> chosen;
  for (int k = 0; k < shCount(kMaxShBands); k += 37) chosen.push_back(k);
  std::vector<double> gram(chosen.size() * chosen.size(), 0.0);
  for (std::size_t s = 0; s < rule.directions.size(); ++s) {
    const std::vector<double> y = evaluate(kMaxShBands, rule.directions[s]);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t j = 0; j < chosen.size(); ++j)
        gram[i * chosen.size() + j] += rule.weights[s] * y[chosen[i]] * y[chosen[j]];
  }
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t j = 0; j < chosen.size(); ++j) EXPECT_NEAR(gram[i * chosen.size() + j], i == j, 1e-13);
}

/// Largest error of float evaluation over random directions. A direction rounded to float is not exactly
/// unit: either that counts (the twin evaluates the direction that was meant) or not.
double largestFloatError(int bands, bool batch, bool countRounding) {
  std::mt19937 random(3);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 d(randomDirection(random));
    const std::vector<double> exact = evaluate(bands, countRounding ? normalize(DVec3(d)) : DVec3(d));
    std::vector<float> y(shCount(bands));
    if (batch)
      shEvaluateBatch(bands, std::span(&d.x, 1), std::span(&d.y, 1), std::span(&d.z, 1), y);
    else
      shEvaluate(bands, d, std::span(y));
    for (int k = 0; k < shCount(bands); ++k) worst = std::max(worst, std::abs(y[k] - exact[k]));
  }
  return worst;
}

TEST(Sh, FloatErrorStaysWithinItsBounds) {
  for (bool batch : {false, true}) {
    EXPECT_LT(largestFloatError(5, batch, false), 4.5e-7);
    EXPECT_LT(largestFloatError(17, batch, false), 3.5e-6);
    EXPECT_LT(largestFloatError(33, batch, false), 1.3e-5);
    EXPECT_LT(largestFloatError(65, batch, false), 5e-5);
    EXPECT_LT(largestFloatError(5, batch, true), 5e-7);
    EXPECT_LT(largestFloatError(17, batch, true), 1e-5);
    EXPECT_LT(largestFloatError(33, batch, true), 3.5e-5);
    EXPECT_LT(largestFloatError(65, batch, true), 1.4e-4);
  }
}

struct Directions {
  std::vector<float> x, y, z;
  explicit Directions(int count) {
    std::mt19937 random(4);
    for (int i = 0; i < count; ++i) {
      const Vec3 d(randomDirection(random));
      x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
    }
  }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

TEST(Sh, BatchEqualsOneByOne) {
  const Directions d(29);  // not a multiple of the SIMD width
  for (int bands = 1; bands <= 12; ++bands) {
    std::vector<float> out(d.x.size() * shCount(bands) + 1, -7.0f);
    shEvaluateBatch(bands, d.x, d.y, d.z, std::span(out).first(out.size() - 1));
    for (std::size_t i = 0; i < d.x.size(); ++i) {
      const std::vector<float> y = evaluate(bands, d[i]);
      for (int k = 0; k < shCount(bands); ++k) EXPECT_NEAR(out[i * shCount(bands) + k], y[k], 1e-6);
    }
    EXPECT_EQ(out.back(), -7.0f) << "wrote beyond the end";
  }
}

TEST(Sh, AccumulateIsTheWeightedSum) {
  const Directions d(101);
  std::mt19937 random(5);
  std::vector<float> weights(d.x.size());
  for (float& w : weights) w = std::uniform_real_distribution<float>(-1, 1)(random);
  for (int bands : {1, 4, 5, 9}) {
    std::vector<float> sum(shCount(bands), 10.0f);
    shAccumulate(bands, d.x, d.y, d.z, weights, sum);
    std::vector<double> slow(shCount(bands), 10.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
      const std::vector<double> y = evaluate(bands, DVec3(d[i]));
      for (int k = 0; k < shCount(bands); ++k) slow[k] += weights[i] * y[k];
    }
    for (int k = 0; k < shCount(bands); ++k) EXPECT_NEAR(sum[k], slow[k], 2e-5);
  }
}

TEST(Sh, RgbValueIsTheSumOfItsFunctions) {
  ShRgb light(3);
  for (int k = 0; k < 9; ++k) light.c[k] = Rgb(1.0f + k, -k, 0.5f * k);
  const Vec3 d = normalize(Vec3(1, 2, -3));
  const std::vector<float> y = evaluate(3, d);
  Rgb expected(0);
  for (int k = 0; k < 9; ++k) expected += light.c[k] * y[k];
  EXPECT_LT(length(light.evaluate(d) - expected), 1e-5f);
}

TEST(Sh, WrongBandCountsAreErrors) {
  std::vector<float> out(100);
  for (int bands : {-1, 0, kMaxShBands + 1})
    EXPECT_THROW(shEvaluate(bands, Vec3(0, 0, 1), std::span(out)), ValueError);
  EXPECT_THROW(shEvaluate(11, Vec3(0, 0, 1), std::span(out)), std::length_error);
}

}  // namespace
}  // namespace prt
