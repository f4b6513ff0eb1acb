#include "libprt/shade/tonemap.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

TEST(Tonemap, SrgbMatchesTheStandardAndInverts) {
  EXPECT_NEAR(encodeSrgb(0.5f), 0.735357f, 1e-5);
  EXPECT_NEAR(encodeSrgb(0.001f), 0.01292f, 1e-6);
  EXPECT_NEAR(encodeSrgb(1.0f), 1.0f, 1e-6);
  for (float x = 0; x <= 1; x += 0.01f) EXPECT_NEAR(decodeSrgb(encodeSrgb(x)), x, 2e-6);
}

TEST(Tonemap, ExposureDoublesPerStop) {
  EXPECT_EQ(toDisplay(Rgb(0.1f), {2, ToneCurve::Linear}), toDisplay(Rgb(0.4f), {0, ToneCurve::Linear}));
}

TEST(Tonemap, CurvesRiseFromBlackToWhite) {
  for (const ToneCurve curve : {ToneCurve::Linear, ToneCurve::Filmic}) {
    float last = -1;
    for (float x = 0; x < 4; x += 0.01f) {
      const float y = toDisplay(Rgb(x), {0, curve}).x;
      EXPECT_GE(y, last);
      EXPECT_LE(y, 1.0f);
      last = y;
    }
    EXPECT_EQ(toDisplay(Rgb(0), {0, curve}).x, 0.0f);
    EXPECT_EQ(toDisplay(Rgb(1e30f), {0, curve}).x, 1.0f);
  }
}

TEST(Tonemap, BadValuesShowBlackOrWhite) {
  const float infinity = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  for (const ToneCurve curve : {ToneCurve::Linear, ToneCurve::Filmic})
    EXPECT_EQ(toDisplay(Rgb(-1, nan, infinity), {0, curve}), Rgb(0, 0, 1));
}

TEST(Tonemap, AlphaPassesThrough) {
  Image image(1, 1, 4);
  image.data = {4, 0.5f, 0, 0.25f};
  EXPECT_EQ(toDisplay(image, {}).data[3], 0.25f);
  EXPECT_EQ(toDisplay(image, {}).data[0], 1.0f);
}

}  // namespace
}  // namespace prt
