#include "libprt/shade/pick.h"

#include "libprt/shade/raster.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::lambert;

constexpr int kWidth = 48, kHeight = 40;

/// Two spheres, one behind the other, and a third that is behind the eye.
Scene spheres() {
  const auto at = [](const Vec3& place) {
    Mat4 m(1);
    m[3] = Vec4(place, 1);
    return SceneObject{"sphere", std::make_shared<const TriMesh>(test::sphere(16, 24)), m,
                       lambert(Rgb(0.5f))};
  };
  const SceneObject objects[] = {at({0, 0, 0}), at({0.6f, 0.2f, -4}), at({0, 0, 9})};
  return flattenScene(objects);
}

Camera camera(bool orthographic) {
  Camera c;
  c.eye = {0, 0, 6};
  c.orthographic = orthographic;
  return c;
}

TEST(Pick, FindsWhatTheRasteriserDraws) {
  const Scene scene = spheres();
  for (const bool parallel : {false, true}) {
    Job job;
    const FragmentImage drawn = rasterize(scene.mesh, camera(parallel), kWidth, kHeight, 1, job);
    int compared = 0, differ = 0;
    for (const FragmentTile& tile : drawn.tiles)
      for (int i = 0; i < tile.width * tile.height; ++i) {
        const auto pixel = tile.pixel(std::size_t(i));
        const float x = float(tile.x + i % tile.width) + 0.5f, y = float(tile.y + i / tile.width) + 0.5f;
        const auto hit = pickSurface(scene, camera(parallel), x, y, kWidth, kHeight);
        ++compared;
        differ += hit.has_value() != !pixel.empty() || (hit && hit->triangle != pixel[0].triangle);
        if (!hit || pixel.empty() || hit->triangle != pixel[0].triangle) continue;
        EXPECT_NEAR(length(hit->barycentric - pixel[0].barycentric), 0, 1e-4);
        EXPECT_EQ(hit->back, pixel[0].back);
        EXPECT_EQ(hit->object, scene.triangleObject[hit->triangle]);
      }
    EXPECT_LT(differ, compared / 100) << "snapping decides at edges";
  }
}

TEST(Pick, ThePinholeDoesNotSeeBehindItselfParallelRaysDo) {
  const Scene scene = spheres();
  const auto pinhole = pickSurface(scene, camera(false), kWidth / 2, kHeight / 2, kWidth, kHeight);
  ASSERT_TRUE(pinhole);
  EXPECT_EQ(pinhole->object, 0u);
  EXPECT_NEAR(length(pinhole->position - Vec3(0, 0, 1)), 0, 0.03);
  const auto parallel = pickSurface(scene, camera(true), kWidth / 2, kHeight / 2, kWidth, kHeight);
  ASSERT_TRUE(parallel);
  EXPECT_EQ(parallel->object, 2u);
  EXPECT_FALSE(parallel->back);
}

TEST(Pick, TheBackgroundIsNothing) {
  EXPECT_FALSE(pickSurface(spheres(), camera(false), 0.5f, 0.5f, kWidth, kHeight));
}

}  // namespace
}  // namespace prt
