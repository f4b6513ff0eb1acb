#include "libprt/basis/view_square.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

TEST(ViewSquare, IsEqualArea) {
  DVec3 mean(0), square(0);
  const int n = 1 << 16;
  for (int i = 0; i < n; ++i) {
    const DVec3 d(viewFromSquare(sobol2(std::uint32_t(i), 0, 1)));
    mean += d / double(n), square += d * d / double(n);
  }
  EXPECT_NEAR(mean.z, 0.5, 1e-4);
  EXPECT_NEAR(mean.x, 0, 1e-4);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(square[axis], 1.0 / 3, 1e-4);
}

TEST(ViewSquare, GoesThereAndBack) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const Vec2 p = sobol2(i, 0, 2);
    const Vec3 d = viewFromSquare(p);
    EXPECT_NEAR(length(d), 1, 1e-6);
    EXPECT_GE(d.z, 0);
    const Vec2 back = squareFromView(d);
    EXPECT_NEAR(back.x, p.x, 2e-6);
    EXPECT_NEAR(back.y, p.y, 2e-6);
  }
  EXPECT_NEAR(length(viewFromSquare(Vec2(0.5f)) - Vec3(0, 0, 1)), 0, 1e-6);
  // Below the horizon: onto it.
  const Vec3 d = viewFromSquare(squareFromView(normalize(Vec3(0.3f, -0.4f, -0.5f))));
  EXPECT_NEAR(length(d - Vec3(0.6f, -0.8f, 0)), 0, 1e-5);
}

TEST(ViewSquare, BordersAreTheHorizon) {
  for (const float t : {0.0f, 0.2f, 0.5f, 0.9f})
    for (const Vec2 p : {Vec2(t, 0), Vec2(t, 1), Vec2(0, t), Vec2(1, t)})
      EXPECT_NEAR(viewFromSquare(p).z, 0, 1e-6);
}

TEST(ViewSquare, QuarterTurnsTurnTheSquare) {
  for (const int side : {1, 3, 8}) {
    const ViewSquare square(side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Vec3 d = square.centre(y * side + x), turned = square.centre(x * side + side - 1 - y);
        EXPECT_NEAR(length(turned - Vec3(-d.y, d.x, d.z)), 0, 1e-6);
      }
  }
}

TEST(ViewSquare, OutermostOfEightLiesSeventySixDegreesDown) {
  const ViewSquare square(8);
  float lowest = 1;
  for (int i = 0; i < 64; ++i) lowest = std::min(lowest, square.centre(i).z);
  EXPECT_NEAR(degrees(std::acos(double(lowest))), 76.4, 0.1);
  EXPECT_DOUBLE_EQ(square.solidAngle() * square.count(), 2 * kPi);
}

TEST(ViewSquare, InterpolatesAndClamps) {
  const ViewSquare square(8);
  for (int i = 0; i < 64; ++i) {
    EXPECT_EQ(square.nearest(square.centre(i)), i);
    for (const auto& corner : square.bilinear(square.centre(i)))
      EXPECT_NEAR(corner.weight, corner.index == i ? 1 : 0, 1e-5);
  }
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vec3 d = viewFromSquare(sobol2(i, 0, 3));
    Vec2 mean(0);
    float sum = 0;
    for (const auto& corner : square.bilinear(d)) {
      ASSERT_GE(corner.weight, 0);
      sum += corner.weight;
      mean += corner.weight * (Vec2(float(corner.index % 8), float(corner.index / 8)) + 0.5f) / 8.0f;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    const Vec2 wanted = clamp(squareFromView(d), Vec2(0.5f / 8), Vec2(7.5f / 8));
    EXPECT_NEAR(length(mean - wanted), 0, 1e-5);
  }
  // The horizon takes the outermost value, not that of the opposite side.
  EXPECT_EQ(square.nearest({1, 0, 0}) % 8, 7);
  EXPECT_EQ(ViewSquare(1).nearest({1, 0, 0}), 0);
  EXPECT_THROW(ViewSquare(0), ValueError);
}

}  // namespace
}  // namespace prt
