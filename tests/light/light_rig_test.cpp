#include "libprt/light/light_rig.h"
#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace prt {
namespace {

using M = EnvironmentMapping;

std::shared_ptr<const EnvironmentMap> share(EnvironmentMap map) {
  return std::make_shared<const EnvironmentMap>(std::move(map));
}

/// A map that is bright around -Z only.
EnvironmentMap frontLight(int width) {
  return test::mapOf(MapGeometry(M::LatLong, width, width / 2),
                     [](const DVec3& d) { return Rgb(d.z < -0.9 ? 1.0f : 0.0f); });
}

double difference(const ShRgb& a, const ShRgb& b) {
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < b.c.size(); ++k)
    worst = std::max(worst, double(length(a.c[k] - b.c[k]))), scale = std::max(scale, double(length(b.c[k])));
  return worst / scale;
}

TEST(LightRig, APositiveRotationBringsTheLightFromTheFrontToTheLeft) {
  LightRig rig;
  rig.environment = share(frontLight(64));
  EXPECT_EQ(radiance(rig, {0, 0, -1}), Rgb(1));
  rig.rotation = float(kPi / 2);
  EXPECT_EQ(radiance(rig, {0, 0, -1}), Rgb(0));
  EXPECT_EQ(radiance(rig, {-1, 0, 0}), Rgb(1));
  const ShRgb light = projectLights(rig, 3);
  EXPECT_LT(light.c[3].x, -0.1f) << "the x component of the first band";
  EXPECT_NEAR(light.c[2].x, 0, 1e-3f);
}

TEST(LightRig, RotatingTheCoefficientsIsRotatingTheMap) {
  // By whole columns, where the turned map is a map again.
  const MapGeometry g(M::LatLong, 24, 12);
  const EnvironmentMap map = test::randomMap(g, 31, 40);
  for (const int columns : {1, 6, 17}) {
    Image turned(24, 12, 3);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 24; ++x) test::setPixel(turned, (x + 24 - columns) % 24, y, map.pixels().rgb(x, y));
    LightRig rig;
    rig.environment = share(map);
    rig.rotation = float(2 * kPi * columns / 24);
    EXPECT_LT(difference(projectLights(rig, 6), projectEnvironment(EnvironmentMap(turned, M::LatLong), 6)),
              2e-6);
  }
}

TEST(LightRig, RotatedCoefficientsMatchASumOverRotatedLookups) {
  LightRig rig;
  rig.environment = share(test::randomMap(MapGeometry(M::VerticalCross, 12, 16), 32));
  rig.rotation = -2.1f;
  rig.intensity = 3;
  const int rows = 400, columns = 800;
  std::vector<DVec3> sum(16, DVec3(0));
  std::vector<double> y(16);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double polar = kPi * (r + 0.5) / rows, azimuth = 2 * kPi * (c + 0.5) / columns;
      const DVec3 d(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                    std::sin(polar) * std::sin(azimuth));
      shEvaluate(4, d, y);
      const double area = std::sin(polar) * 2 * std::sin(0.5 * kPi / rows) * 2 * kPi / columns;
      for (std::size_t k = 0; k < 16; ++k) sum[k] += area * y[k] * DVec3(radiance(rig, Vec3(d)));
    }
  const ShRgb light = projectLights(rig, 4);
  for (std::size_t k = 0; k < 16; ++k) EXPECT_LT(length(DVec3(light.c[k]) - sum[k]), 2e-2) << k;
}

TEST(LightRig, LightsAddUp) {
  LightRig all, map, circle, sun, glow;
  all.environment = map.environment = share(test::randomMap(MapGeometry(M::LatLong, 16, 8), 33));
  all.rotation = map.rotation = 0.4f;
  all.circles = circle.circles = {{normalize(Vec3(1, 2, 0)), 0.4f, Rgb(3, 2, 1)}};
  all.directionals = sun.directionals = {{normalize(Vec3(-1, 1, 1)), Rgb(2)}};
  all.constant = glow.constant = Rgb(0.1f, 0.2f, 0.3f);
  ShRgb sum(5);
  for (const LightRig& rig : {map, circle, sun, glow}) {
    const ShRgb part = projectLights(rig, 5);
    for (std::size_t k = 0; k < 25; ++k) sum.c[k] += part.c[k];
  }
  EXPECT_LT(difference(projectLights(all, 5), sum), 1e-6);
  EXPECT_LT(difference(projectLights(all, projectEnvironment(*all.environment, 5)), sum), 1e-6);
}

TEST(LightRig, AConstantIsTheFirstFunctionAlone) {
  LightRig rig;
  rig.constant = Rgb(1, 2, 3);
  const ShRgb light = projectLights(rig, 4);
  for (std::size_t k = 0; k < 16; ++k)
    EXPECT_LT(length(light.c[k] - (k == 0 ? Rgb(1, 2, 3) * float(std::sqrt(4 * kPi)) : Rgb(0))), 1e-6f);
}

TEST(LightRig, ADirectionalLightIsItsIrradianceTimesY) {
  LightRig rig;
  rig.directionals = {{normalize(Vec3(1, -2, 0.5f)), Rgb(2, 3, 4)}};
  const ShRgb light = projectLights(rig, 5);
  std::vector<double> y(25);
  shEvaluate(5, DVec3(rig.directionals[0].direction), y);
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(light.c[k].y, 3 * y[k], 2e-6);
}

TEST(LightRig, ACircleLightHasTheGoldenCoefficients) {
  // the 110 degree light of the bi-scale paper, about +Z
  LightRig rig;
  rig.circles = {{Vec3(0, 0, 1), float(radians(55)), Rgb(1)}};
  const ShRgb light = projectLights(rig, 5);
  const std::vector<double> golden{0.75582, 1.02999, 0.76269, 0.25368, -0.17832};
  for (int l = 0; l < 5; ++l)
    for (int m = -l; m <= l; ++m)
      EXPECT_NEAR(light.c[std::size_t(shIndex(l, m))].x, m == 0 ? golden[std::size_t(l)] : 0, 1e-5);
}

TEST(LightRig, ATinyCircleIsADirectionalLight) {
  LightRig circle, directional;
  const Vec3 d = normalize(Vec3(0.3f, 0.9f, -0.2f));
  for (const double degrees : {0.2665, 0.01, 1e-4}) {
    circle.circles = {{d, float(radians(degrees)), Rgb(1e4f)}};
    directional.directionals = {{d, Rgb(1e4f * float(solidAngle(circle.circles[0])))}};
    // the disc weakens band l by l(l+1) a^2/8
    EXPECT_LT(difference(projectLights(circle, 9), projectLights(directional, 9)),
              72 * std::pow(radians(degrees), 2) / 8 + 1e-6)
        << degrees;
  }
}

TEST(LightRig, AFullCircleIsAConstant) {
  LightRig rig;
  rig.circles = {{normalize(Vec3(1, 1, 1)), kPiF, Rgb(1)}};
  const ShRgb light = projectLights(rig, 5);
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(light.c[k].x, k == 0 ? std::sqrt(4 * kPi) : 0, 1e-5);
  EXPECT_EQ(radiance(rig, -rig.circles[0].direction), Rgb(1));
}

TEST(LightRig, CirclesEndAtTheirHalfAngle) {
  for (const float angle : {0.004f, 0.5f, 2.5f}) {
    const CircleLight light{Vec3(0, 1, 0), angle, Rgb(1)};
    const auto at = [](double a) { return Vec3(0, float(std::cos(a)), float(std::sin(a))); };
    EXPECT_TRUE(contains(light, at(0.999 * angle))) << angle;
    EXPECT_FALSE(contains(light, at(1.001 * angle))) << angle;
  }
}

TEST(LightRig, BadLightsAreRefusedByName) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<std::function<void(LightRig&)>, std::string>> cases{
      {[&](LightRig& r) { r.rotation = nan; }, "environment"},
      {[](LightRig& r) { r.intensity = -1; }, "environment"},
      {[](LightRig& r) { r.constant = Rgb(-1, 0, 0); }, "constant"},
      {[](LightRig& r) {
         r.circles = {{}, {Vec3(0), 0.5f, Rgb(1)}};
       },
       "circle light 1"},
      {[](LightRig& r) {
         r.circles = {{Vec3(0, 1, 0), 4.0f, Rgb(1)}};
       },
       "circle light 0"},
      {[](LightRig& r) {
         r.circles = {{Vec3(0, 1, 0), 0.0f, Rgb(1)}};
       },
       "circle light 0"},
      {[&](LightRig& r) {
         r.directionals = {{Vec3(0, 1, 0), Rgb(nan)}};
       },
       "directional light 0"},
      {[](LightRig& r) {
         r.directionals = {{Vec3(0, 2, 0), Rgb(1)}};
       },
       "directional light 0"}};
  EXPECT_NO_THROW(validate(LightRig{}));
  for (const auto& [spoil, where] : cases) {
    LightRig rig;
    spoil(rig);
    try {
      validate(rig);
      ADD_FAILURE() << where;
    } catch (const ValueError& error) {
      EXPECT_NE(error.where().find(where), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace prt
