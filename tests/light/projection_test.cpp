#include "libprt/light/projection.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using M = EnvironmentMapping;
using test::mapOf;
using test::oneOfEach;
using test::randomMap;

/// The definition: the sum over texels of radiance times the integral of Y over the texel, by a high-order
/// rule.
std::vector<DVec3> plainProjection(const EnvironmentMap& map, int bands, int order) {
  std::vector<DVec3> sum(std::size_t(shCount(bands)), DVec3(0));
  std::vector<double> y(sum.size());
  map.forEachTexel([&](int px, int py, const DVec3&, double, const Rgb& c) {
    for (const TexelNode& node : map.geometry().nodes(px, py, order)) {
      shEvaluate(bands, node.direction, y);
      for (std::size_t k = 0; k < y.size(); ++k) sum[k] += node.weight * y[k] * DVec3(c);
    }
  });
  return sum;
}

double difference(const ShRgb& a, const std::vector<DVec3>& b) {
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    worst = std::max(worst, length(DVec3(a.c[k]) - b[k])), scale = std::max(scale, length(b[k]));
  return worst / scale;
}

double difference(const ShRgb& a, const ShRgb& b) {
  return difference(a, std::vector<DVec3>(b.c.begin(), b.c.end()));
}

TEST(Projection, AConstantSkyIsTheFirstFunctionAlone) {
  for (const int cell : {2, 16, 70})
    for (const MapGeometry& g : oneOfEach(cell)) {
      const ShRgb light = projectEnvironment(mapOf(g, [](const DVec3&) { return Rgb(1); }), 6);
      // large maps take Y at texel centres: exact to the bound of nodesPerSide
      for (std::size_t k = 0; k < light.c.size(); ++k)
        EXPECT_NEAR(light.c[k].x, k == 0 ? std::sqrt(4 * kPi) : 0, 4e-5)
            << toString(g.mapping()) << " " << cell << " function " << k;
    }
}

TEST(Projection, SmallMapsAreIntegratedOverTheirTexels) {
  for (const int cell : {1, 3, 8})
    for (const MapGeometry& g : oneOfEach(cell)) {
      const EnvironmentMap map = randomMap(g, 11, 50);
      EXPECT_LT(difference(projectEnvironment(map, 6), plainProjection(map, 6, 16)), 2e-6)
          << toString(g.mapping()) << " " << cell;
    }
}

TEST(Projection, ManyBandsOfALatLongMapMatchThePlainSum) {
  const EnvironmentMap map = randomMap(MapGeometry(M::LatLong, 20, 11), 12, 10);
  EXPECT_LT(difference(projectEnvironment(map, 24), plainProjection(map, 24, 20)), 2e-6);
}

TEST(Projection, LookupsAndProjectionDescribeTheSameFunction) {
  // Sum over a fine grid of directions of what radiance() says: nothing of the map's geometry goes in.
  const int rows = 500, columns = 1000;
  for (const MapGeometry& g : oneOfEach(4)) {
    const EnvironmentMap map = randomMap(g, 13);
    std::vector<DVec3> sum(25, DVec3(0));
    std::vector<double> y(25);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const double polar = kPi * (r + 0.5) / rows, azimuth = 2 * kPi * (c + 0.5) / columns;
        const DVec3 d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                      std::cos(polar));
        const double area = std::sin(polar) * 2 * std::sin(0.5 * kPi / rows) * 2 * kPi / columns;
        shEvaluate(5, d, y);
        for (std::size_t k = 0; k < 25; ++k) sum[k] += area * y[k] * DVec3(map.radiance(Vec3(d)));
      }
    EXPECT_LT(difference(projectEnvironment(map, 5), sum), 1e-3) << toString(g.mapping());
  }
}

TEST(Projection, EveryMappingOfOneSceneGivesTheSameCoefficients) {
  // Band-limited to 3 bands, so its own coefficients are the reference.
  ShRgb scene(3);
  for (std::size_t k = 0; k < 9; ++k) scene.c[k] = Rgb(0.1f * float(k), 0.3f - 0.1f * float(k), 0.2f);
  scene.c[0] = Rgb(6);
  for (const MapGeometry& g : oneOfEach(128)) {
    const EnvironmentMap map = mapOf(g, [&](const DVec3& d) { return scene.evaluate(Vec3(d)); });
    EXPECT_LT(difference(projectEnvironment(map, 3), scene), 2e-4) << toString(g.mapping());
  }
}

TEST(Projection, KeepsTheEnergyOfASunAMillionTimesBrighterThanTheSky) {
  for (const MapGeometry& g : oneOfEach(32)) {
    const Vec2 sun = g.toImage(normalize(Vec3(0.3f, 0.8f, -0.4f)));
    Image image = mapOf(g, [](const DVec3&) { return Rgb(1); }).pixels();
    test::setPixel(image, int(sun.x), int(sun.y), Rgb(1e6f));
    const EnvironmentMap map(image, g.mapping());
    const double exact = 4 * kPi + (1e6 - 1) * g.solidAngle(int(sun.x), int(sun.y));
    const ShRgb light = projectEnvironment(map, 5);
    EXPECT_NEAR(light.c[0].x * std::sqrt(4 * kPi) / exact, 1, 1e-6) << toString(g.mapping());
    // and its direction: the first band points at the sun
    const Vec3 first = normalize(Vec3(light.c[3].x, light.c[1].x, light.c[2].x));
    EXPECT_GT(dot(first, Vec3(g.center(int(sun.x), int(sun.y)))), 1 - 2e-5f) << toString(g.mapping());
  }
}

TEST(Projection, IsTheSameForAnyNumberOfThreads) {
  for (const MapGeometry& g : oneOfEach(30)) {
    const EnvironmentMap map = randomMap(g, 14, 1000);
    std::vector<ShRgb> results;
    for (const int threads : {1, 2, 5}) {
      setThreadCount(threads);
      results.push_back(projectEnvironment(map, 5));
    }
    setThreadCount(0);
    EXPECT_EQ(results[0].c, results[1].c) << toString(g.mapping());
    EXPECT_EQ(results[0].c, results[2].c) << toString(g.mapping());
  }
}

TEST(Projection, CanBeCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(projectEnvironment(randomMap(MapGeometry(M::LatLong, 64, 32), 1), 5, job), Cancelled);
}

TEST(Projection, RefusesBandsItCannotDo) {
  const EnvironmentMap map = randomMap(MapGeometry(M::LatLong, 4, 2), 1);
  EXPECT_THROW(projectEnvironment(map, 0), ValueError);
  EXPECT_THROW(projectEnvironment(map, kMaxShBands + 1), ValueError);
  EXPECT_THROW(bandLimitedMap(ShRgb(), 8, 4), ValueError);
}

TEST(Projection, ABandLimitedMapProjectsBackToItsLight) {
  const ShRgb raw = projectEnvironment(randomMap(MapGeometry(M::VerticalCross, 24, 32), 15, 200), 5);
  const ShRgb light = nonNegativeLight(raw);
  for (const auto& [width, height] : {std::pair(256, 128), std::pair(48, 24)}) {
    const EnvironmentMap map = bandLimitedMap(light, width, height);
    // The mean over texels attenuates band l by about 1 - (l h)^2/24, twice nothing else.
    const double step = 4 * kPi / height;
    EXPECT_LT(difference(projectEnvironment(map, 5), light), step * step / 12) << width;
    EXPECT_NEAR(projectEnvironment(map, 5).c[0].x / light.c[0].x, 1, 1e-6) << width;
  }
}

TEST(Projection, NonNegativeLightIsNotNegative) {
  // The worst case is a point of light in the dark.
  ShRgb point(5);
  std::vector<double> y(25);
  shEvaluate(5, normalize(DVec3(1, 2, 3)), y);
  for (std::size_t k = 0; k < 25; ++k) point.c[k] = Rgb(float(y[k]));
  const ShRgb light = nonNegativeLight(point);
  EXPECT_EQ(light.c[0], point.c[0]) << "the energy stays";
  std::mt19937 random(3);
  float rawMinimum = 0, peak = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d(test::randomDirection(random));
    EXPECT_GT(light.evaluate(d).x, -1e-6f);
    rawMinimum = std::min(rawMinimum, point.evaluate(d).x);
    peak = std::max(peak, light.evaluate(d).x);
  }
  EXPECT_LT(rawMinimum, -0.25f) << "the test must be able to fail";
  EXPECT_NEAR(peak / 1.989437, 0.36, 0.01);
}

TEST(BandSpectrum, AccountsForAllTheEnergyOfASmoothMap) {
  ShRgb scene(4);
  for (std::size_t k = 0; k < 16; ++k) scene.c[k] = Rgb(1.0f / float(1 + k));
  scene.c[0] = Rgb(8);
  const EnvironmentMap map = bandLimitedMap(scene, 256, 128);
  const BandSpectrum spectrum = bandSpectrum(map, projectEnvironment(map, 6));
  double power = 0;
  for (int l = 0; l < 6; ++l) {
    double expected = 0;
    for (int k = l * l; l < 4 && k < (l + 1) * (l + 1); ++k)
      expected += std::pow(scene.c[std::size_t(k)].x, 2);
    EXPECT_NEAR(spectrum.power[std::size_t(l)], expected, 1e-3 * (1 + expected)) << l;
    power += expected;
  }
  EXPECT_NEAR(spectrum.energy / power, 1, 1e-3);
  EXPECT_NEAR(spectrum.truncation[0], std::sqrt(1 - 64 / power), 1e-3);
  EXPECT_LT(spectrum.truncation[3], 0.02);
}

TEST(BandSpectrum, OfATexelOfLightFallsOffAsTheDeltaDoes) {
  const MapGeometry g(M::LatLong, 256, 128);
  Image image(256, 128, 3);
  test::setPixel(image, 40, 50, Rgb(100));
  const EnvironmentMap map(image, M::LatLong);
  const BandSpectrum spectrum = bandSpectrum(map, projectEnvironment(map, 33));
  const double area = g.solidAngle(40, 50), energy = 1e4 * area;
  EXPECT_NEAR(spectrum.energy / energy, 1, 1e-6);
  // the addition theorem gives each band (2l+1)/4pi of a unit delta's square
  for (const int l : {0, 1, 5, 10})
    EXPECT_NEAR(spectrum.power[std::size_t(l)] / (1e4 * area * area * (2 * l + 1) / (4 * kPi)), 1, 0.01) << l;
  EXPECT_GT(spectrum.truncation[32], 0.5) << "a texel holds far more than 33 bands";
}

}  // namespace
}  // namespace prt
