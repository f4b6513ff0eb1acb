#pragma once
// Pearson's test of samples against the probabilities of the cells they fall into.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace prt::test {

/// How many standard deviations the statistic lies above its mean; below 4 for a correct sampler but once in
/// ten thousand. Cells with fewer than 5 expected samples are counted together.
inline double chiSquareDeviation(std::span<const int> counts, std::span<const double> probabilities) {
  double samples = 0;
  for (const int count : counts) samples += count;
  double chi = 0, freedom = -1, pooledCount = 0, pooledExpected = 0;
  const auto add = [&](double count, double expected) {
    chi += (count - expected) * (count - expected) / expected;
    freedom += 1;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = probabilities[i] * samples;
    if (expected >= 5) {
      add(counts[i], expected);
    } else {
      pooledCount += counts[i];
      pooledExpected += expected;
    }
  }
  // Samples where hardly any were due count fully against a pool that is too small for the statistic.
  if (pooledCount > 0 || pooledExpected >= 5) add(pooledCount, std::max(pooledExpected, 1.0));
  return (chi - freedom) / std::sqrt(2 * std::max(1.0, freedom));
}

}  // namespace prt::test
