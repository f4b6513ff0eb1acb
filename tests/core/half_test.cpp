#include "libprt/core/half.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace prt {
namespace {

/// The value of the bits by the definition of the format.
double valueOf(std::uint16_t bits) {
  const int sign = bits >> 15, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  double value = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  if (exponent == 31) value = fraction ? std::nan("") : std::numeric_limits<double>::infinity();
  return sign ? -value : value;
}

TEST(Half, EveryPatternHasItsDefinedValueAndComesBack) {
  std::vector<std::uint16_t> bits(65536), back(65536);
  for (int i = 0; i < 65536; ++i) bits[i] = std::uint16_t(i);
  std::vector<float> values(65536);
  fromHalf(bits, values);
  toHalf(values, back);
  for (int i = 0; i < 65536; ++i) {
    const double expected = valueOf(bits[i]);
    if (std::isnan(expected)) {
      ASSERT_TRUE(std::isnan(values[i]) && std::isnan(fromHalf(back[i])));
      continue;
    }
    ASSERT_EQ(values[i], expected);
    ASSERT_EQ(fromHalf(bits[i]), expected);
    ASSERT_EQ(back[i], bits[i]);
  }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  EXPECT_TRUE(rc::check("no neighbour is nearer", [] {
    const float value = std::ldexp(float(*rc::gen::inRange(-(1 << 24), 1 << 24)), *rc::gen::inRange(-50, -9));
    const std::uint16_t bits = toHalf(value);
    const double error = std::abs(valueOf(bits) - value);
    for (int step : {-1, 1}) {
      const std::uint16_t other = std::uint16_t(bits + step);
      if (std::isnan(valueOf(other)) || (bits & 0x7fff) == 0) continue;
      const double otherError = std::abs(valueOf(other) - value);
      RC_ASSERT(error < otherError || (error == otherError && bits % 2 == 0));
    }
  }));
  EXPECT_EQ(toHalf(1 + 0x1p-11f), toHalf(1.0f)) << "a tie goes to the even neighbour";
  EXPECT_EQ(toHalf(1 + 3 * 0x1p-11f), toHalf(1 + 0x1p-9f));
}

TEST(Half, ArraysEqualSingleNumbersWhateverTheirLength) {
  for (std::size_t count : {0u, 1u, 7u, 8u, 9u, 31u}) {
    std::vector<float> values(count), back(count);
    std::vector<std::uint16_t> bits(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(float(i)) * 1000;
    toHalf(values, bits);
    fromHalf(bits, back);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(bits[i], toHalf(values[i]));
      EXPECT_NEAR(back[i], values[i], std::abs(values[i]) * 0x1p-11f);
    }
  }
  std::vector<std::uint16_t> three(3);
  EXPECT_THROW(toHalf(std::vector<float>(4), three), std::length_error);
}

TEST(Half, LargeValuesBecomeInfiniteAndTinyOnesKeepTheirSign) {
  EXPECT_EQ(fromHalf(toHalf(kLargestHalf)), kLargestHalf);
  EXPECT_TRUE(std::isinf(fromHalf(toHalf(65520.0f))));
  EXPECT_TRUE(std::signbit(fromHalf(toHalf(-1e-30f))));
  EXPECT_EQ(fromHalf(toHalf(0x1p-24f)), 0x1p-24f);
}

}  // namespace
}  // namespace prt
