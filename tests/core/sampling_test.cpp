#include "libprt/core/sampling.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace prt {
namespace {

/// Chi-square statistic of counts against an even spread, in standard deviations from its mean.
double chiSquareDeviations(const std::vector<int>& counts, double expected) {
  double chi = 0;
  for (int c : counts) chi += (c - expected) * (c - expected) / expected;
  const double freedom = double(counts.size()) - 1;
  return (chi - freedom) / std::sqrt(2 * freedom);
}

TEST(HashNumbers, AreUniformAlongSeedIndexAndDimension) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> counts(256, 0);
    for (std::uint32_t i = 0; i < 256 * 400; ++i) {
      const float u = axis == 0   ? hashUniform(i, 7, 3)
                      : axis == 1 ? hashUniform(7, i, 3)
                                  : hashUniform(7, 3, i);
      ASSERT_TRUE(u >= 0 && u < 1);
      ++counts[int(u * 256)];
    }
    EXPECT_LT(std::abs(chiSquareDeviations(counts, 400)), 4) << "axis " << axis;
  }
}

TEST(HashNumbers, NeighbouringKeysAreIndependent) {
  // Pairs (key, next key) along each axis fill the unit square evenly.
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> counts(1024, 0);
    for (std::uint32_t i = 0; i < 1024 * 100; ++i) {
      const std::uint32_t j = i + 1;
      const float u = axis == 0   ? hashUniform(i, 7, 3)
                      : axis == 1 ? hashUniform(7, i, 3)
                                  : hashUniform(7, 3, i);
      const float v = axis == 0   ? hashUniform(j, 7, 3)
                      : axis == 1 ? hashUniform(7, j, 3)
                                  : hashUniform(7, 3, j);
      ++counts[int(u * 32) * 32 + int(v * 32)];
    }
    EXPECT_LT(std::abs(chiSquareDeviations(counts, 100)), 4) << "axis " << axis;
  }
}

TEST(HashNumbers, DoNotCollideOnAGridOfKeys) {
  std::set<std::uint64_t> seen;
  for (int seed = 0; seed < 30; ++seed)
    for (int index = 0; index < 30; ++index)
      for (int dimension = 0; dimension < 30; ++dimension) seen.insert(hashBits(seed, index, dimension));
  EXPECT_EQ(seen.size(), 27'000u);
}

TEST(Sobol, EveryCoordinateOfEveryPrefixIsStratified) {
  // 2^k points: one in each interval of length 2^-k; a padded dimension does it too.
  for (int dimension : {0, 1, 2, 3, 4, 5, 6, 7, 8, 13, 29})
    for (int k : {0, 3, 6, 10}) {
      std::vector<int> counts(1 << k, 0);
      for (int i = 0; i < (1 << k); ++i) ++counts[int(sobol(i, dimension, 42) * (1 << k))];
      for (int c : counts) ASSERT_EQ(c, 1) << "dimension " << dimension << ", 2^" << k << " points";
    }
}

TEST(Sobol, FirstPairIsStratifiedInEveryElementaryRectangle) {
  for (std::uint64_t seed : {1, 2, 3})
    for (int set : {0, 8})
      for (int k : {4, 7, 10})
        for (int a = 0; a <= k; ++a) {
          std::vector<int> counts(1 << k, 0);
          for (int i = 0; i < (1 << k); ++i) {
            const Vec2 u = sobol2(i, set, seed);
            ++counts[int(u.x * (1 << a)) << (k - a) | int(u.y * (1 << (k - a)))];
          }
          for (int c : counts) ASSERT_EQ(c, 1) << "2^" << a << " x 2^" << k - a;
        }
}

TEST(Sobol, OtherPairsOfASetAreFarMoreEvenThanRandomPoints) {
  for (int a = 0; a < kSobolDimensions; ++a)
    for (int b = 0; b < a; ++b) {
      std::vector<int> counts(256, 0);
      for (int i = 0; i < 1024; ++i) ++counts[int(sobol(i, a, 9) * 16) * 16 + int(sobol(i, b, 9) * 16)];
      for (int c : counts) ASSERT_LE(c, 8) << a << ", " << b << ": share is 4";
      ASSERT_LT(chiSquareDeviations(counts, 4), -5) << a << ", " << b;
    }
}

TEST(Sobol, FillEqualsPointByPoint) {
  for (std::uint32_t first : {0u, 1u, 250u, 511u, 70'000u, 0xffffff00u})
    for (int dimension = 0; dimension < kSobolDimensions; ++dimension) {
      std::vector<float> values(600);
      sobolFill(first, dimension, 5, values);
      for (std::uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], sobol(first + i, dimension, 5));
    }
  std::vector<float> one(1);
  EXPECT_THROW(sobolFill(0, kSobolDimensions, 5, one), ValueError);
}

double smooth(const Vec2& u) {
  return std::exp(-u.x) * std::cos(2 * u.y);
}
const double kSmoothIntegral = (1 - std::exp(-1.0)) * std::sin(2.0) / 2;

/// Mean and root mean square error of the integral over many scrambles.
std::pair<double, double> integrationError(int points, int dimension) {
  double sum = 0, squares = 0;
  constexpr int kSeeds = 256;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    double estimate = 0;
    for (int i = 0; i < points; ++i) estimate += smooth(sobol2(i, dimension, seed)) / points;
    sum += estimate - kSmoothIntegral;
    squares += (estimate - kSmoothIntegral) * (estimate - kSmoothIntegral);
  }
  return {sum / kSeeds, std::sqrt(squares / kSeeds)};
}

TEST(Sobol, ScramblesAreUnbiasedAndTheErrorFallsFast) {
  for (int dimension : {0, 8}) {
    const auto [bias16, rms16] = integrationError(16, dimension);
    const auto [bias1024, rms1024] = integrationError(1024, dimension);
    EXPECT_LT(std::abs(bias16), 4 * rms16 / 16) << "four standard errors of 256 scrambles";
    EXPECT_LT(std::abs(bias1024), 4 * rms1024 / 16);
    // Random points would give 0.30 / sqrt(N). N^-3/2 from 16 to 1024 is a factor 512.
    EXPECT_LT(rms1024, rms16 / 200);
    EXPECT_LT(rms1024, 0.30 / std::sqrt(1024) / 50);
  }
}

double correlation(const std::function<float(int)>& a, const std::function<float(int)>& b) {
  double sum = 0;
  constexpr int kCount = 4096;
  for (int i = 0; i < kCount; ++i) sum += (a(i) - 0.5) * (b(i) - 0.5) * 12 / kCount;
  return sum;
}

TEST(Sobol, SetsAreUnrelatedToEachOther) {
  const auto coordinate = [](int dimension) { return [dimension](int i) { return sobol(i, dimension, 1); }; };
  for (int set : {8, 16, 24})
    for (int d = 0; d < kSobolDimensions; ++d)
      EXPECT_LT(std::abs(correlation(coordinate(d), coordinate(set + d))), 4 / std::sqrt(4096)) << set + d;
}

TEST(Sobol, SeedsAreUnrelatedToEachOther) {
  // Two scrambles of one point share the coin of the first digit, so a single pair of seeds is correlated;
  // over seeds it must average out. The largest part is the first digit's +-3/4.
  double sum = 0;
  constexpr int kPairs = 400;
  for (std::uint64_t seed = 0; seed < kPairs; ++seed)
    sum +=
        correlation([&](int i) { return sobol(i, 0, seed); }, [&](int i) { return sobol(i, 0, seed + 1); }) /
        kPairs;
  EXPECT_LT(std::abs(sum), 4 * 0.8 / std::sqrt(kPairs));
}

TEST(Sobol, ScrambleFlipsDigitsIndependently) {
  // A digit is flipped by a coin that depends on the digits before it: over seeds, the coins of every two
  // prefixes agree half of the time.
  constexpr int kSeeds = 4096, kLevel = 6;
  std::vector<std::vector<int>> flips(1 << kLevel, std::vector<int>(kSeeds));
  for (int s = 0; s < kSeeds; ++s)
    for (std::uint32_t prefix = 0; prefix < flips.size(); ++prefix)
      flips[prefix][s] =
          (owenScramble(prefix << (32 - kLevel), std::uint32_t(hashBits(s, 1))) >> (31 - kLevel)) & 1;
  double worst = 0, squares = 0;
  int pairs = 0;
  for (std::size_t a = 0; a < flips.size(); ++a)
    for (std::size_t b = 0; b < a; ++b, ++pairs) {
      int agree = 0;
      for (int s = 0; s < kSeeds; ++s) agree += flips[a][s] == flips[b][s];
      const double deviations = (agree - kSeeds / 2.0) / (0.5 * std::sqrt(kSeeds));
      worst = std::max(worst, std::abs(deviations));
      squares += deviations * deviations;
    }
  EXPECT_LT(worst, 4.5);
  EXPECT_NEAR(std::sqrt(squares / pairs), 1, 0.06);
}

TEST(Sobol, ScrambleKeepsAlignedBlocks) {
  EXPECT_TRUE(rc::check("equal leading digits stay equal, different ones different",
                        [](std::uint32_t a, std::uint32_t b, std::uint32_t seed) {
                          const std::uint32_t before = a ^ b,
                                              after = owenScramble(a, seed) ^ owenScramble(b, seed);
                          RC_ASSERT(std::countl_zero(before) == std::countl_zero(after));
                        }));
}

TEST(Sobol, StreamTakesCoordinatesInOrderAndPairsAtEvenOnes) {
  SobolStream stream(7, 123);
  EXPECT_EQ(stream.next(), sobol(123, 0, 7));
  EXPECT_EQ(stream.next2(), sobol2(123, 2, 7));
  EXPECT_EQ(stream.next(), sobol(123, 4, 7));
}

}  // namespace
}  // namespace prt
