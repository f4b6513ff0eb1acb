#include "libprt/gl/scene_renderer.h"

#include "libprt/core/error.h"
#include "libprt/material/glossy_response.h"
#include "libprt/mesh/generate.h"
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
  const Vec3 n =
      normalize(cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]));
  mesh.normals = {n, n, n};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Picture picture(int samples = 1) {
  return {.camera = {}, .width = kWidth, .height = kHeight, .samples = samples};
}

// Barycentrics of where a ray meets the triangle.
std::optional<Vec3> meets(const Vec3& eye, const Vec3& d, const TriMesh& mesh) {
  const Vec3 a = mesh.positions[0], e1 = mesh.positions[1] - a, e2 = mesh.positions[2] - a;
  const Vec3 p = cross(d, e2), s = eye - a, q = cross(s, e1);
  const float det = dot(e1, p), u = dot(s, p) / det, v = dot(d, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return Vec3(1 - u - v, u, v);
}

// The same for the ray through a pixel's centre.
std::optional<Vec3> cast(const Camera& camera, int x, int y, const TriMesh& mesh) {
  return meets(camera.eye, camera.direction(float(x) + 0.5f, float(y) + 0.5f, kWidth, kHeight), mesh);
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
      const Rgb expected =
          albedo / kPiF * (b->x * irradiance[0] + b->y * irradiance[1] + b->z * irradiance[2]);
      EXPECT_LT(length(image.rgb(x, y) - expected), 2e-4f * length(expected)) << x << ", " << y;
    }
  EXPECT_GT(inside, 300);
  EXPECT_LE(disagree, 2);
}

std::vector<Rgb> someLight(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-0.3f, 1);
  std::vector<Rgb> light(count);
  for (Rgb& c : light) c = Rgb(value(random), value(random), value(random));
  return light;
}

// Exit radiance of the slanted triangle, pixel by pixel, as the CPU works it out.
void expectRadiance(const Image& image, const Picture& view, const TriMesh& mesh, const Material& material,
                    int bands, const std::vector<Rgb>& perSample, bool everywhere) {
  const std::size_t n = std::size_t(shCount(bands));
  std::optional<GlossyResponse> glossy;
  if (material.glossy()) glossy.emplace(material.exponent, bands);
  int inside = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto b = cast(view.camera, x, y, mesh);
      if (!b || image.pixel(x, y)[3] != 1) continue;
      std::vector<Rgb> light(n);
      for (std::size_t k = 0; k < n; ++k)
        light[k] = everywhere ? perSample[k]
                              : b->x * perSample[k] + b->y * perSample[n + k] + b->z * perSample[2 * n + k];
      const Vec3 normal = normalize(b->x * mesh.normals[0] + b->y * mesh.normals[1] + b->z * mesh.normals[2]);
      const Vec3 place = b->x * mesh.positions[0] + b->y * mesh.positions[1] + b->z * mesh.positions[2];
      const Vec3 toEye = normalize(view.camera.eye - place);
      const Rgb expected =
          max(exitRadiance(material, glossy ? &*glossy : nullptr, normal, toEye, light), Rgb(0));
      EXPECT_LT(length(image.rgb(x, y) - expected), 2e-3f * std::max(0.2f, length(expected)))
          << x << ", " << y << ", " << bands << " bands, exponent " << material.exponent;
      ++inside;
    }
  EXPECT_GT(inside, 300);
}

TEST_F(SceneRendererTest, TransferredRadianceMeetsThePixelsNormalAndView) {
  SceneRenderer renderer;
  TriMesh mesh = slantedTriangle();
  mesh.normals = {normalize(mesh.normals[0] + Vec3(0.5f, 0, 0)),
                  normalize(mesh.normals[1] + Vec3(0, 0.6f, 0)),
                  normalize(mesh.normals[2] + Vec3(-0.4f, 0, 0.3f))};
  const Picture view = picture();
  const auto phong = [](const Rgb& albedo, const Rgb& specular, float exponent) {
    return Material{
        .model = MaterialModel::Phong, .albedo = albedo, .specular = specular, .exponent = exponent};
  };
  for (const int bands : {1, 2, 5, 10})  // 10: fetched, and slow to compile for Mesa's software driver
    for (const Material& material :
         {Material{.albedo = Rgb(0.7f, 0.5f, 0.2f)}, phong(Rgb(0.1f), Rgb(0.9f, 0.6f, 0.3f), 7),
          phong(Rgb(0), Rgb(1), 3000)}) {
      if (bands == 10 && material.exponent != 7) continue;
      renderer.setScene(sceneOf(mesh, material));
      const std::vector<Rgb> light = someLight(3 * std::size_t(shCount(bands)), unsigned(bands));
      renderer.setRadiance(bands, light);
      expectRadiance(renderer.render(view), view, mesh, material, bands, light, false);

      if (bands == 10) continue;
      ShRgb global(bands);
      std::copy_n(light.begin(), global.c.size(), global.c.begin());
      renderer.setLight(global);
      expectRadiance(renderer.render(view), view, mesh, material, bands, global.c, true);
    }
}

TEST_F(SceneRendererTest, EachObjectHasItsOwnMaterial) {
  SceneRenderer renderer;
  Scene scene;
  const TriMesh sphere = makeIcosphere({.radius = 0.4f, .subdivisions = 2});
  for (std::uint32_t object = 0; object < 3; ++object) {
    const auto first = std::uint32_t(scene.mesh.positions.size());
    for (const Vec3& p : sphere.positions)
      scene.mesh.positions.push_back(p + Vec3(0.9f * (float(object) - 1), 0, 0));
    scene.mesh.normals.insert(scene.mesh.normals.end(), sphere.normals.begin(), sphere.normals.end());
    for (const UVec3& t : sphere.triangles) scene.mesh.triangles.push_back(t + first);
    scene.vertexObject.resize(scene.mesh.positions.size(), object);
    scene.triangleObject.resize(scene.mesh.triangles.size(), object);
    scene.names.push_back("sphere");
  }
  scene.materials = {
      Material{.albedo = Rgb(1, 0, 0)},
      Material{.model = MaterialModel::Phong, .albedo = Rgb(0), .specular = Rgb(0, 1, 0), .exponent = 50},
      Material{.model = MaterialModel::Phong, .albedo = Rgb(0), .specular = Rgb(0, 0, 1), .exponent = 5}};
  renderer.setScene(scene);
  ShRgb white(5);
  white.c[0] = Rgb(std::sqrt(4 * kPiF));  // radiance 1 from everywhere
  renderer.setLight(white);
  Picture view = picture();
  view.camera.verticalFov = 0.7f;
  const Image image = renderer.render(view);
  const auto at = [&](float x) {
    return image.rgb(int(kWidth / 2 + x * kHeight / (2 * 3 * std::tan(0.35f))), kHeight / 2);
  };
  EXPECT_NEAR(length(at(-0.9f) - Rgb(1, 0, 0)), 0, 0.02f);
  EXPECT_NEAR(length(at(0) - Rgb(0, 1, 0)), 0, 0.02f) << "Phong reflects everything at normal incidence";
  EXPECT_GT(at(0.9f).z, 0.7f);
  EXPECT_EQ(at(0.9f).x, 0);
}

TEST_F(SceneRendererTest, TheBackOfATwoSidedSurfaceHasItsOwnSamples) {
  SceneRenderer renderer;
  TriMesh mesh = slantedTriangle();
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);  // seen from behind
  for (Vec3& n : mesh.normals) n = -n;
  const Material material{.albedo = Rgb(0.5f), .twoSided = true};
  const std::vector<std::uint32_t> back{3, 4, 5};
  renderer.setScene(sceneOf(mesh, material), back);
  std::vector<Rgb> irradiance(6, Rgb(1, 0, 0));
  std::fill(irradiance.begin() + 3, irradiance.end(), Rgb(0, kPiF, 0));
  renderer.setIrradiance(irradiance);
  const auto middle = [&] { return renderer.render(picture()).rgb(kWidth / 2, kHeight / 2); };
  EXPECT_NEAR(length(middle() - Rgb(0, 0.5f, 0)), 0, 1e-5);

  std::vector<Rgb> coefficients(6 * 4, Rgb(0));
  for (int s = 3; s < 6; ++s) coefficients[std::size_t(4 * s)] = Rgb(std::sqrt(4 * kPiF));
  renderer.setRadiance(2, coefficients);
  EXPECT_NEAR(length(middle() - Rgb(0.5f)), 0, 1e-4);
}

TEST_F(SceneRendererTest, NotANumberBecomesBlack) {
  SceneRenderer renderer;
  renderer.setScene(sceneOf(slantedTriangle()));
  const float bad = std::numeric_limits<float>::quiet_NaN();
  renderer.setIrradiance(std::vector<Rgb>(3, Rgb(bad, -1, 1)));
  const Rgb shown = renderer.render(picture()).rgb(kWidth / 2, kHeight / 2);
  EXPECT_EQ(shown.x, 0);
  EXPECT_EQ(shown.y, 0);
  EXPECT_GT(shown.z, 0);
}

TEST_F(SceneRendererTest, NothingIsBlackAndClear) {
  SceneRenderer renderer;
  const Image image = renderer.render(picture());
  for (float value : image.data) EXPECT_EQ(value, 0);
}

TEST_F(SceneRendererTest, BackFacesAreBlack) {
  SceneRenderer renderer;
  TriMesh mesh = slantedTriangle();
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);
  renderer.setScene(sceneOf(mesh));
  renderer.setIrradiance(std::vector<Rgb>(3, Rgb(kPiF)));
  EXPECT_EQ(renderer.render(picture()).rgb(kWidth / 2, kHeight / 2), Rgb(0));
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
  renderer.setEnvironment(EnvironmentMap(directionMap(512, 256), EnvironmentMapping::LatLong));
  Picture view = picture();
  view.smoothEnvironment = true;
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

TEST_F(SceneRendererTest, TexelsAreConstantOrSmoothAsAsked) {
  SceneRenderer renderer;
  const Image map = directionMap(16, 8);
  renderer.setEnvironment(EnvironmentMap(map, EnvironmentMapping::LatLong));
  Picture view = picture();
  view.camera.verticalFov = 1.6f;
  view.environmentIntensity = 2;
  int between[2] = {0, 0};
  for (const bool smooth : {false, true}) {
    view.smoothEnvironment = smooth;
    const Image image = renderer.render(view);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        bool isTexel = false;
        for (std::size_t i = 0; i < map.pixels() && !isTexel; ++i)
          isTexel = length(image.rgb(x, y) -
                           2.0f * Rgb(map.data[3 * i], map.data[3 * i + 1], map.data[3 * i + 2])) < 1e-5f;
        between[smooth] += !isTexel;
      }
  }
  EXPECT_EQ(between[false], 0);
  EXPECT_GT(between[true], kWidth * kHeight / 2);
}

TEST_F(SceneRendererTest, WhatCameFromMinusZComesFromMinusXAfterAQuarterTurn) {
  SceneRenderer renderer;
  Image map(8, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 3; x < 5; ++x) map.pixel(x, y)[0] = 1;  // red at the centre columns: -Z
  renderer.setEnvironment(EnvironmentMap(map, EnvironmentMapping::LatLong));
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
  view.tone.exposure = 1;
  const Image image = renderer.renderToned(view);
  const float* middle = image.pixel(kWidth / 2, kHeight / 2);
  EXPECT_NEAR(middle[0], 12.92 * 0.003, 1e-4);
  EXPECT_NEAR(middle[1], 1.055 * std::pow(0.36, 1 / 2.4) - 0.055, 1e-3);
  EXPECT_NEAR(middle[2], 1, 1e-3);  // passes are summed as half floats
  EXPECT_NEAR(middle[3], 1, 1e-3);
}

TEST_F(SceneRendererTest, ToneMappingIsThatOfTheCpu) {
  SceneRenderer renderer;
  renderer.setScene(sceneOf(slantedTriangle()));
  for (const ToneCurve curve : {ToneCurve::Linear, ToneCurve::Filmic})
    for (const float exposure : {-3.0f, 0.0f, 2.5f})
      for (const Rgb& radiance : {Rgb(-1, 0, 1e-4f), Rgb(0.01f, 0.2f, 0.7f), Rgb(1, 3, 20000)}) {
        renderer.setIrradiance(std::vector<Rgb>(3, radiance * kPiF));
        Picture view = picture();
        view.tone = {exposure, curve};
        const Rgb shown = renderer.renderToned(view).rgb(kWidth / 2, kHeight / 2);
        const Rgb expected = toDisplay(max(radiance, Rgb(0)), view.tone);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(shown[c], expected[c], 0.4 / 255) << radiance[c] << " at " << exposure;
      }
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

TEST_F(SceneRendererTest, PassesAreTakenAtTheirOwnPlacesInThePixels) {
  SceneRenderer renderer;
  const TriMesh mesh = slantedTriangle();
  renderer.setScene(sceneOf(mesh));
  renderer.setEnvironment(EnvironmentMap(directionMap(512, 256), EnvironmentMapping::LatLong));
  Picture view = picture(1);
  view.smoothEnvironment = true;
  view.camera.verticalFov = 1.2f;
  view.tone.exposure = -2;
  constexpr int kPasses = 8;
  const Framebuffer target = Framebuffer::create(kWidth, kHeight, PixelFormat::Rgba32f, false);
  for (view.pass = 0; view.pass < kPasses; ++view.pass) renderer.draw(view, target.id());
  const Image mean = target.read();

  // Black where a ray through the place of a pass meets the triangle, else the environment.
  int wrong = 0, mixed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      Rgb expected(0);
      int hits = 0;
      for (int pass = 0; pass < kPasses; ++pass) {
        const Vec2 at = passShift(pass);
        const Vec3 d = view.camera.direction(float(x) + 0.5f + at.x, float(y) + 0.5f - at.y, kWidth, kHeight);
        if (meets(view.camera.eye, d, mesh))
          ++hits;
        else
          expected += toDisplay(Rgb(2) + d, view.tone) / float(kPasses);
      }
      mixed += hits > 0 && hits < kPasses;
      wrong += length(mean.rgb(x, y) - expected) > 0.02f;
    }
  EXPECT_GT(mixed, 30);
  EXPECT_LE(wrong, 2) << "of " << mixed << " pixels on edges";
}

// Where a triangle covers part of a pixel but not its middle, what lies beyond its edge must not show: thin
// triangles with light at one end and none at the other would flare up.
TEST_F(SceneRendererTest, PixelsThatAreCoveredInPartStayWithinTheirTriangles) {
  SceneRenderer renderer;
  const TriMesh rock = makeRock({});
  renderer.setScene(sceneOf(rock, {.albedo = Rgb(1)}));
  std::vector<Rgb> irradiance;
  for (std::size_t v = 0; v < rock.vertexCount(); ++v)
    irradiance.push_back(v % 3 == 0 ? Rgb(kPiF) : Rgb(0.05f));
  Picture view = picture(4);
  view.camera.eye = {0.4f, 0.3f, 2.6f};
  const auto brightest = [&] {
    const Image image = renderer.render(view);
    float most = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) most = std::max(most, image.rgb(x, y).x);
    return most;
  };
  renderer.setIrradiance(irradiance);
  EXPECT_GT(brightest(), 0.5f);
  EXPECT_LT(brightest(), 1.001f);
  // The same as transferred radiance, which goes from stage to stage.
  std::vector<Rgb> radiance;
  for (const Rgb& e : irradiance) radiance.push_back(e / kPiF * std::sqrt(4 * kPiF));
  renderer.setRadiance(1, radiance);
  EXPECT_GT(brightest(), 0.5f);
  EXPECT_LT(brightest(), 1.001f);
}

TEST_F(SceneRendererTest, LightForAnotherMeshIsRefused) {
  SceneRenderer renderer;
  renderer.setScene(sceneOf(slantedTriangle()));
  EXPECT_THROW(renderer.setIrradiance(std::vector<Rgb>(2)), ValueError);
}

}  // namespace
}  // namespace prt::gl
