#include "libprt/core/warp.h"
#include "libprt/core/sampling.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace prt {
namespace {

/// A direction warp under test.
struct Warp {
  std::string name;
  std::function<Vec3(Vec2)> sample;
  std::function<float(Vec3)> pdf;
  std::function<Vec2(Vec3)> inverse;
};

std::vector<Warp> warps() {
  std::vector<Warp> all{
      {"sphere", sampleUniformSphere, [](const Vec3&) { return pdfUniformSphere(); }, inverseUniformSphere},
      {"hemisphere", sampleUniformHemisphere, pdfUniformHemisphere, inverseUniformHemisphere},
      {"cosine", sampleCosineHemisphere, pdfCosineHemisphere, inverseCosineHemisphere}};
  for (float angle : {0.4f, 1.5f, 2.5f}) {
    const float h = coneHeight(angle);
    all.push_back({"cone " + std::to_string(angle), [h](Vec2 u) { return sampleUniformCone(u, h); },
                   [h](Vec3 d) { return pdfUniformCone(d, h); },
                   [h](Vec3 d) { return inverseUniformCone(d, h); }});
  }
  return all;
}

Vec3 fromCylinder(double phi, double z) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

constexpr int kRows = 24, kColumns = 24;

int cellOf(const Vec3& d) {
  const int row = std::min(kRows - 1, int((d.z + 1) / 2 * kRows));
  return row * kColumns + std::min(kColumns - 1, int(turnsOf(d.x, d.y) * kColumns));
}

/// Integral of the density over each equal-area cell.
std::vector<double> cellProbabilities(const Warp& warp) {
  constexpr int kSub = 512;
  std::vector<double> p(kRows * kColumns, 0.0);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      for (int i = 0; i < kSub; ++i)
        for (int j = 0; j < 2; ++j) {
          const double z = 2 * (row + (i + 0.5) / kSub) / kRows - 1,
                       phi = 2 * kPi * (column + (j + 0.5) / 2) / kColumns;
          p[row * kColumns + column] +=
              warp.pdf(fromCylinder(phi, z)) * 4 * kPi / (kRows * kColumns * kSub * 2);
        }
  return p;
}

TEST(Warp, SamplesFollowTheirDensity) {
  constexpr int kSamples = 400'000;
  for (const Warp& warp : warps()) {
    const std::vector<double> p = cellProbabilities(warp);
    std::vector<int> counts(p.size(), 0);
    for (int i = 0; i < kSamples; ++i)
      ++counts[cellOf(warp.sample({hashUniform(1, i, 0), hashUniform(1, i, 1)}))];
    double chi = 0, freedom = -1, total = 0;
    for (std::size_t c = 0; c < p.size(); ++c) {
      total += p[c];
      if (p[c] * kSamples < 5) {
        EXPECT_LE(counts[c], 20) << warp.name << ": samples where there is no density";
        continue;
      }
      chi += (counts[c] - p[c] * kSamples) * (counts[c] - p[c] * kSamples) / (p[c] * kSamples);
      ++freedom;
    }
    EXPECT_NEAR(total, 1, 2e-3) << warp.name << ": the density does not integrate to 1";
    // Cells cut by the rim of a cone carry the quadrature's error; it is inside these four deviations.
    EXPECT_LT((chi - freedom) / std::sqrt(2 * freedom), 4) << warp.name;
  }
}

Vec2 unitSquarePoint() {
  const auto coordinate = rc::gen::inRange(0, 1 << 24);
  return {float(*coordinate) * 0x1p-24f, float(*coordinate) * 0x1p-24f};
}

TEST(Warp, SamplesAreUnitVectorsWithinTheDomain) {
  for (const Warp& warp : warps())
    EXPECT_TRUE(rc::check(warp.name, [&] {
      const Vec3 d = warp.sample(unitSquarePoint());
      RC_ASSERT(std::abs(length(d) - 1) < 3e-7f);
    }));
}

TEST(Warp, InverseUndoesSample) {
  for (const Warp& warp : warps())
    EXPECT_TRUE(rc::check(warp.name, [&] {
      const Vec3 d = warp.sample(unitSquarePoint());
      // At a pole many points of the square share a direction, and 1 - z has half of the digits.
      RC_ASSERT(length(warp.sample(warp.inverse(d)) - d) <
                2e-5f * (1 + 1 / std::sqrt(1.001f - std::abs(d.z))));
    }));
  for (const Warp& warp : warps())
    for (int i = 0; i < 10'000; ++i) {
      const Vec2 u(0.01f + 0.98f * sobol(i, 0, 3), 0.05f + 0.9f * sobol(i, 1, 3));
      const Vec2 back = warp.inverse(warp.sample(u));
      ASSERT_NEAR(back.x, u.x, 3e-6) << warp.name;
      ASSERT_NEAR(back.y, u.y, 3e-6) << warp.name;
    }
}

TEST(Warp, TinyConesKeepTheirAccuracy) {
  const double angle = radians(0.2665);  // the sun
  const float h = coneHeight(float(angle));
  EXPECT_NEAR(2 * kPi * h, 6.7967e-5, 1e-9);
  double sine2 = 0;
  constexpr int kSamples = 4096;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 d = sampleUniformCone(sobol2(i, 0, 1), h);
    ASSERT_GT(pdfUniformCone(d, h * 1.00001f), 0);
    sine2 += (double(d.x) * d.x + double(d.y) * d.y) / kSamples;
    const Vec2 back = inverseUniformCone(d, h);
    ASSERT_NEAR(back.y, sobol2(i, 0, 1).y, 1e-5);
  }
  const double s = std::sin(angle / 2);
  EXPECT_NEAR(sine2, 2 * s * s, 1e-9) << "mean of sin^2 over a small cap is half of its largest value";
}

TEST(Warp, MomentsOfSphereAndHemispheres) {
  DVec3 sphere(0), hemisphere(0), cosine(0), squares(0);
  constexpr int kSamples = 1 << 14;
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u = sobol2(i, 0, 11);
    const DVec3 s = sampleUniformSphere(u), h = sampleUniformHemisphere(u), c = sampleCosineHemisphere(u);
    sphere += s / double(kSamples), hemisphere += h / double(kSamples), cosine += c / double(kSamples);
    squares += s * s / double(kSamples);
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sphere[k], 0, 1e-4);
    EXPECT_NEAR(squares[k], 1.0 / 3, 1e-4);
    EXPECT_NEAR(hemisphere[k], k == 2 ? 0.5 : 0, 1e-4);
    EXPECT_NEAR(cosine[k], k == 2 ? 2.0 / 3 : 0, 1e-4);
  }
}

TEST(Warp, ConcentricDiscIsUniformAndInvertible) {
  constexpr int kSamples = 1 << 16, kRings = 16;
  std::vector<int> counts(kRings * 16, 0);
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u = sobol2(i, 0, 5), p = sampleConcentricDisc(u);
    ASSERT_LE(length(p), 1.0000002f);
    ASSERT_EQ(pdfConcentricDisc(0.99999f * p), 1 / kPiF);
    const Vec2 back = inverseConcentricDisc(p);
    ASSERT_LT(length(back - u), 1e-6f);
    ++counts[std::min(kRings - 1, int(dot(p, p) * kRings)) * 16 + std::min(15, int(turnsOf(p.x, p.y) * 16))];
  }
  for (int c : counts) EXPECT_NEAR(c, kSamples / (16.0 * kRings), 12) << "equal areas hold equal counts";
  EXPECT_EQ(pdfConcentricDisc({0.8f, 0.8f}), 0);
}

TEST(Warp, TriangleIsUniformAndInvertible) {
  DVec3 mean(0), square(0);
  constexpr int kSamples = 1 << 14;
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u = sobol2(i, 0, 5), b = sampleTriangle(u);
    ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
    ASSERT_LT(length(inverseTriangle(b) - u), 3e-7f);
    const DVec3 weights(1.0 - b.x - b.y, b.x, b.y);
    mean += weights / double(kSamples), square += weights * weights / double(kSamples);
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 1.0 / 3, 1e-4);
    EXPECT_NEAR(square[k], 1.0 / 6, 1e-4);
  }
}

TEST(Warp, SineAndCosineOfTurns) {
  double worst = 0;
  for (int i = -20'000; i <= 20'000; ++i) {
    const float turns = float(i) / 8191;
    float s, c;
    sinCosTurns(turns, s, c);
    worst =
        std::max({worst, std::abs(s - std::sin(2 * kPi * turns)), std::abs(c - std::cos(2 * kPi * turns))});
  }
  EXPECT_LT(worst, 2e-7);
}

TEST(Warp, CornersOfTheUnitSquareAreFinite) {
  for (const Warp& warp : warps())
    for (float x : {0.0f, 0.5f, 0x1.fffffep-1f})
      for (float y : {0.0f, 0.5f, 0x1.fffffep-1f}) {
        const Vec3 d = warp.sample({x, y});
        const Vec2 back = warp.inverse(d);
        EXPECT_TRUE(isFinite(d) && std::isfinite(back.x) && std::isfinite(back.y)) << warp.name;
      }
}

}  // namespace
}  // namespace prt
