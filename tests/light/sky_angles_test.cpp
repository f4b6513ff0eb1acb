#include "libprt/light/sky_angles.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

TEST(SkyAngles, AzimuthRunsCounterClockwiseFromMinusZ) {
  EXPECT_LT(length(directionOf(SkyAngles{}) - Vec3(0, 0, -1)), 1e-6f);
  EXPECT_LT(length(directionOf(SkyAngles{kPi / 2, 0}) - Vec3(-1, 0, 0)), 1e-6f);
  EXPECT_LT(length(directionOf(SkyAngles{1.234, kPi / 2}) - Vec3(0, 1, 0)), 1e-6f);
}

TEST(SkyAngles, RoundTrip) {
  for (double azimuth = -3.1; azimuth < 3.1; azimuth += 0.4)
    for (double elevation = -1.5; elevation < 1.5; elevation += 0.3) {
      const SkyAngles back = anglesOf(directionOf(SkyAngles{azimuth, elevation}));
      EXPECT_NEAR(back.azimuth, azimuth, 1e-5);
      EXPECT_NEAR(back.elevation, elevation, 1e-5);
    }
  EXPECT_EQ(anglesOf(Vec3(0, 1, 0)).azimuth, 0);
  EXPECT_NEAR(anglesOf(Vec3(0, -1, 0)).elevation, -kPi / 2, 1e-9);
}

}  // namespace
}  // namespace prt
