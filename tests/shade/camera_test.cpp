#include "libprt/shade/camera.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

Vec2 project(const Camera& camera, const Vec3& p, int width, int height) {
  const Vec4 clip =
      camera.projection(float(width) / float(height), 0.01f, 100.0f) * (camera.view() * Vec4(p, 1));
  return {(clip.x / clip.w * 0.5f + 0.5f) * float(width), (0.5f - clip.y / clip.w * 0.5f) * float(height)};
}

TEST(Camera, ImageStartsAtTheTopLeft) {
  const Camera camera;  // on +z, looking at the origin
  EXPECT_LT(camera.direction(0.5f, 0.5f, 64, 48).x, 0);
  EXPECT_GT(camera.direction(0.5f, 0.5f, 64, 48).y, 0);
  EXPECT_NEAR(length(camera.direction(32, 24, 64, 48) - Vec3(0, 0, -1)), 0, 1e-6);
}

TEST(Camera, FieldOfViewIsVerticalAndFull) {
  Camera camera;
  camera.verticalFov = float(radians(40));
  const Vec3 top = camera.direction(50, 0, 100, 60), bottom = camera.direction(50, 60, 100, 60);
  EXPECT_NEAR(std::acos(dot(top, bottom)), radians(40), 1e-5);
}

TEST(Camera, MatricesAndRaysAgree) {
  Camera camera;
  camera.eye = {2, 1.5f, -1}, camera.target = {0.2f, 0, 0.3f}, camera.up = {0.1f, 1, 0.2f};
  for (const Vec2 pixel : {Vec2(3.5f, 7.25f), Vec2(60, 1), Vec2(31.5f, 47)}) {
    const Vec3 p = camera.eye + 2.5f * camera.direction(pixel.x, pixel.y, 64, 48);
    EXPECT_NEAR(length(project(camera, p, 64, 48) - pixel), 0, 1e-3);
    EXPECT_NEAR(length(camera.project(p, 64, 48).value() - pixel), 0, 1e-3);
  }
  EXPECT_FALSE(camera.project(camera.eye + camera.axes().normal, 64, 48)) << "behind the eye";
}

TEST(Camera, ParallelRaysShowAtTheTargetWhatThePinholeShowsThere) {
  Camera camera;
  camera.eye = {2, 1.5f, -1}, camera.target = {0.2f, 0, 0.3f};
  const Vec3 point = camera.target + 0.3f * camera.axes().tangent - 0.2f * camera.axes().bitangent;
  const Vec2 pinhole = project(camera, point, 64, 48);
  camera.orthographic = true;
  EXPECT_NEAR(length(project(camera, point, 64, 48) - pinhole), 0, 1e-3);
  const CameraRays rays(camera, 64, 48);
  for (const Vec2 pixel : {Vec2(3.5f, 7.25f), Vec2(60, 1)}) {
    EXPECT_NEAR(length(rays.direction(pixel.x, pixel.y) + camera.axes().normal), 0, 1e-6);
    for (const float distance : {-0.5f, 4.0f}) {
      const Vec3 p = rays.origin(pixel.x, pixel.y) + distance * rays.through(pixel.x, pixel.y);
      EXPECT_NEAR(length(project(camera, p, 64, 48) - pixel), 0, 1e-3);
      EXPECT_NEAR(length(camera.project(p, 64, 48).value() - pixel), 0, 1e-3);
    }
  }
  EXPECT_EQ(camera.towardsViewer({5, 6, 7}), camera.axes().normal);
}

TEST(Camera, DegenerateFieldsStillGiveAFrame) {
  Camera camera;
  for (const Vec3 up : {Vec3(0), Vec3(0, 0, 2), Vec3(std::numeric_limits<float>::quiet_NaN()), Vec3(0, 1, 0)})
    for (const Vec3 eye :
         {Vec3(0), Vec3(0, 0, 3), Vec3(0, 5, 0), Vec3(std::numeric_limits<float>::infinity(), 0, 0)}) {
      camera.up = up, camera.eye = eye;
      const Frame f = camera.axes();
      EXPECT_NEAR(length(f.tangent), 1, 1e-5);
      EXPECT_NEAR(length(f.bitangent), 1, 1e-5);
      EXPECT_NEAR(dot(cross(f.tangent, f.bitangent), f.normal), 1, 1e-5);
    }
}

TEST(Camera, FramedBoxFitsAndFills) {
  Box3 box;
  box.extend({10, -2, 5}), box.extend({14, 0, 6});
  const Camera camera = frameBox(box);
  float least = 100, most = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? 14 : 10, i & 2 ? 0 : -2, i & 4 ? 6 : 5);
    const Vec2 p = project(camera, corner, 100, 100);
    least = std::min({least, p.x, p.y}), most = std::max({most, p.x, p.y});
  }
  EXPECT_GE(least, 0);
  EXPECT_LE(most, 100);
  EXPECT_GT(most - least, 85);
}

TEST(Camera, FramesAPointAndNothing) {
  Box3 point;
  point.extend({1, 2, 3});
  EXPECT_GT(length(frameBox(point).eye - Vec3(1, 2, 3)), 0);
  EXPECT_EQ(frameBox(Box3{}), Camera{});
}

}  // namespace
}  // namespace prt
