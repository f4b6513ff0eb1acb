#include "libprt/mesh/triangulate.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace prt {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles cut(const std::vector<DVec3>& polygon) {
  Job job;
  return triangulatePolygon(polygon, job);
}

DVec3 areaVector(const DVec3& a, const DVec3& b, const DVec3& c) {
  return 0.5 * cross(b - a, c - a);
}

DVec3 polygonArea(const std::vector<DVec3>& p) {
  DVec3 sum(0);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += areaVector(p[0], p[i], p[i + 1]);
  return sum;
}

/// Every triangle faces the polygon's way and their areas add up: no overlap, no gap, nothing outside.
void expectTiles(const std::vector<DVec3>& polygon) {
  const Triangles triangles = cut(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const DVec3 whole = polygonArea(polygon), normal = normalize(whole);
  double sum = 0;
  for (const auto& t : triangles) {
    const double area = dot(areaVector(polygon[t[0]], polygon[t[1]], polygon[t[2]]), normal);
    EXPECT_GE(area, -1e-9 * length(whole));
    sum += area;
  }
  EXPECT_NEAR(sum, length(whole), 1e-9 * length(whole));
}

std::vector<DVec3> inPlane(const std::vector<glm::dvec2>& outline, const DVec3& u, const DVec3& v) {
  std::vector<DVec3> polygon;
  for (const auto& p : outline) polygon.push_back(DVec3(3, -2, 5) + p.x * u + p.y * v);
  return polygon;
}

const DVec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

TEST(Triangulate, SmallCases) {
  EXPECT_TRUE(cut({}).empty());
  EXPECT_TRUE(cut({DVec3(0), kX}).empty());
  EXPECT_EQ(cut({DVec3(0), kX, kY}).size(), 1u);
}

TEST(Triangulate, ConcavePolygonsInEveryPlane) {
  const std::vector<glm::dvec2> arrow{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
  const std::vector<glm::dvec2> comb{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                                     {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (const auto& outline : {arrow, comb})
    for (const auto& [u, v] : {std::pair{kX, kY},
                               {kY, kX},
                               {kY, kZ},
                               {kZ, kX},
                               {normalize(kX + kY), kZ},
                               {normalize(kX - kZ), normalize(kX + kZ + kY)}})
      expectTiles(inPlane(outline, u, v));
}

TEST(Triangulate, CollinearCorners) {
  expectTiles(inPlane({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, kX, kY));
}

TEST(Triangulate, HolesReachedOverABridge) {
  expectTiles(
      inPlane({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}, kX, kY));
}

TEST(Triangulate, StarsOfManyCorners) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.3, 1.0);
  for (int corners : {10, 100, 1000, 20000}) {
    std::vector<glm::dvec2> star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * kPi * i / corners, r = radius(random);
      star.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expectTiles(inPlane(star, kX, kY));
  }
}

TEST(Triangulate, SpiralsOfManyCorners) {
  std::vector<glm::dvec2> spiral;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 2000; ++i) {
      const double t = side == 0 ? i / 2000.0 : (1999 - i) / 2000.0, r = 0.1 + t - 0.02 * side;
      spiral.push_back({r * std::cos(30 * t), r * std::sin(30 * t)});
    }
  expectTiles(inPlane(spiral, kX, kY));
}

/// Whatever the corners, there are n - 2 triangles over them, in time.
TEST(Triangulate, NonsenseStillEnds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int corners : {4, 5, 9, 50, 5000}) {
    std::vector<DVec3> polygon;
    for (int i = 0; i < corners; ++i)
      polygon.push_back({anywhere(random), anywhere(random), anywhere(random)});
    EXPECT_EQ(cut(polygon).size(), polygon.size() - 2);
    for (DVec3& p : polygon) p = DVec3(p.x, 0, 0);
    EXPECT_EQ(cut(polygon).size(), polygon.size() - 2) << "all on a line";
    for (DVec3& p : polygon) p = DVec3(1, 2, 3);
    EXPECT_EQ(cut(polygon).size(), polygon.size() - 2) << "all in a point";
  }
}

}  // namespace
}  // namespace prt
