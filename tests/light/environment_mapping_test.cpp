#include "libprt/light/environment_mapping.h"
#include "libprt/core/error.h"
#include "tests/light/light_test_support.h"

#include <gtest/gtest.h>

#include <random>

namespace prt {
namespace {

using M = EnvironmentMapping;

using test::oneOfEach;
using test::randomDirection;

TEST(EnvironmentMapping, NamesRoundTrip) {
  for (const M m : environmentMappings()) EXPECT_EQ(environmentMappingFromString(toString(m)), m);
  EXPECT_THROW(environmentMappingFromString("mirrorball"), ValueError);
}

TEST(EnvironmentMapping, SizesThatDoNotFitAreRefused) {
  EXPECT_THROW(MapGeometry(M::VerticalCross, 300, 401), ValueError);
  EXPECT_THROW(MapGeometry(M::HorizontalCross, 300, 400), ValueError);
  EXPECT_THROW(MapGeometry(M::AngularMap, 300, 301), ValueError);
  EXPECT_THROW(MapGeometry(M::HorizontalStrip, 601, 100), ValueError);
  EXPECT_THROW(MapGeometry(M::LatLong, 0, 0), ValueError);
}

TEST(EnvironmentMapping, SolidAnglesOfAllTexelsMakeTheSphere) {
  for (const int cell : {1, 2, 5, 33})
    for (const MapGeometry& g : oneOfEach(cell)) {
      double sum = 0;
      for (int y = 0; y < g.height(); ++y)
        for (int x = 0; x < g.width(); ++x) sum += g.solidAngle(x, y);
      // the rim of an angular map is integrated numerically
      const double bound = g.mapping() == M::AngularMap ? 1e-6 : 1e-13;
      EXPECT_NEAR(sum / (4 * kPi), 1, bound) << toString(g.mapping()) << " " << cell;
    }
}

TEST(EnvironmentMapping, DirectionsAndImagePositionsAreInverse) {
  std::mt19937 rng(1);
  for (const MapGeometry& g : oneOfEach(16))
    for (int i = 0; i < 2000; ++i) {
      const DVec3 d = randomDirection(rng);
      const Vec2 p = g.toImage(Vec3(d));
      ASSERT_TRUE(g.covers(int(p.x), int(p.y))) << toString(g.mapping());
      EXPECT_LT(length(g.toDirection(p.x, p.y) - d), 3e-6) << toString(g.mapping());
    }
}

TEST(EnvironmentMapping, DensityIsTheJacobian) {
  std::mt19937 rng(2);
  const double h = 1e-5;
  for (const MapGeometry& g : oneOfEach(8))
    for (int i = 0; i < 500; ++i) {
      const Vec2 p = g.toImage(Vec3(randomDirection(rng)));
      const double x = std::floor(p.x) + 0.37, y = std::floor(p.y) + 0.61;
      if (g.density(x, y) == 0) continue;  // a point of a rim texel, outside the disc
      const DVec3 dx = g.toDirection(x + h, y) - g.toDirection(x - h, y);
      const DVec3 dy = g.toDirection(x, y + h) - g.toDirection(x, y - h);
      EXPECT_NEAR(length(cross(dx, dy)) / (4 * h * h), g.density(x, y), 1e-6 * g.density(x, y) + 1e-9)
          << toString(g.mapping());
    }
}

TEST(EnvironmentMapping, PicturesAreSeenFromTheInsideUnmirrored) {
  // right, up and towards the viewer make a right-handed frame
  std::mt19937 rng(3);
  const double h = 1e-4;
  for (const MapGeometry& g : oneOfEach(8))
    for (int i = 0; i < 200; ++i) {
      const Vec2 p = g.toImage(Vec3(randomDirection(rng)));
      const double x = std::floor(p.x) + 0.5, y = std::floor(p.y) + 0.5;
      if (g.density(x, y) == 0) continue;
      const DVec3 right = g.toDirection(x + h, y) - g.toDirection(x - h, y);
      const DVec3 up = g.toDirection(x, y - h) - g.toDirection(x, y + h);
      EXPECT_GT(dot(cross(right, up), -g.toDirection(x, y)), 0) << toString(g.mapping());
    }
}

struct Landmark {
  M mapping;
  double x, y;  // in the image, as a fraction of its size
  DVec3 direction;
};

TEST(EnvironmentMapping, AxesLieWhereTheConventionsSay) {
  const DVec3 right(1, 0, 0), left(-1, 0, 0), top(0, 1, 0), bottom(0, -1, 0), front(0, 0, -1), back(0, 0, 1);
  const double t = 1.0 / 3, e = 1.0 / 8, s = 1.0 / 6, w = 1.0 / 12, rim = 1e-9;
  const std::vector<Landmark> landmarks{{M::LatLong, 0.5, 0.5, front},
                                        {M::LatLong, 0.75, 0.5, right},
                                        {M::LatLong, 0.25, 0.5, left},
                                        {M::LatLong, 0.5, rim, top},
                                        {M::LatLong, 0.5, 1 - rim, bottom},
                                        {M::LatLong, rim, 0.5, back},
                                        {M::VerticalCross, 0.5, 3 * e, front},
                                        {M::VerticalCross, t / 2, 3 * e, left},
                                        {M::VerticalCross, 2.5 * t, 3 * e, right},
                                        {M::VerticalCross, 0.5, e, top},
                                        {M::VerticalCross, 0.5, 5 * e, bottom},
                                        {M::VerticalCross, 0.5, 7 * e, back},
                                        {M::HorizontalCross, 3 * e, 0.5, front},
                                        {M::HorizontalCross, e, 0.5, left},
                                        {M::HorizontalCross, 5 * e, 0.5, right},
                                        {M::HorizontalCross, 7 * e, 0.5, back},
                                        {M::HorizontalCross, 3 * e, t / 2, top},
                                        {M::HorizontalCross, 3 * e, 2.5 * t, bottom},
                                        {M::AngularMap, 0.5, 0.5, front},
                                        {M::AngularMap, 0.75, 0.5, right},
                                        {M::AngularMap, 0.25, 0.5, left},
                                        {M::AngularMap, 0.5, 0.25, top},
                                        {M::AngularMap, 0.5, 0.75, bottom},
                                        {M::AngularMap, 1 - rim, 0.5, back},
                                        {M::HorizontalStrip, w, 0.5, right},
                                        {M::HorizontalStrip, w + s, 0.5, left},
                                        {M::HorizontalStrip, w + 2 * s, 0.5, top},
                                        {M::HorizontalStrip, w + 3 * s, 0.5, bottom},
                                        {M::HorizontalStrip, w + 4 * s, 0.5, front},
                                        {M::HorizontalStrip, w + 5 * s, 0.5, back},
                                        {M::VerticalStrip, 0.5, w, right},
                                        {M::VerticalStrip, 0.5, w + s, left},
                                        {M::VerticalStrip, 0.5, w + 2 * s, top},
                                        {M::VerticalStrip, 0.5, w + 3 * s, bottom},
                                        {M::VerticalStrip, 0.5, w + 4 * s, front},
                                        {M::VerticalStrip, 0.5, w + 5 * s, back}};
  const auto geometries = oneOfEach(9);
  for (const Landmark& mark : landmarks) {
    const MapGeometry& g = geometries[std::size_t(mark.mapping)];
    EXPECT_LT(length(g.toDirection(mark.x * g.width(), mark.y * g.height()) - mark.direction), 1e-6)
        << toString(mark.mapping) << " " << mark.x << " " << mark.y;
  }
}

TEST(EnvironmentMapping, NeighbouringCellsOfACrossMeetWithoutAJump) {
  const double h = 1e-9, a = 0.3;
  for (const MapGeometry& g : {MapGeometry(M::VerticalCross, 3, 4), MapGeometry(M::HorizontalCross, 4, 3)})
    for (int y = 0; y < g.height(); ++y)
      for (int x = 0; x < g.width(); ++x) {
        if (x + 1 < g.width() && g.covers(x, y) && g.covers(x + 1, y)) {
          EXPECT_LT(length(g.toDirection(x + 1 - h, y + a) - g.toDirection(x + 1 + h, y + a)), 1e-7);
        }
        if (y + 1 < g.height() && g.covers(x, y) && g.covers(x, y + 1)) {
          EXPECT_LT(length(g.toDirection(x + a, y + 1 - h) - g.toDirection(x + a, y + 1 + h)), 1e-7);
        }
      }
}

TEST(EnvironmentMapping, QuadratureOverAllTexelsIntegratesPolynomials) {
  for (const MapGeometry& g : oneOfEach(3)) {
    DVec3 first(0), second(0);
    for (int y = 0; y < g.height(); ++y)
      for (int x = 0; x < g.width(); ++x) {
        double sum = 0;
        for (const TexelNode& node : g.nodes(x, y, 8)) {
          first += node.weight * node.direction;
          second += node.weight * node.direction * node.direction;
          sum += node.weight;
        }
        EXPECT_NEAR(sum, g.solidAngle(x, y), 1e-12);
      }
    EXPECT_LT(length(first), 2e-6) << toString(g.mapping());
    EXPECT_LT(length(second - DVec3(4 * kPi / 3)), 1e-5) << toString(g.mapping());
  }
}

TEST(EnvironmentMapping, TexelCentersLieInTheirTexels) {
  for (const MapGeometry& g : oneOfEach(7))
    for (int y = 0; y < g.height(); ++y)
      for (int x = 0; x < g.width(); ++x) {
        if (!g.covers(x, y)) continue;
        const Vec2 p = g.toImage(Vec3(g.center(x, y)));
        EXPECT_EQ(int(p.x), x) << toString(g.mapping());
        EXPECT_EQ(int(p.y), y) << toString(g.mapping());
      }
}

TEST(EnvironmentMapping, NoDirectionLeadsOutsideTheImage) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<Vec3> directions{Vec3(0),       Vec3(nan),     Vec3(inf, 0, 0), Vec3(-inf, nan, 1),
                                     Vec3(1, 1, 1), Vec3(0, 0, 1), Vec3(0, -1, 0)};
  for (const MapGeometry& g : oneOfEach(4))
    for (const Vec3& d : directions) {
      const Vec2 p = g.toImage(d);
      EXPECT_TRUE(p.x >= 0 && p.x < float(g.width()) && p.y >= 0 && p.y < float(g.height()))
          << toString(g.mapping());
    }
}

}  // namespace
}  // namespace prt
