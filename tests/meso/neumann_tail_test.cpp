#include "libprt/meso/neumann_tail.h"

#include "libprt/core/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

/// A chain whose parts die out at different rates, some slowly: 64 independent modes.
struct Modes {
  static float rate(std::size_t s) { return 0.99f * float(s + 1) / 64; }
  static float start(std::size_t s, std::size_t k) { return hashUniform(1, s, std::uint32_t(k)); }

  static SampleRows term(int power, int lights) {
    SampleRows rows(64, std::size_t(lights));
    for (std::size_t s = 0; s < 64; ++s)
      for (std::size_t k = 0; k < rows.width; ++k)
        rows.row(s)[k] = start(s, k) * std::pow(rate(s), float(power));
    return rows;
  }
};

double rmsOfRest(double albedo, bool extrapolated) {
  NeumannTail tail(1);
  SampleRows total(64, 9);
  for (int power = 1; power <= 40; ++power) {
    const SampleRows term = Modes::term(power, 3);
    tail.add(term);
    for (std::size_t s = 0; s < 64; ++s)
      for (std::size_t i = 0; i < 9; ++i)
        total.row(s)[i] += float(std::pow(albedo, power)) * term.row(s)[i / 3];
  }
  const float a = float(albedo);
  const float colour[3] = {a, a, a};
  if (extrapolated) {
    Job job;
    tail.extrapolate(colour, total, job);
  }
  double square = 0, size = 0;
  for (std::size_t s = 0; s < 64; ++s)
    for (std::size_t i = 0; i < 9; ++i) {
      const double r = albedo * double(Modes::rate(s)), exact = double(Modes::start(s, i / 3)) * r / (1 - r);
      square += std::pow(double(total.row(s)[i]) - exact, 2), size += exact * exact;
    }
  return std::sqrt(square / size);
}

TEST(NeumannTail, FindsTheLimit) {
  // Without: more than half is missing. What is left are the slowest modes, which 40 terms of float hardly
  // tell.
  EXPECT_GT(rmsOfRest(1, false), 0.5);
  EXPECT_LT(rmsOfRest(1, true), 0.1);
  for (const double albedo : {0.9, 0.5}) {
    EXPECT_LT(rmsOfRest(albedo, true), 2e-3) << albedo;
    EXPECT_LE(rmsOfRest(albedo, true), rmsOfRest(albedo, false) + 1e-6);
  }
}

TEST(NeumannTail, LeavesAnEndedSeriesAlone) {
  NeumannTail tail(1);
  SampleRows total(4, 3), nothing(4, 1);
  total.values.assign(total.values.size(), 1.0f);
  const SampleRows before = total;
  const float white[3] = {1, 1, 1};
  Job job;
  tail.extrapolate(white, total, job);
  for (int i = 0; i < 5; ++i) tail.add(nothing);
  tail.extrapolate(white, total, job);
  EXPECT_EQ(total.values, before.values);
}

}  // namespace
}  // namespace prt
