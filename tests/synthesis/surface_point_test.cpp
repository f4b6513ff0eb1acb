#include "libprt/synthesis/surface_point.h"

#include "libprt/core/sampling.h"
#include "tests/synthesis/shapes.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using namespace test;

SurfacePoint middle(std::uint32_t triangle) {
  return {triangle, {1.0f / 3, 1.0f / 3}};
}

TEST(SurfacePoint, WalksAreStraightOnAPlane) {
  const Ready r(makePlane({.columns = 7, .rows = 9}));
  for (std::uint32_t i = 0; i < 200; ++i) {
    const SurfacePoint from = middle(i % std::uint32_t(r.surface.triangleCount()));
    const Vec3 p = positionAt(r.surface, from);
    // To any point of the square.
    const Vec3 to(hashUniform(1, i, 0) - 0.5f, 0, hashUniform(1, i, 1) - 0.5f);
    const SurfacePoint end = walk(r.surface, from, DVec3(to - p));
    EXPECT_NEAR(distance(positionAt(r.surface, end), to), 0, 1e-5f) << i;
  }
}

TEST(SurfacePoint, WalksEndAtABorder) {
  const Ready r(makePlane({.columns = 4, .rows = 4}));
  const SurfacePoint end = walk(r.surface, middle(3), {10, 0, 0});
  EXPECT_NEAR(positionAt(r.surface, end).x, 0.5f, 1e-6f);
}

TEST(SurfacePoint, AWalkAroundACubeComesBack) {
  const Ready r(makeBox({.size = Vec3(1), .cells = 3}));
  // Along the equator: four unit sides.
  for (std::uint32_t t = 0; t < r.surface.triangleCount(); ++t) {
    const Vec3 n = r.sheets.normal[t];
    if (std::abs(n.y) > 0.5f) continue;
    const SurfacePoint from = middle(t), end = walk(r.surface, from, 4.0 * DVec3(cross(Vec3(0, 1, 0), n)));
    EXPECT_NEAR(distance(positionAt(r.surface, end), positionAt(r.surface, from)), 0, 2e-5f) << t;
  }
}

TEST(SurfacePoint, WalksOnASphereFollowGreatCircles) {
  const Ready r(makeIcosphere({.subdivisions = 5}));
  for (std::uint32_t t = 0; t < 2000; t += 97) {
    const DVec3 p = normalize(DVec3(positionAt(r.surface, middle(t))));
    const DVec3 d = normalize(cross(p, DVec3(0.3, 0.5, -0.8)));
    const DVec3 to = std::cos(0.8) * p + std::sin(0.8) * d;
    const SurfacePoint end = walk(r.surface, middle(t), 0.8 * d);
    EXPECT_LT(distance(normalize(DVec3(positionAt(r.surface, end))), to), 0.01) << t;
  }
}

TEST(SurfacePoint, NearestInTriangleBeatsAnyOtherPoint) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    DVec3 v[4];
    for (std::uint32_t k = 0; k < 12; ++k) v[k / 3][int(k % 3)] = double(hashUniform(7, i, k)) * 2 - 1;
    const Vec2 w = nearestInTriangle(v[3], v[0], v[1], v[2]);
    ASSERT_TRUE(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1 + 1e-6f);
    const double best = distance(v[3], interpolated(v[0], v[1], v[2], w));
    for (int a = 0; a <= 20; ++a)
      for (int b = 0; a + b <= 20; ++b)
        ASSERT_GE(distance(v[3], v[0] + (v[1] - v[0]) * (a / 20.0) + (v[2] - v[0]) * (b / 20.0)),
                  best - 1e-6);
  }
}

TEST(SurfacePoint, SheetsAreToldApart) {
  for (const bool joined : {false, true}) {
    const Ready r(twoSheets(0.05f, joined));
    SheetTest test(r.sheets);
    // Above each other in the middle: two sheets. On one of them: one.
    EXPECT_FALSE(test.sameSheet({0.6f, 0, 0.6f}, 1, {0.6f, 0.05f, 0.6f}, 3)) << joined;
    EXPECT_TRUE(test.sameSheet({0.6f, 0, 0.6f}, 1, {0.2f, 0, 0.2f}, 0)) << joined;
    // Where the ramp begins.
    if (joined) {
      EXPECT_TRUE(test.sameSheet({0.9f, 0, 0.5f}, 1, {1.1f, 0, 0.5f}, 4));
      EXPECT_FALSE(test.sameSheet({0.9f, 0.05f, 0.5f}, 3, {1.1f, 0, 0.5f}, 4));
    }
  }
}

TEST(SurfacePoint, CubeSidesAreOneSheetAtTheirEdge) {
  const Ready r(makeBox({.size = Vec3(1), .cells = 8}));
  SheetTest test(r.sheets);
  for (std::uint32_t half = 0; half < 3 * r.surface.triangleCount(); ++half) {
    const std::uint32_t a = half / 3, b = r.surface.twin[half] / 3;
    EXPECT_TRUE(test.sameSheet(positionAt(r.surface, middle(a)), a, positionAt(r.surface, middle(b)), b));
  }
}

}  // namespace
}  // namespace prt
