#include "libprt/basis/sh_hemisphere.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"
#include "tests/basis/sh_test_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace prt {
namespace {

using test::evaluateSh;

TEST(ShHemisphere, GramHasItsGoldenEntries) {
  const std::vector<double> h = hemisphereGram(5);
  const auto at = [&](int l, int m, int l2, int m2) { return h[shIndex(l, m) * 25 + shIndex(l2, m2)]; };
  EXPECT_NEAR(at(0, 0, 0, 0), 0.5, 1e-14);
  EXPECT_NEAR(at(0, 0, 1, 0), std::sqrt(3) / 4, 1e-14);
  EXPECT_NEAR(at(0, 0, 3, 0), -std::sqrt(7) / 16, 1e-14);
  EXPECT_NEAR(at(1, 1, 2, 1), 0.419263, 1e-6);
  EXPECT_NEAR(at(1, -1, 2, -1), 0.419263, 1e-6);
  EXPECT_NEAR(at(1, 0, 2, 0), 0.242061, 1e-6);
  double trace = 0, squares = 0;
  int entries = 0;
  for (int i = 0; i < 625; ++i) {
    trace += i % 26 == 0 ? h[i] : 0;
    squares += h[i] * h[i];
    entries += std::abs(h[i]) > 1e-12;
  }
  EXPECT_NEAR(trace, 12.5, 1e-13);
  EXPECT_NEAR(squares, 10.489655, 1e-6);
  EXPECT_EQ(entries, 65);
}

TEST(ShHemisphere, GramIsHalfTheIdentityWithinAParity) {
  const std::vector<double> h = hemisphereGram(7);
  for (int l = 0; l < 7; ++l)
    for (int m = -l; m <= l; ++m)
      for (int l2 = 0; l2 < 7; ++l2)
        for (int m2 = -l2; m2 <= l2; ++m2) {
          const double value = h[shIndex(l, m) * 49 + shIndex(l2, m2)];
          const bool sameParity = (l + l2) % 2 == 0;
          if (sameParity || m != m2) {
            EXPECT_NEAR(value, l == l2 && m == m2 ? 0.5 : 0, 1e-14);
          }
        }
}

TEST(ShHemisphere, EigenvaluesPairUpAndReachTheirKnownConditions) {
  for (const auto& [bands, condition] : {std::pair(3, 254.0), {4, 5.9e3}, {5, 1.5e5}, {6, 4.2e6}}) {
    const HemisphereFit fit(bands);
    const std::span<const double> x = fit.eigenvalues();
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i] + x[x.size() - 1 - i], 1, 1e-12);
    EXPECT_NEAR(x.back() / x.front() / condition, 1, 0.03) << bands << " bands";
  }
  const HemisphereFit fit(5);
  EXPECT_EQ(
      std::count_if(fit.eigenvalues().begin(), fit.eigenvalues().end(), [](double x) { return x < 0.01; }),
      6);
  EXPECT_EQ(std::count_if(fit.eigenvalues().begin(), fit.eigenvalues().end(),
                          [](double x) { return x >= 0.01 && x <= 0.99; }),
            13);
}

using Function = std::function<double(const DVec3&)>;

std::vector<double> project(int bands, const Function& f) {
  const SphereRule rule = hemisphereRule(80);
  std::vector<double> b(shCount(bands), 0.0);
  for (std::size_t s = 0; s < rule.weights.size(); ++s) {
    const std::vector<double> y = evaluateSh(bands, rule.directions[s]);
    for (int k = 0; k < shCount(bands); ++k) b[k] += rule.weights[s] * f(rule.directions[s]) * y[k];
  }
  return b;
}

/// Relative L2 error over the upper hemisphere.
double errorOf(int bands, const std::vector<double>& c, const Function& f) {
  const SphereRule rule = hemisphereRule(80);
  double error = 0, norm = 0;
  for (std::size_t s = 0; s < rule.weights.size(); ++s) {
    const std::vector<double> y = evaluateSh(bands, rule.directions[s]);
    double value = 0;
    for (int k = 0; k < shCount(bands); ++k) value += c[k] * y[k];
    const double exact = f(rule.directions[s]);
    error += rule.weights[s] * (value - exact) * (value - exact);
    norm += rule.weights[s] * exact * exact;
  }
  return std::sqrt(error / norm);
}

std::vector<double> fitted(const HemisphereFit& fit, const Function& f) {
  std::vector<double> c(shCount(fit.bands()));
  fit.apply(project(fit.bands(), f), c);
  return c;
}

TEST(ShHemisphere, FunctionsInTheSpanComeBackWhenNothingIsLeftOut) {
  std::mt19937 random(1);
  const std::vector<double> truth = test::randomVector(9, random);
  const auto f = [&](const DVec3& d) {
    const std::vector<double> y = evaluateSh(3, d);
    double value = 0;
    for (int k = 0; k < 9; ++k) value += truth[k] * y[k];
    return value;
  };
  const std::vector<double> c = fitted(HemisphereFit(3, 0), f);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(c[k], truth[k], 1e-11);
}

TEST(ShHemisphere, FitIsBetterThanPlainProjection) {
  // A lobe that ends at the horizon: plain projection also has to make the lower half zero. What is left of
  // the fit's error comes from the directions left out; without leaving any out it is 0 (3 bands suffice).
  const auto lobe = [](const DVec3& d) { return d.z * (1 + 0.5 * d.x); };
  const HemisphereFit fit(4);
  EXPECT_LT(errorOf(4, fitted(fit, lobe), lobe), 0.022);
  EXPECT_LT(errorOf(4, fitted(HemisphereFit(4, 0), lobe), lobe), 1e-10);
  EXPECT_GT(errorOf(4, project(4, lobe), lobe), 0.06);
}

TEST(ShHemisphere, ResidualIsOrthogonalToWhatIsKept) {
  const auto f = [](const DVec3& d) { return std::exp(2 * d.x) * (d.z > 0.5 ? 1 : 0.3); };
  const std::vector<double> b = project(5, f), h = hemisphereGram(5);
  const HemisphereFit fit(5, 0);  // plain inversion: the normal equations hold exactly
  std::vector<double> c(25);
  fit.apply(b, c);
  for (int i = 0; i < 25; ++i) {
    double sum = 0;
    for (int j = 0; j < 25; ++j) sum += h[i * 25 + j] * c[j];
    EXPECT_NEAR(sum, b[i], 1e-9);
  }
}

TEST(ShHemisphere, LeavingOutBoundsTheNoise) {
  std::mt19937 random(2);
  const std::vector<double> noise = test::randomVector(25, random);
  double norm = 0;
  for (double x : noise) norm += x * x;
  const auto growth = [&](double least) {
    std::vector<double> c(25);
    HemisphereFit(5, least).apply(noise, c);
    double sum = 0;
    for (double x : c) sum += x * x;
    return std::sqrt(sum / norm);
  };
  EXPECT_LT(growth(0.01), 1 / 0.01);
  EXPECT_GT(growth(0), 1e3) << "plain inversion blows noise up";
}

TEST(ShHemisphere, BadParametersAreErrors) {
  EXPECT_THROW(hemisphereGram(0), ValueError);
  EXPECT_THROW(HemisphereFit(21), ValueError);
  EXPECT_THROW(HemisphereFit(3, -1), ValueError);
  EXPECT_THROW(HemisphereFit(3, std::numeric_limits<double>::quiet_NaN()), ValueError);
  std::vector<double> few(8), nine(9);
  EXPECT_THROW(HemisphereFit(3).apply(few, nine), std::length_error);
}

}  // namespace
}  // namespace prt
