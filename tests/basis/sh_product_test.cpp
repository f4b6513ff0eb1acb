#include "libprt/basis/sh_product.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"
#include "tests/basis/sh_test_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>
#include <tuple>

namespace prt {
namespace {

using test::evaluateSh;
using test::randomDirection;
using test::randomVector;

TEST(ShProduct, NumberOfNonZeroCoefficients) {
  for (const auto& [bands, count] : {std::pair(3, 83u), {4, 353u}, {5, 1158u}, {6, 2907u}})
    EXPECT_EQ(gauntTensor(bands, bands, bands).entries().size(), count) << bands << " bands";
  const GauntTensor& mixed = gauntTensor(5, 5, 9);
  EXPECT_EQ(mixed.entries().size(), 2229u);
  EXPECT_EQ(
      std::count_if(mixed.entries().begin(), mixed.entries().end(), [](const auto& e) { return e.i <= e.j; }),
      1181);
}

TEST(ShProduct, EveryCoefficientEqualsBruteForceQuadrature) {
  const int a = 4, b = 3, c = 6;
  const SphereRule rule = sphereRule(a + b + c - 3);
  std::vector<std::vector<double>> y;
  for (const DVec3& d : rule.directions) y.push_back(evaluateSh(c, d));
  std::map<std::tuple<int, int, int>, double> found;
  for (const GauntTensor::Entry& e : gauntTensor(a, b, c).entries()) found[{e.i, e.j, e.k}] = e.value;
  for (int i = 0; i < shCount(a); ++i)
    for (int j = 0; j < shCount(b); ++j)
      for (int k = 0; k < shCount(c); ++k) {
        double sum = 0;
        for (std::size_t s = 0; s < y.size(); ++s) sum += rule.weights[s] * y[s][i] * y[s][j] * y[s][k];
        const auto it = found.find({i, j, k});
        EXPECT_NEAR(it == found.end() ? 0 : it->second, sum, 1e-14) << i << ' ' << j << ' ' << k;
      }
}

TEST(ShProduct, CoefficientsAreSymmetric) {
  std::map<std::tuple<int, int, int>, double> g;
  for (const GauntTensor::Entry& e : gauntTensor(5, 5, 5).entries()) g[{e.i, e.j, e.k}] = e.value;
  std::size_t distinct = 0;
  for (const auto& [index, value] : g) {
    const auto [i, j, k] = index;
    EXPECT_NEAR((g[{j, i, k}]), value, 1e-15);
    EXPECT_NEAR((g[{k, j, i}]), value, 1e-15);
    distinct += i <= j && j <= k;
  }
  EXPECT_EQ(g.size(), 1158u) << "looking up a permutation made a new entry";
  EXPECT_EQ(distinct, 238u);
}

TEST(ShProduct, TheConstantLeavesAFunctionAsItIs) {
  for (const GauntTensor::Entry& e : gauntTensor(6, 6, 1).entries()) {
    EXPECT_EQ(e.i, e.j);
    EXPECT_NEAR(e.value, 1 / std::sqrt(4 * kPi), 1e-15);
  }
  EXPECT_EQ(gauntTensor(6, 6, 1).entries().size(), 36u);
}

TEST(ShProduct, MultipliesFunctionsPointwise) {
  std::mt19937 random(1);
  const std::vector<double> a = randomVector(shCount(4), random), b = randomVector(shCount(5), random);
  const std::vector<float> c =
      shProduct(4, std::vector<float>(a.begin(), a.end()), 5, std::vector<float>(b.begin(), b.end()), 8);
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> y = evaluateSh(8, randomDirection(random));
    double va = 0, vb = 0, vc = 0;
    for (int k = 0; k < shCount(4); ++k) va += a[k] * y[k];
    for (int k = 0; k < shCount(5); ++k) vb += b[k] * y[k];
    for (int k = 0; k < shCount(8); ++k) vc += c[k] * y[k];
    EXPECT_NEAR(vc, va * vb, 5e-6);
  }
}

/// Any weighted set of directions, such as the visible rays of a bake.
struct Samples {
  std::vector<DVec3> directions;
  std::vector<double> weights;
};

Samples halfBlockedRays(int count) {
  std::mt19937 random(2);
  Samples samples;
  for (int i = 0; i < count; ++i) {
    const DVec3 d = randomDirection(random);
    if (d.x + 0.3 * std::sin(5 * d.y) < 0) continue;
    samples.directions.push_back(d);
    samples.weights.push_back(4 * kPi / count);
  }
  return samples;
}

std::vector<double> project(int bands, const Samples& samples) {
  std::vector<double> v(shCount(bands), 0.0);
  for (std::size_t s = 0; s < samples.weights.size(); ++s) {
    const std::vector<double> y = evaluateSh(bands, samples.directions[s]);
    for (int k = 0; k < shCount(bands); ++k) v[k] += samples.weights[s] * y[k];
  }
  return v;
}

/// T = sum of w y y^T, ray by ray.
std::vector<double> transferSlowly(int bands, const Samples& samples) {
  const int n2 = shCount(bands);
  std::vector<double> t(n2 * n2, 0.0);
  for (std::size_t s = 0; s < samples.weights.size(); ++s) {
    const std::vector<double> y = evaluateSh(bands, samples.directions[s]);
    for (int i = 0; i < n2; ++i)
      for (int j = 0; j < n2; ++j) t[i * n2 + j] += samples.weights[s] * y[i] * y[j];
  }
  return t;
}

TEST(ShProduct, DirectTransferIsExactlyTheExpandedVisibility) {
  const Samples samples = halfBlockedRays(500);
  for (int bands : {1, 3, 5, 7}) {
    const std::vector<double> v = project(2 * bands - 1, samples), slow = transferSlowly(bands, samples);
    std::vector<double> t(slow.size());
    gauntTensor(bands, bands, 2 * bands - 1).contract(std::span<const double>(v), std::span(t));
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(t[i], slow[i], 1e-14) << bands << " bands";

    std::vector<float> expanded(slow.size());
    expandVisibility(bands, std::vector<float>(v.begin(), v.end()), expanded);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(expanded[i], slow[i], 2e-7) << bands << " bands";
  }
}

TEST(ShProduct, VisibilityWithFewerBandsLosesWhatItMust) {
  // Relative Frobenius error of T for a half-space when v keeps 8, 7, 5 or 3 of its 9 bands.
  const SphereRule rule = hemisphereRule(32);
  const Samples samples{rule.directions, rule.weights};
  const std::vector<double> exact = transferSlowly(5, samples);
  for (const auto& [kept, loss] : {std::pair(9, 0.0), {8, 0.0}, {7, 0.043}, {5, 0.102}, {3, 0.216}}) {
    std::vector<double> v = project(9, samples), t(625);
    std::fill(v.begin() + shCount(kept), v.end(), 0.0);
    gauntTensor(5, 5, 9).contract(std::span<const double>(v), std::span(t));
    double error = 0, norm = 0;
    for (int i = 0; i < 625; ++i) error += (t[i] - exact[i]) * (t[i] - exact[i]), norm += exact[i] * exact[i];
    EXPECT_NEAR(std::sqrt(error / norm), loss, 1e-3) << kept << " bands";
  }
}

TEST(ShProduct, ThreadsShareOneTensor) {
  std::vector<const GauntTensor*> seen(8);
  std::vector<std::thread> threads;
  for (auto& slot : seen) threads.emplace_back([&slot] { slot = &gauntTensor(7, 6, 5); });
  for (std::thread& t : threads) t.join();
  for (const GauntTensor* tensor : seen) EXPECT_EQ(tensor, seen[0]);
}

TEST(ShProduct, SizesOutOfRangeAreErrors) {
  std::vector<float> few(8), matrix(25 * 25);
  EXPECT_THROW(gauntTensor(0, 1, 1), ValueError);
  EXPECT_THROW(gauntTensor(1, 1, kMaxGauntBands + 1), ValueError);
  EXPECT_THROW(expandVisibility(5, few, matrix), std::length_error);
  EXPECT_THROW(expandVisibility(0, few, matrix), ValueError);
  EXPECT_THROW(expandVisibility(21, few, matrix), ValueError);
}

}  // namespace
}  // namespace prt
