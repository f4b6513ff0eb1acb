// Discs of light on the unrolled sphere: what is inside, at edges and poles.

#include "ui/widgets/lat_long.h"

#include "libprt/light/sky_angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt::ui {
namespace {

const QSizeF kSize(400, 200);

Vec3 at(double azimuth, double elevation) {
  return directionOf(SkyAngles{radians(azimuth), radians(elevation)});
}

TEST(LatLong, MinusZIsInTheMiddleAndPlusXToTheRight) {
  EXPECT_LT(QLineF(toStrip({0, 0, -1}, kSize), {200, 100}).length(), 1e-4);
  EXPECT_LT(QLineF(toStrip({1, 0, 0}, kSize), {300, 100}).length(), 1e-4);
  EXPECT_NEAR(toStrip({0, 1, 0}, kSize).y(), 0, 1e-6);
  for (const Vec3& d : {at(20, 30), at(-170, -80), at(90, 5)})
    EXPECT_LT(length(fromStrip(toStrip(d, kSize), kSize) - d), 1e-5f);
  EXPECT_LT(length(fromStrip({-100, 100}, kSize) - fromStrip({300, 100}, kSize)), 1e-5f) << "x wraps around";
}

// Every pixel of the strip is in the drawn disc just when its direction is in the disc on the sphere; off the
// rim by more than a pixel there is no doubt.
void expectExact(const Vec3& direction, double halfAngle) {
  const QPainterPath disc = discOnStrip(direction, halfAngle, kSize);
  const double doubt = 1.0 * kPi / kSize.height();
  int wrong = 0, sure = 0;
  for (int y = 0; y < kSize.height(); y += 3)
    for (int x = 0; x < kSize.width(); x += 3) {
      const QPointF point(x + 0.5, y + 0.5);
      const Vec3 d = fromStrip(point, kSize);
      const double angle = std::atan2(double(length(cross(d, direction))), double(dot(d, direction)));
      if (std::abs(angle - halfAngle) < doubt) continue;
      ++sure;
      wrong += disc.contains(point) != (angle < halfAngle);
    }
  EXPECT_GT(sure, 4000);
  EXPECT_EQ(wrong, 0) << direction.x << " " << direction.y << " " << direction.z << ", " << degrees(halfAngle)
                      << " degrees";
}

TEST(LatLong, DiscsAreExactWhereverTheyAre) {
  for (const double halfAngle : {3.0, 15.0, 55.0, 89.0, 120.0, 170.0})
    for (const double azimuth : {0.0, 93.0, 179.0, -178.0})
      for (const double elevation : {0.0, 40.0, -62.0, 88.0, 90.0, -90.0})
        expectExact(at(azimuth, elevation), radians(halfAngle));
  expectExact(at(10, 20), kPi);
}

TEST(LatLong, RimsLieOnTheCircle) {
  for (const auto& [direction, degreesHalf] :
       {std::pair(at(179, 10), 25.0), {at(30, 80), 30.0}, {at(0, -45), 44.9}}) {
    const QPainterPath rim = rimOnStrip(direction, radians(degreesHalf), kSize);
    ASSERT_FALSE(rim.isEmpty());
    bool left = false, right = false;
    for (int i = 0; i < rim.elementCount(); ++i) {
      const QPointF point = rim.elementAt(i);
      const Vec3 d = fromStrip(point, kSize);
      EXPECT_NEAR(std::acos(std::clamp(double(dot(d, direction)), -1.0, 1.0)), radians(degreesHalf), 1e-3);
      left = left || (point.x() > 0 && point.x() < 20);
      right = right || (point.x() > 380 && point.x() < 400);
    }
    if (degreesHalf == 25.0) {
      EXPECT_TRUE(left && right) << "goes on at the other edge";
    }
  }
}

}  // namespace
}  // namespace prt::ui
