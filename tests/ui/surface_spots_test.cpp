// Spots that a brush lays on a surface.

#include "ui/model/surface_spots.h"

#include "libprt/mesh/generate.h"

#include <gtest/gtest.h>

#include <set>

namespace prt::ui {
namespace {

const PatchWish kBrush{.centre = Vec3(0), .radius = 0.1f, .place = {0.25f, 0.75f}, .extent = 0.08f};

PatchWish spotAt(const Vec3& centre, float radius = 0.1f) {
  PatchWish spot = kBrush;
  spot.centre = centre, spot.radius = radius;
  return spot;
}

TEST(SpotTrail, LaysSpotsSoNearThatEveryPlaceUnderTheHandIsFull) {
  SpotTrail trail(kBrush.radius);
  int laid = 0;
  for (int i = 0; i <= 1000; ++i) laid += trail.add(Vec3(0.001f * float(i), 0, 0));
  EXPECT_EQ(std::size_t(laid), trail.centres().size());
  EXPECT_LT(laid, 30) << "few";
  for (int i = 0; i <= 960; ++i) {
    float nearest = 1;
    for (const Vec3& centre : trail.centres())
      nearest = std::min(nearest, distance(centre, Vec3(0.001f * float(i), 0, 0)));
    EXPECT_LE(nearest, kBrush.radius / 2) << "strength is 1 up to half of the radius";
  }
  EXPECT_FALSE(trail.add(trail.centres()[2])) << "going back over it lays nothing more";
}

TEST(SurfaceSpots, PaintingOverReplacesWhatIsCoveredAndLeavesTheRest) {
  const std::vector<PatchWish> before{spotAt(Vec3(0)), spotAt({0.09f, 0, 0}), spotAt({0.01f, 0, 0}, 0.5f)};
  PatchWish over = spotAt(Vec3(0));
  over.place = {0.9f, 0.1f};
  const std::vector<PatchWish> after = paintedOver(before, over, {{0.02f, 0, 0}});
  ASSERT_EQ(after.size(), 3u) << "the first is covered, the second only at its rim, the third is larger";
  EXPECT_EQ(after[0].centre, before[1].centre);
  EXPECT_EQ(after[1].radius, 0.5f);
  EXPECT_EQ(after[2].place, over.place);
  EXPECT_EQ(after[2].centre.x, 0.02f);
}

TEST(SurfaceSpots, ErasingTakesThoseWhoseMiddleIsUnderTheBrush) {
  const std::vector<PatchWish> before{spotAt(Vec3(0)), spotAt({0.2f, 0, 0})};
  const std::vector<PatchWish> after = erasedAround(before, {0.05f, 0, 0}, 0.1f);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].centre.x, 0.2f);
}

TEST(SurfaceSpots, TrianglesFollowTheSurfaceAndCoverTheSpot) {
  Job job;
  const Surface ball(makeIcosphere({.subdivisions = 4}), job);
  const Vec3 centre = normalize(Vec3(0.3f, 0.8f, 0.5f));
  const SurfacePoint at = nearestPoint(ball, centre, job);
  EXPECT_LT(distance(positionAt(ball, at), centre), 0.01f);
  const std::vector<Vec3> triangles = spotTriangles(ball, at, 0.4f);
  double area = 0, farthest = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    area += 0.5 * double(length(cross(triangles[i + 1] - triangles[i], triangles[i + 2] - triangles[i])));
    for (std::size_t k = i; k < i + 3; ++k) {
      EXPECT_NEAR(length(triangles[k]), 1, 0.01f) << "on the ball";
      farthest = std::max(farthest,
                          std::acos(double(dot(normalize(triangles[k]), normalize(positionAt(ball, at))))));
    }
  }
  EXPECT_NEAR(farthest, 0.4, 0.02);
  EXPECT_NEAR(area, 2 * kPi * (1 - std::cos(0.4)), 0.03) << "that of the cap";
}

TEST(SurfaceSpots, PartsHaveFewColoursThatTellThemApart) {
  std::set<std::pair<float, float>> colors;
  for (int y = 0; y <= 50; ++y)
    for (int x = 0; x <= 50; ++x) {
      const Rgb c = colorOfPart(Vec2(x, y) / 50.0f);
      colors.insert({c.x, c.y});
    }
  EXPECT_EQ(colors.size(), 25u);
}

}  // namespace
}  // namespace prt::ui
