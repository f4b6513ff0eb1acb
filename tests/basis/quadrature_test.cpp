#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace prt {
namespace {

TEST(Quadrature, GaussLegendreIsExactForItsDegree) {
  for (int count : {1, 2, 3, 5, 8, 33, 64}) {
    const IntervalRule rule = gaussLegendre(count);
    for (int power = 0; power <= 2 * count - 1; ++power) {
      double sum = 0;
      for (int i = 0; i < count; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
      EXPECT_NEAR(sum, power % 2 ? 0.0 : 2.0 / (power + 1), 1e-14) << count << " nodes, power " << power;
    }
    EXPECT_TRUE(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
  }
}

TEST(Quadrature, GaussLegendreEqualsTheKnownThreePointRule) {
  const IntervalRule rule = gaussLegendre(3);
  EXPECT_NEAR(rule.nodes[2], std::sqrt(0.6), 1e-16);
  EXPECT_NEAR(rule.nodes[1], 0, 1e-16);
  EXPECT_NEAR(rule.weights[0], 5.0 / 9, 1e-15);
  EXPECT_NEAR(rule.weights[1], 8.0 / 9, 1e-15);
}

/// integral over the sphere, or its upper half, of x^a y^b z^c.
double monomialIntegral(int a, int b, int c, bool upperHalf) {
  if (a % 2 || b % 2 || (c % 2 && !upperHalf)) return 0;
  const double half = std::exp(std::lgamma((a + 1) / 2.0) + std::lgamma((b + 1) / 2.0) +
                               std::lgamma((c + 1) / 2.0) - std::lgamma((a + b + c + 3) / 2.0));
  return upperHalf ? half : 2 * half;
}

double integrate(const SphereRule& rule, int a, int b, int c) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.weights.size(); ++i) {
    const DVec3& d = rule.directions[i];
    sum += rule.weights[i] * std::pow(d.x, a) * std::pow(d.y, b) * std::pow(d.z, c);
  }
  return sum;
}

TEST(Quadrature, SphereRuleIsExactForItsDegree) {
  for (int degree : {0, 1, 2, 5, 8, 13}) {
    const SphereRule rule = sphereRule(degree);
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c)
          EXPECT_NEAR(integrate(rule, a, b, c), monomialIntegral(a, b, c, false), 3e-14);
  }
  EXPECT_EQ(sphereRule(8).directions.size(), 45u) << "5 bands need 5 x 9 directions";
}

TEST(Quadrature, HemisphereRuleIsExactForItsDegreeAndACosine) {
  for (int degree : {0, 2, 4, 8, 12}) {
    const SphereRule rule = hemisphereRule(degree);
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c) {
          EXPECT_NEAR(integrate(rule, a, b, c), monomialIntegral(a, b, c, true), 1e-14);
          EXPECT_NEAR(integrate(rule, a, b, c + 1), monomialIntegral(a, b, c + 1, true), 1e-14);
        }
  }
}

/// Largest error of the Gram matrix of 5 bands over a lat-long grid with the given row weights.
double latLongGramError(int rows, const std::vector<double>& weights) {
  const int columns = 2 * rows;
  std::vector<double> gram(625, 0.0), y(25);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double theta = (j + 0.5) * kPi / rows, phi = (i + 0.5) * 2 * kPi / columns;
      shEvaluate(5, DVec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)),
                 std::span(y));
      for (int a = 0; a < 25; ++a)
        for (int b = 0; b < 25; ++b) gram[a * 25 + b] += weights[j] * 2 * kPi / columns * y[a] * y[b];
    }
  double error = 0;
  for (int a = 0; a < 25; ++a)
    for (int b = 0; b < 25; ++b) error = std::max(error, std::abs(gram[a * 25 + b] - (a == b)));
  return error;
}

TEST(Quadrature, FejerRowsAreExactForBandLimitedMaps) {
  EXPECT_LT(latLongGramError(16, fejerRowWeights(16)), 1e-14);
  EXPECT_LT(latLongGramError(64, fejerRowWeights(64)), 1e-13);
}

TEST(Quadrature, CellRowsConvergeAndSumToTheSphere) {
  EXPECT_NEAR(latLongGramError(16, cellRowWeights(16)), 1.4e-2, 1e-3);
  EXPECT_NEAR(latLongGramError(256, cellRowWeights(256)), 5.0e-5, 5e-6);
  for (int rows : {1, 2, 7, 512}) {
    const std::vector<double> cell = cellRowWeights(rows), fejer = fejerRowWeights(rows);
    EXPECT_NEAR(std::accumulate(cell.begin(), cell.end(), 0.0), 2, 1e-13);
    EXPECT_NEAR(std::accumulate(fejer.begin(), fejer.end(), 0.0), 2, 1e-13);
  }
}

TEST(Quadrature, CubeTexelsFillTheSphere) {
  for (int size : {1, 2, 8, 64}) {
    const std::vector<double> angles = cubeFaceSolidAngles(size);
    EXPECT_NEAR(6 * std::accumulate(angles.begin(), angles.end(), 0.0), 4 * kPi, 1e-12);
  }
  // A small texel at the centre of the face has nearly its area, one in the corner area / 3^(3/2).
  const std::vector<double> angles = cubeFaceSolidAngles(1001);
  const double area = 4.0 / (1001.0 * 1001.0);
  EXPECT_NEAR(angles[500 * 1001 + 500] / area, 1, 1e-5);
  EXPECT_NEAR(angles[0] / area, std::pow(3, -1.5), 1e-3);
}

TEST(Quadrature, CubeGramErrorFallsWithTheSquareOfTheSize) {
  const auto gramError = [](int size) {
    const std::vector<double> angles = cubeFaceSolidAngles(size);
    std::vector<double> gram(625, 0.0), y(25);
    for (int face = 0; face < 6; ++face)
      for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
          DVec3 d(1);
          d[(face / 2 + 1) % 3] = (2 * i + 1.0) / size - 1;
          d[(face / 2 + 2) % 3] = (2 * j + 1.0) / size - 1;
          if (face % 2) d[face / 2] = -1;
          shEvaluate(5, normalize(d), std::span(y));
          for (int a = 0; a < 25; ++a)
            for (int b = 0; b < 25; ++b) gram[a * 25 + b] += angles[j * size + i] * y[a] * y[b];
        }
    double error = 0;
    for (int a = 0; a < 25; ++a)
      for (int b = 0; b < 25; ++b) error = std::max(error, std::abs(gram[a * 25 + b] - (a == b)));
    return error;
  };
  EXPECT_NEAR(gramError(8), 9.5e-3, 1e-3);
  EXPECT_NEAR(gramError(16), 2.3e-3, 2e-4);
  EXPECT_NEAR(gramError(64), 1.5e-4, 1e-5);
}

TEST(Quadrature, SizesOutOfRangeAreErrors) {
  EXPECT_THROW(gaussLegendre(0), ValueError);
  EXPECT_THROW(sphereRule(-1), ValueError);
  EXPECT_THROW(fejerRowWeights(0), ValueError);
  EXPECT_THROW(cubeFaceSolidAngles(1 << 20), ValueError);
}

}  // namespace
}  // namespace prt
