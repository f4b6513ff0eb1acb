#include "libprt/light/captured.h"

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

namespace prt {
namespace {

using M = EnvironmentMapping;

constexpr int kSide = 32;

std::shared_ptr<const CubeGrid> theGrid() {
  static const auto grid = std::make_shared<const CubeGrid>(kSide);
  return grid;
}

/// What stands in a direction: radiance, and 1 where anything does.
using Seen = std::function<Vec4(const Vec3&)>;

/// 8 x 8 directions a texel.
CapturedCube cubeOf(const Seen& seen) {
  constexpr int kFine = 8;
  CapturedCube cube{theGrid(), Image(6 * kSide, kSide, 4)};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < 6 * kSide; ++x) {
      Vec4 sum(0);
      for (int i = 0; i < kFine * kFine; ++i)
        sum += seen(Vec3(
            theGrid()->geometry().toDirection(x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine)));
      for (int c = 0; c < 4; ++c) cube.image.pixel(x, y)[c] = sum[c] / float(kFine * kFine);
      if (sum.w > 0) cube.seen[std::size_t(x / kSide)] = true;
    }
  return cube;
}

Seen disc(const Vec3& axis, double halfAngle, const Rgb& radiance) {
  return [=](const Vec3& d) { return dot(d, axis) >= std::cos(halfAngle) ? Vec4(radiance, 1) : Vec4(0); };
}

Vec4 blackEverywhere(const Vec3&) {
  return {0, 0, 0, 1};
}

ShRgb lit(const CapturedCube& cube, const LightRig& rig, int bands) {
  std::optional<EnvironmentPoints> points;
  if (rig.environment) points.emplace(*rig.environment);
  ShRgb light = projectLights(rig, bands);
  const ShRgb more = capturedDifference(cube, rig, points ? &*points : nullptr, bands);
  for (std::size_t k = 0; k < light.c.size(); ++k) light.c[k] += more.c[k];
  return light;
}

/// Of all coefficients, relative to the largest of `b`, or absolute where all of `b` is 0.
double difference(const ShRgb& a, const ShRgb& b) {
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < b.c.size(); ++k)
    worst = std::max(worst, double(length(a.c[k] - b.c[k]))), scale = std::max(scale, double(length(b.c[k])));
  return scale > 0 ? worst / scale : worst;
}

double size(const ShRgb& light) {
  double sum = 0;
  for (const Rgb& c : light.c) sum += double(dot(c, c));
  return std::sqrt(sum);
}

LightRig everyKind() {
  LightRig rig;
  rig.environment =
      std::make_shared<const EnvironmentMap>(test::randomMap(MapGeometry(M::LatLong, 64, 32), 5, 30));
  rig.rotation = 0.7f;
  rig.intensity = 0.5f;
  rig.circles = {{normalize(Vec3(1, 1, 0.3f)), 0.4f, Rgb(3, 2, 1)}};
  rig.constant = Rgb(0.2f, 0.3f, 0.4f);
  return rig;
}

TEST(Captured, FacesAreThoseOfTheGrid) {
  const CubeGrid grid(4);
  for (int number = 0; number < 6; ++number) {
    const CubeGrid::Face face = grid.face(number);
    const DVec3 right(cross(face.axis, face.up));
    const DVec3 expected = normalize(DVec3(face.axis) + 0.25 * right + 0.75 * DVec3(face.up));
    const DVec3 found = grid.geometry().toDirection(4 * (number + 0.625), 4 * 0.125);
    EXPECT_LT(length(expected - found), 1e-6) << number;
  }
  EXPECT_THROW(CubeGrid(0), ValueError);
  EXPECT_THROW(CubeGrid(1025), ValueError);
}

TEST(Captured, NothingAroundAddsNothing) {
  const CapturedCube cube = cubeOf([](const Vec3&) { return Vec4(0); });
  EXPECT_TRUE(cube.empty());
  EXPECT_EQ(size(capturedDifference(cube, everyKind(), nullptr, 5)), 0);
  EXPECT_EQ(size(capturedDifference({}, everyKind(), nullptr, 5)), 0);
}

TEST(Captured, AShiningDiscIsACircleLight) {
  for (const double degreesAcross : {120.0, 40.0, 12.0}) {
    const Vec3 axis = normalize(Vec3(0.4f, 0.8f, -0.5f));
    const double half = radians(0.5 * degreesAcross);
    LightRig circle;
    circle.circles = {{axis, float(half), Rgb(2, 1, 0.5f)}};
    const ShRgb light = lit(cubeOf(disc(axis, half, Rgb(2, 1, 0.5f))), {}, 5);
    // Texels on the rim spread their share over themselves: worst for the smallest, four texels across.
    EXPECT_LT(difference(light, projectLights(circle, 5)), 0.005) << degreesAcross;
  }
}

TEST(Captured, ABlackHalfLeavesTheOtherHalfOfTheSky) {
  LightRig sky, upper;
  sky.constant = Rgb(1, 2, 3);
  upper.circles = {{{0, 1, 0}, 0.5f * kPiF, Rgb(1, 2, 3)}};
  const ShRgb light = lit(cubeOf([](const Vec3& d) { return Vec4(0, 0, 0, d.y < 0 ? 1 : 0); }), sky, 8);
  EXPECT_LT(difference(light, projectLights(upper, 8)), 2e-6) << "the border runs along texels";
}

TEST(Captured, WhatShinesLikeTheSkyIsNotSeen) {
  LightRig sky;
  sky.constant = Rgb(0.3f, 0.2f, 0.1f);
  const CapturedCube cube = cubeOf(disc({0, 0, 1}, 0.5, sky.constant));
  EXPECT_LT(size(capturedDifference(cube, sky, nullptr, 6)), 1e-6);
  LightRig map;
  map.environment = std::make_shared<const EnvironmentMap>(
      test::mapOf(MapGeometry(M::LatLong, 64, 32), [](const DVec3&) { return Rgb(0.3f, 0.2f, 0.1f); }));
  const EnvironmentPoints points(*map.environment);
  EXPECT_LT(size(capturedDifference(cube, map, &points, 6)), 0.02 * size(projectLights(map, 6)));
}

TEST(Captured, BlackAllAroundTakesEverythingAway) {
  LightRig rig = everyKind();
  rig.circles.push_back({normalize(Vec3(-1, 2, 0)), 0.004f, Rgb(5e4f)});  // a sun
  rig.directionals = {{normalize(Vec3(-2, 1, 1)), Rgb(3)}};
  for (const int bands : {1, 5, 10})
    EXPECT_LT(size(lit(cubeOf(blackEverywhere), rig, bands)), 0.002 * size(projectLights(rig, bands)));
}

TEST(Captured, ASunInTheMapIsTakenAwayWholeWhereverTheMapIsTurned) {
  // One pixel of 0.35 degrees in a dim sky holds most of the light.
  const MapGeometry g(M::LatLong, 1024, 512);
  EnvironmentMap plain = test::mapOf(g, [](const DVec3&) { return Rgb(0.1f); });
  Image image = plain.pixels();
  test::setPixel(image, 600, 130, Rgb(2e5f));
  LightRig rig;
  rig.environment = std::make_shared<const EnvironmentMap>(image, M::LatLong);
  const DVec3 there = g.center(600, 130);
  for (const float turn : {0.0f, 0.3f, 1.1f, 2.0f, 4.4f}) {
    rig.rotation = turn;
    const Vec3 sun = environmentRotation(turn) * Vec3(there);
    const double all = size(projectLights(rig, 5));
    EXPECT_LT(size(lit(cubeOf(disc(sun, radians(8.0), Rgb(0))), rig, 5)), 0.1 * all) << turn;
    const Vec3 beside = normalize(sun + 0.3f * normalize(cross(sun, Vec3(1, 0, 0))));  // 17 degrees away
    EXPECT_GT(size(lit(cubeOf(disc(beside, radians(8.0), Rgb(0))), rig, 5)), 0.99 * all) << turn;
  }
}

TEST(Captured, CoverageIsFoundInEveryDirection) {
  std::mt19937 random(3);
  for (int i = 0; i < 12; ++i) {
    const Vec3 d(test::randomDirection(random));
    const CapturedCube cube = cubeOf(disc(d, 0.2, Rgb(0)));
    EXPECT_NEAR(cube.coverage(d), 1, 1e-6f);
    EXPECT_EQ(cube.coverage(-d), 0);
  }
}

TEST(Captured, DirectionalLightIsDimmedByWhatStandsInItsWay) {
  LightRig rig;
  rig.directionals = {{normalize(Vec3(0.2f, 0.3f, 0.9f)), Rgb(2, 3, 4)}};
  const ShRgb whole = projectLights(rig, 5);
  const Vec3 to = rig.directionals[0].direction;
  EXPECT_LT(size(lit(cubeOf(disc(to, 0.2, Rgb(0))), rig, 5)), 1e-6 * size(whole));
  EXPECT_EQ(difference(lit(cubeOf(disc(-to, 0.2, Rgb(0))), rig, 5), whole), 0);
  const CapturedCube haze = cubeOf([](const Vec3&) { return Vec4(0, 0, 0, 0.25f); });
  EXPECT_NEAR(size(lit(haze, rig, 5)) / size(whole), 0.75, 1e-6);
}

/// The integral itself, at a million directions: the slow twin.
TEST(Captured, IsTheIntegralOverAllDirections) {
  const LightRig rig = everyKind();
  const Seen seen = [](const Vec3& d) {
    const bool there = std::sin(5 * d.x + 1) + std::cos(4 * d.y) * std::sin(3 * d.z) > 0.6f;
    return there ? Vec4(0.5f + d.x, 1.5f, 2 + d.z, 1) : Vec4(0);
  };
  constexpr int kBands = 4, kRows = 700;
  std::vector<DVec3> sum(16, DVec3(0));
  std::vector<double> y(16);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < 2 * kRows; ++column) {
      const double z = 1 - 2 * (row + 0.5) / kRows, r = std::sqrt(1 - z * z),
                   phi = kPi * (column + 0.5) / kRows;
      const DVec3 d(r * std::cos(phi), r * std::sin(phi), z);
      const Vec4 here = seen(Vec3(d));
      const Rgb light = here.w > 0 ? Rgb(here) : radiance(rig, Vec3(d));
      shEvaluate(kBands, d, y);
      for (std::size_t k = 0; k < y.size(); ++k)
        sum[k] += y[k] * (4 * kPi / (2.0 * kRows * kRows)) * DVec3(light);
    }
  ShRgb expected(kBands);
  for (std::size_t k = 0; k < sum.size(); ++k) expected.c[k] = Rgb(sum[k]);
  // The map's pixels of 6 degrees are all or nothing here and soft there, at the borders of what stands.
  EXPECT_LT(difference(lit(cubeOf(seen), rig, kBands), expected), 0.01);
  EXPECT_GT(difference(projectLights(rig, kBands), expected), 0.1) << "there is something to see";
}

}  // namespace
}  // namespace prt
