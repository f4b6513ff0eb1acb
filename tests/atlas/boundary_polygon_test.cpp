#include "libprt/atlas/boundary_polygon.h"

#include "libprt/atlas/orientation.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace prt {
namespace {

void expectOnCircle(const std::vector<double>& sides) {
  const std::vector<DVec2> corners = polygonOnCircle(sides);
  ASSERT_EQ(corners.size(), sides.size());
  const double radius = glm::length(corners[0]);
  double longest = *std::max_element(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    EXPECT_NEAR(glm::length(corners[i]), radius, 1e-9 * radius);
    const DVec2 &a = corners[i], &b = corners[(i + 1) % corners.size()],
                &c = corners[(i + 2) % corners.size()];
    EXPECT_NEAR(glm::distance(a, b), sides[i], 1e-6 * longest);
    EXPECT_GT(signedArea2(a, b, c), 0);
  }
}

TEST(PolygonOnCircle, ASquareHasTheCentreInside) {
  expectOnCircle({2, 2, 2, 2});
  EXPECT_NEAR(glm::length(polygonOnCircle(std::vector<double>{2, 2, 2, 2})[0]), std::sqrt(2.0), 1e-12);
}

TEST(PolygonOnCircle, ALongSideHasTheCentreOutside) {
  expectOnCircle({3, 2, 1.5});      // obtuse
  expectOnCircle({10, 4, 3, 3.5});  // flat
  expectOnCircle({3, 4, 5});        // exactly half a circle
  EXPECT_NEAR(glm::length(polygonOnCircle(std::vector<double>{3, 4, 5})[0]), 2.5, 1e-6);
}

TEST(PolygonOnCircle, RefusesWhatCannotClose) {
  EXPECT_THROW(polygonOnCircle(std::vector<double>{1, 1}), ValueError);
  EXPECT_THROW(polygonOnCircle(std::vector<double>{5, 2, 2}), ValueError);
}

RC_GTEST_PROP(PolygonOnCircleProperty, SidesAreAsAsked, ()) {
  const int count = *rc::gen::inRange(3, 30);
  std::vector<double> sides;
  for (int i = 0; i < count; ++i) sides.push_back(*rc::gen::inRange(1, 1000));
  double total = 0, longest = 0;
  for (double s : sides) total += s, longest = std::max(longest, s);
  RC_PRE(longest < 0.99 * (total - longest));
  expectOnCircle(sides);
}

TEST(Corners, AreSpreadByLength) {
  std::vector<double> lengths(40, 1.0);
  EXPECT_EQ(spreadCorners(lengths, 4), (std::vector<std::uint32_t>{0, 10, 20, 30}));
  EXPECT_EQ(spreadCorners(std::vector<double>{1, 1, 1}, 8).size(), 3u);
  std::vector<double> uneven(8, 0.01);
  uneven[0] = 10;
  EXPECT_EQ(spreadCorners(uneven, 4).size(), 4u);
}

TEST(Corners, AreAddedUntilThePolygonCloses) {
  std::vector<double> lengths(40, 1.0);
  EXPECT_GE(usableCorners(lengths, {5}).size(), 3u);
  const auto corners = usableCorners(lengths, {0, 1, 2});  // one side of 38
  EXPECT_GT(corners.size(), 3u);
  EXPECT_NO_THROW(layOnPolygon(lengths, corners, {}));
  EXPECT_THROW(usableCorners(lengths, {40}), ValueError);
}

TEST(LayOnPolygon, PointsGoByLengthAlongStraightSides) {
  const std::vector<double> lengths{1, 3, 2, 2, 4, 4};
  const BoundaryPolygon polygon = layOnPolygon(lengths, std::vector<std::uint32_t>{0, 2, 4, 5}, {});
  const DVec2 a = polygon.points[0], b = polygon.points[1], c = polygon.points[2];
  EXPECT_NEAR(signedArea2(a, b, c), 0, 1e-12);
  EXPECT_NEAR(glm::distance(a, b) / glm::distance(a, c), 0.25, 1e-12);
}

TEST(SelfIntersects, KnowsCrossingsAndTouches) {
  using P = std::vector<DVec2>;
  EXPECT_FALSE(selfIntersects(P{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_TRUE(selfIntersects(P{{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_TRUE(selfIntersects(P{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));  // a corner on a side
  EXPECT_FALSE(selfIntersects(P{{0, 0}, {2, 0}, {2, 2}, {1, 1e-9}, {0, 2}}));
}

RC_GTEST_PROP(SelfIntersectsProperty, AgreesWithTheQuadraticTest, ()) {
  const auto n = std::size_t(*rc::gen::inRange(4, 12));
  std::vector<DVec2> p;
  for (std::size_t i = 0; i < n; ++i)
    p.push_back({double(*rc::gen::inRange(0, 30)), double(*rc::gen::inRange(0, 30))});
  const auto meets = [&](std::size_t i, std::size_t j) {
    const DVec2 &a = p[i], &b = p[(i + 1) % n], &c = p[j], &d = p[(j + 1) % n];
    const auto sign = [](double v) { return (v > 0) - (v < 0); };
    const int s1 = sign(signedArea2(a, b, c)), s2 = sign(signedArea2(a, b, d));
    const int s3 = sign(signedArea2(c, d, a)), s4 = sign(signedArea2(c, d, b));
    const auto within = [](const DVec2& q, const DVec2& u, const DVec2& v) {
      return q.x >= std::min(u.x, v.x) && q.x <= std::max(u.x, v.x) && q.y >= std::min(u.y, v.y) &&
             q.y <= std::max(u.y, v.y);
    };
    if (s1 * s2 < 0 && s3 * s4 < 0) return true;
    return (s1 == 0 && within(c, a, b)) || (s2 == 0 && within(d, a, b)) || (s3 == 0 && within(a, c, d)) ||
           (s4 == 0 && within(b, c, d));
  };
  bool plain = false;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if (!(i == 0 && j == n - 1)) plain = plain || meets(i, j);
  RC_ASSERT(selfIntersects(p) == plain);
}

RC_GTEST_PROP(OrientationProperty, IsExactOnNearlyStraightFloats, ()) {
  // Against the same sum in 128-bit integers: coordinates are k * 2^-40.
  const auto number = [] { return *rc::gen::inRange<std::int64_t>(-(1 << 23), 1 << 23); };
  const std::int64_t ax = number(), ay = number(), dx = number() / 64, dy = number() / 64;
  const std::int64_t step = *rc::gen::inRange<std::int64_t>(1, 3),
                     nudge = *rc::gen::inRange<std::int64_t>(-1, 2);
  const std::int64_t bx = ax + dx, by = ay + dy, cx = ax + step * dx + nudge, cy = ay + step * dy;
  RC_PRE(std::abs(cx) < (1 << 24) && std::abs(cy) < (1 << 24) && std::abs(bx) < (1 << 24));
  const auto at = [](std::int64_t x, std::int64_t y) {
    return Vec2(float(std::ldexp(double(x), -40)), float(std::ldexp(double(y), -40)));
  };
  const __int128 det = __int128(bx - ax) * (cy - ay) - __int128(by - ay) * (cx - ax);
  RC_ASSERT(orientation(at(ax, ay), at(bx, by), at(cx, cy)) == (det > 0) - (det < 0));
}

TEST(Orientation, SeesWhatDoublesRoundAway) {
  // b - a and c - a are not exact in double here.
  const Vec2 a(1.0f, 1.0f), b(1e-30f, 1e-30f), c(-1.0f, -1.0f), above(1e-30f, 2e-30f);
  EXPECT_EQ(orientation(a, b, c), 0);
  EXPECT_EQ(orientation(a, above, c), 1);
  EXPECT_EQ(orientation(c, above, a), -1);
}

}  // namespace
}  // namespace prt
