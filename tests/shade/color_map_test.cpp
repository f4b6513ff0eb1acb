#include "libprt/shade/color_map.h"

#include "libprt/core/srgb.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

/// CIE lightness of a display-encoded colour.
double lightness(const Rgb& c) {
  const double y = 0.2126 * decodeSrgb(c.x) + 0.7152 * decodeSrgb(c.y) + 0.0722 * decodeSrgb(c.z);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(MagnitudeColor, GetsLighterEvenly) {
  const auto colors = magnitudeColors();
  const double whole = lightness(colors.back()) - lightness(colors.front());
  EXPECT_GT(whole, 65) << "most of the range from black to white";
  for (std::size_t i = 8; i < colors.size(); ++i) {
    const double step = lightness(colors[i]) - lightness(colors[i - 8]);
    EXPECT_GT(step, 0.5 * whole * 8 / double(colors.size()));
    EXPECT_LT(step, 1.6 * whole * 8 / double(colors.size()));
  }
}

TEST(MagnitudeColor, CanBeShownAndHasNoJumps) {
  const auto colors = magnitudeColors();
  double path = 0, longest = 0;  // as the screen encodes them, which is near to how they are seen
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(colors[i][c] >= 0 && colors[i][c] <= 1);
    if (i == 0) continue;
    const double step = length(colors[i] - colors[i - 1]);
    path += step;
    longest = std::max(longest, step);
  }
  EXPECT_LT(longest, 3 * path / double(colors.size() - 1)) << "no step stands out";
}

TEST(MagnitudeColor, EndsAndUnknownValues) {
  const auto colors = magnitudeColors();
  EXPECT_EQ(magnitudeColor(0), colors.front());
  EXPECT_EQ(magnitudeColor(1), colors.back());
  EXPECT_EQ(magnitudeColor(7), colors.back());
  EXPECT_EQ(magnitudeColor(-1), kUnknownColor);
  EXPECT_EQ(magnitudeColor(std::numeric_limits<float>::quiet_NaN()), kUnknownColor);
}

}  // namespace
}  // namespace prt
