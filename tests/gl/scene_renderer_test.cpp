#include "libprt/gl/scene_renderer.h"

#include "libprt/core/error.h"
#include "tests/gl/gl_test_support.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>
#include <random>

namespace prt::gl {
namespace {

using SceneRendererTest = test::GlTest;

constexpr int kWidth = 96, kHeight = 64;

Scene sceneOf(TriMesh mesh, const Material& material = {.albedo = Rgb(1)}) {
  Scene scene;
  scene.triangleObject.assign(mesh.triangleCount(), 0);
  scene.vertexObject.assign(mesh.vertexCount(), 0);
  scene.materials = {material};
  scene.names = {"object"};
  scene.mesh = std::move(mesh);
  return scene;
}

// A slanted triangle in front of the default camera, one corner near, one far.
TriMesh slantedTriangle() {
  TriMesh mesh;
  mesh.positions = {{-0.6f, -0.5f, 1.2f}, {0.9f, -0.4f, -0.5f}, {0.1f, 0.7f, -3.0f}};
  const Vec3 n = normalize(cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]));
  mesh.normals = {n, n, n};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Picture picture(int samples = 1) { return {.camera = {}, .width = kWidth, .height = kHeight, .samples = samples}; }

// Barycentrics of the ray through a pixel's centre, if it meets the triangle.
std::optional<Vec3> cast(const Camera& camera, int x, int y, const TriMesh& mesh) {
  const Vec3 d = camera.direction(float(x) + 0.5f, float(y) + 0.5f, kWidth, kHeight);
  const Vec3 a = mesh.positions[0], e1 = mesh.positions[1] - a, e2 = mesh.positions[2] - a;
  const Vec3 p = cross(d, e2), s = camera.eye - a, q = cross(s, e1);
  const float det = dot(e1, p), u = dot(s, p) / det, v = dot(d, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return Vec3(1 - u - v, u, v);
}

TEST_F(SceneRendererTest, IrradianceIsInterpolatedInSpaceAndReflected) {
  SceneRenderer renderer;
  const TriMesh mesh = slantedTriangle();
  const Rgb albedo(0.2f, 0.5f, 0.8f);
  renderer.setScene(sceneOf(mesh, {.albedo = albedo}));
  const std::vector<Rgb> irradiance{Rgb(1, 2, 3), Rgb(4, 0, 2), Rgb(0, 7, 1)};
  renderer.setIrradiance(irradiance);
  const Picture view = picture();
  const Image image = renderer.render(view);

  int inside = 0, disagree = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto b = cast(view.camera, x, y, mesh);
      const bool covered = image.pixel(x, y)[3] == 1;
      if (b.has_value() != covered) ++disagree;  // a centre on the very edge
      if (!b || !covered) continue;
      ++inside;
      const Rgb expected = albedo / kPiF * (b->x * irradiance[0] + b->y * irradiance[1] + b->z * irradiance[2]);
      EXPECT_LT(length(image.rgb(x, y) - expected), 2e-4f * length(expected)) << x << ", " << y;
    }
  EXPECT_GT(inside, 300);
  EXPECT_LE(disagree, 2);
}

TEST_F(SceneRendererTest, NothingIsBlackAndClear) {
  SceneRenderer renderer;
  const Image image = renderer.render(picture());
  for (float value : image.data) EXPECT_EQ(value, 0);
}

TEST_F(SceneRendererTest, BackFacesAreBlackUnlessTwoSided) {
  SceneRenderer renderer;
  TriMesh mesh = slantedTriangle();
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);
  Scene scene = sceneOf(mesh);
  renderer.setScene(scene);
  renderer.setIrradiance(std::vector<Rgb>(3, Rgb(kPiF)));
  const auto middle = [&] { return renderer.render(picture()).rgb(kWidth / 2, kHeight / 2); };
  EXPECT_EQ(middle(), Rgb(0));
  scene.materials[0].twoSided = true;
  renderer.setMaterials(scene.materials);
  EXPECT_NEAR(middle().x, 1, 1e-5);
}

// A map whose colour says where it is: smooth, so that filtering hardly matters.
Image directionMap(int width, int height) {
  Image map(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double theta = (y + 0.5) * kPi / height, phi = (x + 0.5) * 2 * kPi / width - kPi;
      const Vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      for (int c = 0; c < 3; ++c) map.pixel(x, y)[c] = 2 + d[c];
    }
  return map;
}

TEST_F(SceneRendererTest, TheEnvironmentStandsWhereTheConventionPutsIt) {
  SceneRenderer renderer;
  renderer.setEnvironment(directionMap(512, 256));
  Picture view = picture();
  view.camera.verticalFov = 1.6f;
  for (const Vec3& target : {Vec3(0, 0, 0), Vec3(5, 0, 3), Vec3(0, 3, 6), Vec3(-2, -4, 3)})
    for (const float rotation : {0.0f, 0.7f, -2.0f}) {
      view.camera.target = target;
      view.environmentRotation = rotation;
      const Image image = renderer.render(view);
      const Mat3 turn(rotate(Mat4(1), rotation, Vec3(0, 1, 0)));  // counter-clockwise seen from +Y
      float worst = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const Vec3 d = view.camera.direction(float(x) + 0.5f, float(y) + 0.5f, kWidth, kHeight);
          worst = std::max(worst, length(image.rgb(x, y) - (Rgb(2) + transpose(turn) * d)));
          EXPECT_EQ(image.pixel(x, y)[3], 1);
        }
      EXPECT_LT(worst, 0.02f) << rotation;
    }
}

TEST_F(SceneRendererTest, WhatCameFromMinusZComesFromMinusXAfterAQuarterTurn) {
  SceneRenderer renderer;
  Image map(8, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 3; x < 5; ++x) map.pixel(x, y)[0] = 1;  // red at the centre columns: -Z
  renderer.setEnvironment(map);
  Picture view = picture();
  view.camera.target = view.camera.eye - Vec3(1, 0, 0);
  view.environmentRotation = kPiF / 2;
  EXPECT_NEAR(renderer.render(view).rgb(kWidth / 2, kHeight / 2).x, 1, 1e-3);
}

TEST_F(SceneRendererTest, TheScreenGetsExposureAndTheSrgbCurve) {
  SceneRenderer renderer;
  renderer.setScene(sceneOf(slantedTriangle()));
  renderer.setIrradiance(std::vector<Rgb>(3, Rgb(0.0015f, 0.18f, 4.0f) * kPiF));
  Picture view = picture();
  view.exposure = 1;
  const Image image = renderer.renderToned(view);
  const float* middle = image.pixel(kWidth / 2, kHeight / 2);
  EXPECT_NEAR(middle[0], 12.92 * 0.003, 1e-4);
  EXPECT_NEAR(middle[1], 1.055 * std::pow(0.36, 1 / 2.4) - 0.055, 1e-3);
  EXPECT_NEAR(middle[2], 1, 1e-6);
  EXPECT_NEAR(middle[3], 1, 1e-6);
}

TEST_F(SceneRendererTest, ManySamplesChangeEdgesOnly) {
  SceneRenderer renderer;
  const TriMesh mesh = slantedTriangle();
  renderer.setScene(sceneOf(mesh));
  renderer.setIrradiance(std::vector<Rgb>(3, Rgb(kPiF)));
  const Image one = renderer.render(picture(1)), four = renderer.render(picture(4));
  int partial = 0;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x) {
      const float alpha = four.pixel(x, y)[3];
      EXPECT_NEAR(four.rgb(x, y).x, alpha, 1e-3) << "coverage and premultiplied radiance go together";
      if (alpha > 0 && alpha < 1) ++partial;
      float low = 1, high = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          low = std::min(low, one.pixel(x + i, y + j)[3]);
          high = std::max(high, one.pixel(x + i, y + j)[3]);
        }
      if (low != high) continue;
      EXPECT_EQ(alpha, low) << x << ", " << y;
    }
  EXPECT_GT(partial, 20);
}

TEST_F(SceneRendererTest, LightForAnotherMeshIsRefused) {
  SceneRenderer renderer;
  renderer.setScene(sceneOf(slantedTriangle()));
  EXPECT_THROW(renderer.setIrradiance(std::vector<Rgb>(2)), ValueError);
}

}  // namespace
}  // namespace prt::gl
