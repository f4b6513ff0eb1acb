#include "libprt/shade/reference.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/raster.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::lambert;
using test::sceneOf;
using test::sphere;

LightRig skyWithDisc() {
  LightRig rig;
  rig.constant = Rgb(0.2f, 0.3f, 0.5f);
  rig.circles.push_back({normalize(Vec3(1, 1, 1)), 0.4f, Rgb(3, 2, 1)});
  return rig;
}

/// A tracer with what it refers to.
struct World {
  Scene scene;
  Job job;
  PathTracer tracer;
  explicit World(const LightRig& rig, const Rgb& albedo = Rgb(0.8f, 0.5f, 0.2f))
      : scene(sceneOf(sphere(24, 48), lambert(albedo))), tracer(scene, rig, job) {}
};

Camera farCamera() {
  Camera camera;
  camera.eye = {0, 0, 6};
  return camera;
}

TEST(Reference, WhiteSphereUnderWhiteSkyIsWhite) {
  LightRig white;
  white.constant = Rgb(1);
  World s(white, Rgb(1));
  ReferenceImage image(s.tracer, farCamera(), 24, 20, {});
  image.add(64, s.job);
  const Image radiance = image.radiance();
  double covered = 0, light = 0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x) {
      const float alpha = radiance.pixel(x, y)[3];
      EXPECT_NEAR(radiance.pixel(x, y)[0], alpha, 0.12);  // noise of 64 paths
      covered += alpha, light += radiance.pixel(x, y)[0];
    }
  EXPECT_NEAR(light / covered, 1, 2e-3);
  const double focal = 10 / std::tan(0.5 * farCamera().verticalFov);
  EXPECT_NEAR(covered / (kPi * focal * focal / 35), 1,
              0.02);  // silhouette of the unit sphere from distance 6
}

TEST(Reference, BackgroundShowsTheLightBehind) {
  World s(skyWithDisc());
  ReferenceImage image(s.tracer, farCamera(), 24, 20, {});
  image.add(8, s.job);
  const Image plain = image.radiance(), filled = image.radiance(true);
  EXPECT_EQ(plain.rgb(0, 0), Rgb(0));
  EXPECT_EQ(plain.pixel(0, 0)[3], 0);
  EXPECT_NEAR(length(filled.rgb(0, 0) - Rgb(0.2f, 0.3f, 0.5f)), 0, 1e-6);
  EXPECT_EQ(filled.pixel(0, 0)[3], 1);
  EXPECT_EQ(plain.rgb(12, 10), filled.rgb(12, 10));
}

// The rasteriser covers what parallel rays meet, also what lies behind the eye; beside it is the pinhole's
// background.
TEST(Reference, ParallelRaysSeeWhatTheRasteriserSees) {
  World s(skyWithDisc());
  Camera camera;
  camera.orthographic = true;
  camera.eye = {0.1f, 0.2f, 0.5f};
  camera.verticalFov = 2.6f;
  ReferenceImage image(s.tracer, camera, 24, 20, {});
  image.add(32, s.job);
  const Image plain = image.radiance(), filled = image.radiance(true);
  const FragmentImage seen = rasterize(s.scene.mesh, camera, 24, 20, 8, s.job);
  double covered = 0;
  for (const FragmentTile& tile : seen.tiles)
    for (int i = 0; i < tile.width * tile.height; ++i) {
      float part = 0;
      for (const Fragment& f : tile.pixel(std::size_t(i))) part += float(f.samples) / 64;
      const int x = tile.x + i % tile.width, y = tile.y + i / tile.width;
      EXPECT_NEAR(plain.pixel(x, y)[3], part, 0.15) << x << " " << y;
      covered += part;
    }
  EXPECT_GT(covered, 50);
  EXPECT_LT(covered, 400);
  EXPECT_NEAR(length(filled.rgb(0, 0) -
                     radiance(skyWithDisc(), normalize(CameraRays(camera, 24, 20).background(0.5f, 0.5f)))),
              0, 1e-3);
}

TEST(Reference, PortionsOfSamplesGiveTheSameBits) {
  World s(skyWithDisc());
  ReferenceImage once(s.tracer, farCamera(), 16, 12, {}), portions(s.tracer, farCamera(), 16, 12, {});
  once.add(50, s.job);
  setThreadCount(5);
  for (const int n : {1, 20, 29}) portions.add(n, s.job);
  setThreadCount(0);
  EXPECT_EQ(once.samples(), 50);
  EXPECT_EQ(portions.samples(), 50);
  EXPECT_EQ(once.radiance().data, portions.radiance().data);
  EXPECT_EQ(once.standardError().data, portions.standardError().data);
}

TEST(Reference, StandardErrorTellsTheNoise) {
  World s(skyWithDisc());
  PathOptions first, second;
  second.seed = 2;
  ReferenceImage a(s.tracer, farCamera(), 32, 32, first), b(s.tracer, farCamera(), 32, 32, second);
  a.add(32, s.job), b.add(32, s.job);
  const Image ra = a.radiance(), rb = b.radiance(), e = a.standardError();
  double differ = 0, claimed = 0;
  for (int y = 12; y < 20; ++y)
    for (int x = 12; x < 20; ++x) {
      differ += std::pow(ra.pixel(x, y)[0] - rb.pixel(x, y)[0], 2);
      claimed += 2 * std::pow(e.pixel(x, y)[0], 2);
    }
  EXPECT_GT(differ, 0);
  EXPECT_LT(differ, 1.5 * claimed);
}

TEST(Reference, CancelKeepsWholePasses) {
  World s(skyWithDisc());
  ReferenceImage image(s.tracer, farCamera(), 32, 32, {});
  image.add(16, s.job);
  const Image before = image.radiance();
  Job cancelled;
  cancelled.cancel();
  EXPECT_THROW(image.add(16, cancelled), Cancelled);
  EXPECT_EQ(image.samples(), 16);
  EXPECT_EQ(image.radiance().data, before.data);
}

TEST(Reference, RefusesBadSizes) {
  World s(skyWithDisc());
  EXPECT_THROW(ReferenceImage(s.tracer, Camera{}, 0, 5, {}), ValueError);
  EXPECT_THROW(ReferenceImage(s.tracer, Camera{}, 5, 65537, {}), ValueError);
}

}  // namespace
}  // namespace prt
