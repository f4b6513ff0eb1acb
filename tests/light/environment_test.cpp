#include "libprt/core/error.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/resample.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

using M = EnvironmentMapping;
using test::energy;
using test::mapOf;
using test::oneOfEach;
using test::setPixel;

/// A smooth scene with something different in each direction.
Rgb scenery(const DVec3& d) {
  return {float(1 + 0.8 * d.x), float(1 + 0.5 * d.y + 0.4 * d.x * d.z), float(1.5 - d.z + 0.3 * d.y * d.y)};
}

TEST(Environment, EveryMappingShowsTheSameSceneInTheSameDirections) {
  std::mt19937 random(1);
  for (const MapGeometry& g : oneOfEach(64)) {
    const EnvironmentMap map = mapOf(g, scenery);
    for (int i = 0; i < 3000; ++i) {
      const DVec3 d = test::randomDirection(random);
      EXPECT_LT(length(map.radiance(Vec3(d)) - scenery(d)), 0.08f) << toString(g.mapping());
    }
  }
}

TEST(Environment, IsConstantOverEachTexel) {
  for (const MapGeometry& g : oneOfEach(5)) {
    const EnvironmentMap map = test::randomMap(g, 3);
    for (int y = 0; y < g.height(); ++y)
      for (int x = 0; x < g.width(); ++x)
        for (const TexelNode& node : g.nodes(x, y, 3)) {
          EXPECT_EQ(map.radiance(Vec3(node.direction)), map.pixels().rgb(x, y)) << toString(g.mapping());
        }
  }
}

TEST(Environment, ForEachTexelVisitsTheWholeSphereOnce) {
  for (const MapGeometry& g : oneOfEach(9)) {
    double sum = 0;
    std::size_t count = 0;
    const EnvironmentMap map = mapOf(g, scenery);
    map.forEachTexel([&](int x, int y, const DVec3& d, double solidAngle, const Rgb& c) {
      sum += solidAngle, ++count;
      EXPECT_EQ(c, map.radiance(Vec3(d)));
      EXPECT_TRUE(g.covers(x, y));
    });
    EXPECT_NEAR(sum, 4 * kPi, 1e-5);
    EXPECT_EQ(count, map.report().covered);
  }
}

TEST(Environment, MasksLabelsOutsideTheMappingAndCountsThem) {
  for (const MapGeometry& g : oneOfEach(8)) {
    const EnvironmentMap clean = mapOf(g, scenery), labelled = mapOf(g, scenery, Rgb(5));
    const bool full = clean.report().covered == clean.pixels().pixels();
    EXPECT_EQ(labelled.report().labels, full ? 0 : clean.pixels().pixels() - clean.report().covered);
    EXPECT_EQ(labelled.pixels().data, clean.pixels().data) << toString(g.mapping());
    EXPECT_LT(length(labelled.report().mean - clean.report().mean), 1e-6f);
  }
}

TEST(Environment, TheRimOfAnAngularMapTakesItsColourFromInside) {
  // Black outside of the disc must not darken the directions near the rim.
  const MapGeometry g(M::AngularMap, 31, 31);
  Image image(31, 31, 3);
  for (int y = 0; y < 31; ++y)
    for (int x = 0; x < 31; ++x)
      setPixel(image, x, y, Rgb(std::hypot(x - 15.0, y - 15.0) < 15.5 ? 2.0f : 0.0f));
  const EnvironmentMap map(image, M::AngularMap);
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    DVec3 d = test::randomDirection(random);
    if (i % 2) d = normalize(DVec3(0.1 * d.x, 0.1 * d.y, 1));  // many near the rim
    EXPECT_EQ(map.radiance(Vec3(d)), Rgb(2));
  }
}

TEST(Environment, MendsWhatCannotBeLightAndReportsIt) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Image image(4, 2, 3);
  for (float& value : image.data) value = 1;
  setPixel(image, 0, 0, Rgb(-1, 2, 3));
  setPixel(image, 1, 0, Rgb(nan, 0, 0));
  setPixel(image, 2, 0, Rgb(1, inf, 1));
  setPixel(image, 3, 0, Rgb(1, 65504, 1));
  setPixel(image, 0, 1, Rgb(-inf, -1, nan));
  setPixel(image, 1, 1, Rgb(3e38f, 1, 1));
  const EnvironmentMap map(image, M::LatLong, "bad.exr");
  EXPECT_EQ(map.report().negative, 2u);
  EXPECT_EQ(map.report().nonFinite, 4u);
  EXPECT_EQ(map.report().atHalfMax, 1u);
  EXPECT_EQ(map.pixels().rgb(0, 0), Rgb(0, 2, 3));
  EXPECT_EQ(map.pixels().rgb(1, 0), Rgb(0));
  EXPECT_EQ(map.pixels().rgb(2, 0), Rgb(1, 65504, 1));
  EXPECT_EQ(map.pixels().rgb(0, 1), Rgb(0));
  EXPECT_EQ(map.pixels().rgb(1, 1), Rgb(65504, 1, 1));
  EXPECT_NE(map.report().warning().find("2 negative"), std::string::npos);
  EXPECT_NE(map.report().warning().find("65504"), std::string::npos);
  EXPECT_EQ(mapOf(MapGeometry(M::LatLong, 4, 2), scenery).report().warning(), "");
}

TEST(Environment, TellsItsRangeAndMean) {
  const MapGeometry g(M::LatLong, 16, 8);
  const EnvironmentMap map = mapOf(g, [](const DVec3& d) { return Rgb(d.y > 0 ? 4.0f : 0.5f); });
  EXPECT_FLOAT_EQ(map.report().largest, 4);
  EXPECT_FLOAT_EQ(map.report().smallest, 0.5f);
  EXPECT_NEAR(map.report().stops(), 3, 1e-6);
  EXPECT_NEAR(map.report().mean.y, 2.25, 1e-6);
}

TEST(Environment, ReadsGreyImagesAndRefusesEmptyOnes) {
  Image grey(4, 2, 1);
  for (float& value : grey.data) value = 0.5f;
  EXPECT_EQ(EnvironmentMap(grey, M::LatLong).radiance({0, 1, 0}), Rgb(0.5f));
  EXPECT_THROW(EnvironmentMap(Image(), M::LatLong), ValueError);
  EXPECT_THROW(EnvironmentMap(grey, M::AngularMap), ValueError);
}

TEST(Environment, DetectsItsMappingFromShapeAndContent) {
  for (const MapGeometry& g : oneOfEach(16)) {
    EXPECT_EQ(detectMapping(mapOf(g, scenery).pixels()), g.mapping()) << toString(g.mapping());
    // a label in one corner, as on the probes in circulation
    Image labelled = mapOf(g, scenery).pixels();
    for (int y = g.height() - 3; y < g.height(); ++y)
      for (int x = g.width() - 9; x < g.width(); ++x) setPixel(labelled, x, y, Rgb(1));
    EXPECT_EQ(detectMapping(labelled), g.mapping()) << toString(g.mapping());
  }
}

TEST(Environment, DoesNotTakePhotographsForCrossesOrAngularMaps) {
  for (const auto& [width, height] :
       {std::pair(48, 64), std::pair(64, 48), std::pair(64, 64), std::pair(100, 37)}) {
    Image photograph(width, height, 3);
    std::mt19937 random(7);
    for (float& value : photograph.data) value = std::uniform_real_distribution<float>(0.2f, 1)(random);
    EXPECT_EQ(detectMapping(photograph), std::nullopt) << width << " x " << height;
  }
}

TEST(Environment, ToLatLongKeepsEnergyAndConstants) {
  for (const MapGeometry& g : oneOfEach(24))
    for (const auto& [width, height] :
         {std::pair(64, 32), std::pair(96, 48), std::pair(13, 7), std::pair(256, 128)}) {
      const EnvironmentMap map = test::randomMap(g, 5, 1e6f), resampled = toLatLong(map, width, height);
      EXPECT_EQ(resampled.width(), width);
      EXPECT_LT(length(energy(resampled) / energy(map) - DVec3(1)), 1e-5) << toString(g.mapping());
      const EnvironmentMap white = toLatLong(mapOf(g, [](const DVec3&) { return Rgb(1); }), width, height);
      for (const float value : white.pixels().data)
        EXPECT_NEAR(value, 1, 1e-5) << toString(g.mapping()) << " " << width;
    }
}

TEST(Environment, ToLatLongKeepsTheEnergyOfASun) {
  std::mt19937 random(8);
  for (const MapGeometry& g : oneOfEach(40))
    for (const int width : {60, 160, 400})
      for (int trial = 0; trial < 5; ++trial) {
        const Vec2 sun = g.toImage(Vec3(test::randomDirection(random)));
        EnvironmentMap sky = mapOf(g, [](const DVec3&) { return Rgb(1); });
        Image image = sky.pixels();
        setPixel(image, int(sun.x), int(sun.y), Rgb(1e6f));
        const EnvironmentMap map(image, g.mapping());
        // nearly all energy is the sun's wherever its texel is not one of the vanishing ones at a pole or rim
        const double share = g.solidAngle(int(sun.x), int(sun.y)) * 1e6 / energy(map).x;
        if (share < 0.99) continue;
        const EnvironmentMap resampled = toLatLong(map, width, width / 2);
        double lit = 0;
        resampled.forEachTexel([&](int, int, const DVec3&, double solidAngle, const Rgb& c) {
          if (c.x > 2) lit += solidAngle * c.x;
        });
        EXPECT_NEAR(lit / (energy(map).x * share), 1, 2e-3) << toString(g.mapping()) << " " << width;
        // and the sky around it is not touched
        EXPECT_NEAR(resampled.radiance(-Vec3(g.center(int(sun.x), int(sun.y)))).x, 1, 1e-3);
      }
}

TEST(Environment, ToLatLongKeepsDirections) {
  std::mt19937 random(4);
  for (const MapGeometry& g : oneOfEach(48)) {
    const EnvironmentMap map = toLatLong(mapOf(g, scenery), 128, 64);
    for (int i = 0; i < 2000; ++i) {
      const DVec3 d = test::randomDirection(random);
      EXPECT_LT(length(map.radiance(Vec3(d)) - scenery(d)), 0.08f) << toString(g.mapping());
    }
  }
}

TEST(Environment, ToLatLongOfTheSameSizeChangesNothing) {
  const EnvironmentMap map = test::randomMap(MapGeometry(M::LatLong, 20, 10), 6);
  const EnvironmentMap same = toLatLong(map, 20, 10);
  for (std::size_t i = 0; i < map.pixels().data.size(); ++i)
    EXPECT_NEAR(same.pixels().data[i], map.pixels().data[i], 1e-5f);
}

TEST(Environment, BlurringKeepsTheEnergyAndSpreadsWhatIsSharp) {
  const EnvironmentMap white = blurredLatLong(
      mapOf(MapGeometry(EnvironmentMapping::LatLong, 40, 20), [](const DVec3&) { return Rgb(1); }), 0.2);
  for (const float value : white.pixels().data) EXPECT_NEAR(value, 1, 1e-5);
  const EnvironmentMap lamp = mapOf(MapGeometry(EnvironmentMapping::LatLong, 256, 128),
                                    [](const DVec3& d) { return d.x > 0.999 ? Rgb(100, 50, 10) : Rgb(0); });
  const EnvironmentMap blurred = blurredLatLong(lamp, 0.2);
  EXPECT_LT(length(test::energy(blurred) / test::energy(lamp) - DVec3(1)), 0.02);
  // A Gaussian of this width about the lamp.
  const float middle = blurred.radiance(Vec3(1, 0, 0)).x,
              off = blurred.radiance(Vec3(std::cos(0.4f), std::sin(0.4f), 0)).x;
  EXPECT_NEAR(off / middle, std::exp(-2.0f), 0.06f);
}

}  // namespace
}  // namespace prt
