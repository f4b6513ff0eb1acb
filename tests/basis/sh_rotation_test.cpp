#include "libprt/basis/sh_rotation.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"
#include "tests/basis/sh_test_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace prt {
namespace {

using test::evaluateSh;
using test::randomDirection;
using test::randomRotation;
using test::randomVector;
using test::rotationAbout;

double largestDifference(std::span<const double> a, std::span<const double> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

TEST(ShRotation, FollowsItsDefinitionInEveryBand) {
  // D_ij = integral of Y_i(w) Y_j(R^-1 w), by exact quadrature.
  std::mt19937 random(1);
  const int bands = 10;
  const glm::dmat3 r = randomRotation(random);
  const ShRotation rotation(bands, r);
  const SphereRule rule = sphereRule(2 * bands - 2);
  std::vector<double> d(shCount(bands) * shCount(bands), 0.0);
  for (std::size_t s = 0; s < rule.weights.size(); ++s) {
    const std::vector<double> y = evaluateSh(bands, rule.directions[s]);
    const std::vector<double> turned = evaluateSh(bands, transpose(r) * rule.directions[s]);
    for (int i = 0; i < shCount(bands); ++i)
      for (int j = 0; j < shCount(bands); ++j)
        d[i * shCount(bands) + j] += rule.weights[s] * y[i] * turned[j];
  }
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m)
      for (int k = -l; k <= l; ++k)
        EXPECT_NEAR(rotation.block(l)[(m + l) * (2 * l + 1) + k + l],
                    d[shIndex(l, m) * shCount(bands) + shIndex(l, k)], 1e-13);
}

TEST(ShRotation, TurnsEvaluatedFunctions) {
  // The recursion keeps 2e-14 up to l = 32; beyond, it loses a digit every ten bands.
  std::mt19937 random(2);
  for (int bands : {1, 2, 3, 5, 9, 33, kMaxShBands}) {
    const glm::dmat3 r = randomRotation(random);
    const ShRotation rotation(bands, r);
    for (int i = 0; i < 10; ++i) {
      const DVec3 d = randomDirection(random);
      std::vector<double> turned(shCount(bands));
      rotation.apply(std::span<const double>(evaluateSh(bands, d)), turned);
      EXPECT_LT(largestDifference(turned, evaluateSh(bands, r * d)), bands > 33 ? 5e-11 : 5e-14)
          << bands << " bands";
    }
  }
}

/// Rotations that taking apart into turns finds hard: about z, upside down, and next to both.
std::vector<glm::dmat3> rotationsAtThePoles() {
  std::vector<glm::dmat3> all;
  for (const double lean : {0.0, 1e-300, 1e-16, 1e-9, 1e-7, 1e-3})
    for (const double turn : {0.0, 0.7, 2.9})
      for (const double over : {0.0, kPi})
        all.push_back(rotationAbout(DVec3(1, 0, 0), lean) * rotationAbout(DVec3(0, 0, 1), turn) *
                      rotationAbout(DVec3(0, 1, 0), over));
  return all;
}

TEST(RotateShOnce, IsTheRotation) {
  std::mt19937 random(12);
  std::vector<glm::dmat3> rotations = rotationsAtThePoles();
  for (int i = 0; i < 20; ++i) rotations.push_back(randomRotation(random));
  for (int bands : {1, 2, 5, 9, kMaxShOnceBands})
    for (const glm::dmat3& r : rotations) {
      const std::vector<double> from = randomVector(shCount(bands), random);
      std::vector<double> expected(from.size()), once = from;
      ShRotation(bands, r).apply(std::span<const double>(from), expected);
      rotateShOnce(bands, r, once, once);
      EXPECT_LT(largestDifference(once, expected), 2e-13) << bands << " bands";
    }
}

TEST(RotateShOnce, KeepsTheErrorOfAFrameOfFloats) {
  std::mt19937 random(13);
  for (const glm::dmat3& r : rotationsAtThePoles()) {
    const std::vector<double> from = randomVector(shCount(9), random);
    std::vector<double> expected(from.size()), once(from.size());
    ShRotation(9, r).apply(std::span<const double>(from), expected);
    rotateShOnce(9, glm::dmat3(Mat3(r)), from, once);
    EXPECT_LT(largestDifference(once, expected), 5e-6);
  }
}

TEST(RotateShOnce, RefusesMoreBandsThanItHas) {
  std::vector<double> c(std::size_t(shCount(kMaxShOnceBands + 1)));
  EXPECT_THROW(rotateShOnce(kMaxShOnceBands + 1, glm::dmat3(1), c, c), ValueError);
  EXPECT_THROW(rotateShOnce(0, glm::dmat3(1), c, c), ValueError);
  EXPECT_THROW(rotateShOnce(3, glm::dmat3(1), std::span(c).first(8), c), std::length_error);
}

TEST(ShRotation, BlocksAreOrthogonal) {
  std::mt19937 random(3);
  const ShRotation rotation(kMaxShBands, randomRotation(random));
  for (int l = 0; l < kMaxShBands; ++l) {
    const std::span<const double> d = rotation.block(l);
    const int n = 2 * l + 1;
    double worst = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = 0;
        for (int k = 0; k < n; ++k) sum += d[i * n + k] * d[j * n + k];
        worst = std::max(worst, std::abs(sum - (i == j)));
      }
    EXPECT_LT(worst, 1e-12) << "l = " << l;
  }
}

TEST(ShRotation, ProductOfRotationsIsTheRotationOfTheProduct) {
  std::mt19937 random(4);
  const int bands = 12;
  for (int i = 0; i < 10; ++i) {
    const glm::dmat3 r1 = randomRotation(random), r2 = randomRotation(random);
    const std::vector<double> c = randomVector(shCount(bands), random);
    std::vector<double> once(c.size()), twice(c.size()), direct(c.size());
    ShRotation(bands, r2).apply(std::span<const double>(c), once);
    ShRotation(bands, r1).apply(std::span<const double>(once), twice);
    ShRotation(bands, r1 * r2).apply(std::span<const double>(c), direct);
    EXPECT_LT(largestDifference(twice, direct), 1e-13);
  }
}

TEST(ShRotation, AxisTurnsAndIdentityAreExact) {
  // The recursion meets its special cases (|k| = l, m = 0, +-1) with many zeros in the matrix.
  std::mt19937 random(5);
  for (const DVec3& axis : {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)})
    for (double quarter : {0, 1, 2, 3}) {
      const glm::dmat3 r = rotationAbout(axis, quarter * kPi / 2);
      const DVec3 d = randomDirection(random);
      std::vector<double> turned(shCount(9));
      ShRotation(9, r).apply(std::span<const double>(evaluateSh(9, d)), turned);
      EXPECT_LT(largestDifference(turned, evaluateSh(9, r * d)), 1e-13);
    }
  const ShRotation identity(6, Mat3(1));
  for (int l = 0; l < 6; ++l)
    for (int i = 0; i < (2 * l + 1) * (2 * l + 1); ++i)
      EXPECT_NEAR(identity.block(l)[i], i % (2 * l + 2) == 0, 1e-15);
}

TEST(ShRotation, AQuarterTurnAboutXHas45EntriesFor5Bands) {
  const ShRotation rotation(5, rotationAbout(DVec3(1, 0, 0), kPi / 2));
  int entries = 0;
  for (int l = 0; l < 5; ++l)
    for (double x : rotation.block(l)) entries += std::abs(x) > 1e-12;
  EXPECT_EQ(entries, 45);
}

TEST(ShRotation, ZTurnsEqualTheGeneralRotation) {
  std::mt19937 random(6);
  for (double angle : {0.0, 0.3, -2.0, 7.0}) {
    const int bands = 7;
    std::vector<double> c = randomVector(shCount(bands), random), general(c.size());
    ShRotation(bands, rotationAbout(DVec3(0, 0, 1), angle)).apply(std::span<const double>(c), general);
    rotateShAboutZ(bands, angle, std::span(c));
    EXPECT_LT(largestDifference(c, general), 1e-13);
  }
}

TEST(ShRotation, ThreeTurnsAboutAxesMakeAnyRotation) {
  // D(Rz(a) Ry(b) Rz(c)), with Ry(b) = Rx(-90) Rz(b) Rx(90): the method of constant quarter turns.
  std::mt19937 random(7);
  const int bands = 6;
  const double a = 0.4, b = 1.1, c = -2.2;
  const DVec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  std::vector<double> v = randomVector(shCount(bands), random), direct(v.size()), turned(v.size());
  ShRotation(bands, rotationAbout(z, a) * rotationAbout(y, b) * rotationAbout(z, c))
      .apply(std::span<const double>(v), direct);
  rotateShAboutZ(bands, c, std::span(v));
  ShRotation(bands, rotationAbout(x, kPi / 2)).apply(std::span<const double>(v), turned);
  rotateShAboutZ(bands, b, std::span(turned));
  ShRotation(bands, rotationAbout(x, -kPi / 2)).apply(std::span<const double>(turned), v);
  rotateShAboutZ(bands, a, std::span(v));
  EXPECT_LT(largestDifference(v, direct), 1e-13);
}

TEST(ShRotation, LightTurnsCounterClockwiseAboutUp) {
  // Light from -Z, turned +90 degrees about +Y (counter-clockwise seen from above), comes from -X.
  ShRgb light(3);
  const std::vector<double> from = evaluateSh(3, DVec3(0, 0, -1)), expected = evaluateSh(3, DVec3(-1, 0, 0));
  for (int k = 0; k < 9; ++k) light.c[k] = Rgb(float(from[k]));
  const ShRgb turned = ShRotation(5, Mat3(rotationAbout(DVec3(0, 1, 0), kPi / 2))).apply(light);
  ASSERT_EQ(turned.bands, 3);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(turned.c[k].g, expected[k], 1e-6);
}

TEST(ShRotation, FloatMatricesLoseNothingButTheirRounding) {
  std::mt19937 random(8);
  const glm::dmat3 r = randomRotation(random);
  const ShRotation rotation(33, Mat3(r));
  std::vector<float> turned(shCount(33));
  const DVec3 d = randomDirection(random);
  const std::vector<double> y = evaluateSh(33, d), expected = evaluateSh(33, r * d);
  rotation.apply(std::vector<float>(y.begin(), y.end()), turned);
  for (int k = 0; k < shCount(33); ++k) EXPECT_NEAR(turned[k], expected[k], 2.3e-5);
  for (int k = 0; k < shCount(9); ++k) EXPECT_NEAR(turned[k], expected[k], 1e-6);
}

TEST(ShRotation, RefusesWhatIsNoRotation) {
  EXPECT_THROW(ShRotation(3, Mat3(2)), ValueError);
  EXPECT_THROW(ShRotation(3, Mat3(1, 0, 0, 0, 1, 0, 0, 0, -1)), ValueError) << "a mirror";
  EXPECT_THROW(ShRotation(3, Mat3(0)), ValueError);
  EXPECT_THROW(ShRotation(3, Mat3(std::numeric_limits<float>::quiet_NaN())), ValueError);
  EXPECT_THROW(ShRotation(0, Mat3(1)), ValueError);
  EXPECT_THROW(ShRotation(3, Mat3(1)).apply(ShRgb(4)), ValueError);
  std::vector<float> four(4), nine(9);
  EXPECT_THROW(ShRotation(3, Mat3(1)).apply(four, nine), std::length_error);
}

}  // namespace
}  // namespace prt
