#include "libprt/light/built_in_skies.h"
#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/light/sky_angles.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

/// Radiance of a white plane with this normal.
Rgb planeRadiance(const EnvironmentMap& map, const DVec3& normal) {
  DVec3 sum(0);
  map.forEachTexel([&](int x, int y, const DVec3&, double, const Rgb& c) {
    for (const TexelNode& node : map.geometry().nodes(x, y, 2))
      sum += node.weight * std::max(0.0, dot(node.direction, normal)) * DVec3(c);
  });
  return Rgb(sum / kPi);
}

TEST(BuiltInSkies, ALevelWhitePlaneLooksOneUnderTheSkies) {
  for (const std::string name : {"clear-sky", "overcast"})
    for (const int width : {128, 512})
      EXPECT_NEAR(luminance(planeRadiance(builtInSky(name, width, width / 2), {0, 1, 0})), 1, 1e-3) << name;
}

TEST(BuiltInSkies, TheSunStandsWhereItIsPutWithItsWholeEnergyAtAnySize) {
  const Vec3 toSun = normalize(Vec3(-0.4f, 0.5f, -0.7f));
  std::vector<double> suns;
  for (const int width : {64, 256, 777}) {
    const EnvironmentMap with = clearSky({.sunDirection = toSun}, width, width / 2);
    const EnvironmentMap without = clearSky({.sunDirection = toSun, .sun = false}, width, width / 2);
    // The sky fixes the scale; the ground only reflects.
    const float scale = luminance(without.radiance({0, 1, 0})) / luminance(with.radiance({0, 1, 0}));
    double sun = 0, sky = 0;
    DVec3 direction(0);
    with.forEachTexel([&](int x, int y, const DVec3& d, double solidAngle, const Rgb& c) {
      if (d.y <= 0) return;
      const double plain = luminance(without.pixels().rgb(x, y)), light = scale * luminance(c) - plain;
      sun += solidAngle * light, sky += solidAngle * d.y * plain, direction += solidAngle * light * d;
    });
    EXPECT_GT(dot(normalize(direction), DVec3(toSun)), std::cos(2 * kPi / width)) << width;
    suns.push_back(sun / sky);
  }
  // Direct over diffuse light as the IES formulas have it, at this height of the sun.
  const double sine = toSun.y,
               mass = 1 / (sine + 0.50572 * std::pow(degrees(std::asin(sine)) + 6.07995, -1.6364));
  const double expected = 127.5 * std::exp(-0.21 * mass) / (0.8 + 15.5 * std::sqrt(sine));
  for (const double ratio : suns) EXPECT_NEAR(ratio / expected, 1, 5e-3);
}

TEST(BuiltInSkies, TheClearSkyIsBluerAwayFromTheSunAndDarkestOppositeIt) {
  const ClearSky sky{.sunDirection = normalize(Vec3(1, 1, 0)), .sun = false};
  const EnvironmentMap map = clearSky(sky);
  const Rgb opposite = map.radiance(normalize(Vec3(-1, 1.2f, 0))),
            near = map.radiance(normalize(Vec3(1, 0.8f, 0)));
  EXPECT_GT(luminance(near), 3 * luminance(opposite));
  EXPECT_GT(opposite.z / opposite.x, near.z / near.x);
  EXPECT_GT(luminance(map.radiance(normalize(Vec3(0, 0.05f, -1)))),
            luminance(map.radiance(normalize(Vec3(-0.2f, 1, -0.5f)))));
}

TEST(BuiltInSkies, ASunBelowTheHorizonIsRefused) {
  EXPECT_THROW(clearSky({.sunDirection = Vec3(1, 0, 0)}), ValueError);
  EXPECT_THROW(clearSky({.sunDirection = Vec3(0, -1, 0)}), ValueError);
  EXPECT_THROW(clearSky({.sunDirection = Vec3(std::numeric_limits<float>::quiet_NaN())}), ValueError);
}

/// Relative difference, all bands together.
double difference(const ShRgb& a, const ShRgb& b) {
  double apart = 0, all = 0;
  for (std::size_t k = 0; k < a.c.size(); ++k)
    apart += dot(DVec3(a.c[k] - b.c[k]), DVec3(a.c[k] - b.c[k])), all += dot(DVec3(b.c[k]), DVec3(b.c[k]));
  return std::sqrt(apart / all);
}

TEST(BuiltInSkies, TheQuickSkyIsTheClearSkyInTheBandsOfTransfer) {
  for (const auto& [azimuth, elevation] : {std::pair(-170.0, 2.0), {33.3, 30.0}, {120.0, 80.0}}) {
    const ClearSky sky{.sunDirection = directionOf(SkyAngles{radians(azimuth), radians(elevation)})};
    // On so fine a map that the sun stands where it is put: texels of 0.18 degrees.
    const ShRgb exact = projectEnvironment(clearSky(sky, 2048, 1024), 10);
    EXPECT_LT(difference(quickClearSky(sky, 10).coefficients, exact), 0.01) << elevation << " " << azimuth;
  }
}

TEST(BuiltInSkies, TheQuickSkyMovesSmoothlyWithItsSun) {
  // Steps of a twentieth of a coarse texel: each moves the light by about as much as the others.
  double least = 1, most = 0;
  ShRgb last;
  for (int i = 0; i <= 20; ++i) {
    const ClearSky sky{.sunDirection = directionOf(SkyAngles{0, radians(40 + i * 2.8125 / 20)})};
    const ShRgb now = quickClearSky(sky, 5).coefficients;
    if (i > 0) least = std::min(least, difference(now, last)), most = std::max(most, difference(now, last));
    last = now;
  }
  EXPECT_LT(most, 1.2 * least);
}

TEST(BuiltInSkies, TheOvercastSkyFollowsTheCieGradation) {
  const EnvironmentMap map = overcastSky();
  const float zenith = luminance(map.radiance({0, 1, 0}));
  for (const double elevation : {0.1, 0.5, 1.0}) {
    const Vec3 d(float(std::cos(elevation)), float(std::sin(elevation)), 0);
    EXPECT_NEAR(luminance(map.radiance(d)) / zenith, (1 + 2 * d.y) / 3, 0.01);
  }
  // zenith luminance of a sky with level irradiance pi: 9/7
  EXPECT_NEAR(zenith, 9.0 / 7, 0.01);
}

TEST(BuiltInSkies, TheStudioLightsFromTheLeftFrontMost) {
  const EnvironmentMap map = softboxStudio();
  const auto at = [&](const DVec3& normal) { return luminance(planeRadiance(map, normalize(normal))); };
  EXPECT_GT(at({-0.8, 0.7, 0.9}), 2 * at({1, 0.2, 0.5}));
  EXPECT_GT(at({1, 0.2, 0.5}), at({0, -1, 0}));
  EXPECT_GT(at({0.3, 0.5, -1}), at({-1, 0, -1}));
}

TEST(BuiltInSkies, TheOrientationMapHasEachAxisInItsColour) {
  const EnvironmentMap map = orientationMap();
  // beside the letters, which cover the middle of the sides
  const auto at = [&](Vec3 axis, Vec3 aside) { return map.radiance(normalize(axis + 0.75f * aside)); };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const Rgb px = at(x, y), nx = at(-x, y), py = at(y, z), ny = at(-y, z), pz = at(z, y), nz = at(-z, y);
  EXPECT_TRUE(px.x > 3 * px.y && px.x > 3 * px.z);
  EXPECT_TRUE(nx.y > 3 * nx.x && nx.z > 3 * nx.x);
  EXPECT_TRUE(py.y > 3 * py.x && py.y > 3 * py.z);
  EXPECT_TRUE(ny.x > 3 * ny.y && ny.z > 3 * ny.y);
  EXPECT_TRUE(pz.z > 3 * pz.x && pz.z > 3 * pz.y);
  EXPECT_TRUE(nz.x > 3 * nz.z && nz.y > 3 * nz.z);
}

TEST(BuiltInSkies, LettersReadFromLeftToRightSeenFromTheInside) {
  // On +X the sign's plus stands left of the letter: towards -Z for a viewer inside, whose right is +Z.
  const EnvironmentMap map = orientationMap();
  EXPECT_GT(luminance(map.radiance(normalize(Vec3(1, 0, -0.375f)))), 0.9f) << "the centre of the plus";
  EXPECT_GT(luminance(map.radiance(normalize(Vec3(1, 0, 0.375f)))), 0.9f) << "the centre of the X";
  EXPECT_LT(luminance(map.radiance(normalize(Vec3(1, 0.25f, 0.375f)))), 0.5f) << "between the arms of the X";
  EXPECT_GT(luminance(map.radiance(normalize(Vec3(1, 0.25f, -0.375f)))), 0.9f) << "the upper arm of the plus";
}

TEST(BuiltInSkies, AllAreListedAndUnknownOnesNameThem) {
  for (const BuiltInSky& sky : builtInSkies()) {
    const EnvironmentMap map = builtInSky(sky.name, 64, 32);
    EXPECT_EQ(map.width(), 64);
    EXPECT_EQ(map.report().warning(), "") << sky.name;
    EXPECT_FALSE(sky.description.empty());
  }
  try {
    builtInSky("sunset");
    FAIL();
  } catch (const ValueError& error) {
    EXPECT_NE(std::string(error.what()).find("overcast"), std::string::npos);
  }
}

}  // namespace
}  // namespace prt
