#include "libprt/shade/render.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/material/bsdf.h"
#include "libprt/material/glossy_response.h"
#include "libprt/transport/ray_scene.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace prt {
namespace {

using test::append;
using test::grid;
using test::lambert;
using test::rock;
using test::sceneOf;
using test::sphere;

constexpr int kBands = 5, kFunctions = 25;

ShRgb constantLight(float radiance) {
  ShRgb light(kBands);
  light.c[0] = Rgb(radiance * float(std::sqrt(4 * kPi)));
  return light;
}

/// Some smooth light, mostly positive, different in every band and colour.
ShRgb variedLight() {
  ShRgb light = constantLight(1);
  for (int k = 1; k < kFunctions; ++k)
    light.c[std::size_t(k)] =
        Rgb(0.25f * std::sin(float(k)), 0.2f * std::cos(2.0f * float(k)), 0.15f * std::sin(3.0f * float(k)));
  return light;
}

Transfer transferOf(TransferForm form, std::size_t samples, int channels, std::vector<std::int64_t> shape,
                    const std::vector<float>& values) {
  Transfer t;
  t.form = form, t.bands = kBands, t.samples = samples, t.channels = channels;
  t.values = Array::from<float>(values, std::move(shape));
  return t;
}

Transfer noTransfer(std::size_t samples) {
  Transfer t;
  t.form = TransferForm::None, t.bands = kBands, t.samples = samples;
  return t;
}

/// Everything visible: the visibility function 1, the identity, and the unshadowed vector are one and the
/// same.
Transfer openVisibility(std::size_t samples) {
  std::vector<float> v(samples * 81, 0.0f);
  for (std::size_t s = 0; s < samples; ++s) v[s * 81] = float(std::sqrt(4 * kPi));
  return transferOf(TransferForm::Visibility, samples, 1, {std::int64_t(samples), 81}, v);
}
Transfer identityMatrices(std::size_t samples, int channels) {
  std::vector<float> v(samples * kFunctions * kFunctions * std::size_t(channels), 0.0f);
  for (std::size_t s = 0; s < samples; ++s)
    for (std::size_t k = 0; k < kFunctions; ++k)
      for (std::size_t c = 0; c < std::size_t(channels); ++c)
        v[((s * kFunctions + k) * kFunctions + k) * std::size_t(channels) + c] = 1;
  Transfer t;
  t.form = TransferForm::Matrix, t.bands = kBands, t.samples = samples, t.channels = channels;
  t.values = packedMatrices(v, samples, channels, kBands, DType::f32);
  return t;
}
Transfer openDiffuse(const SampleSet& samples) {
  std::vector<float> v(samples.size() * kFunctions);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    lambertResponse(kBands, samples.shadingNormal[s], {v.data() + s * kFunctions, kFunctions});
    for (std::size_t k = 0; k < kFunctions; ++k) v[s * kFunctions + k] *= kPiF;
  }
  return transferOf(TransferForm::Diffuse, samples.size(), 1, {std::int64_t(samples.size()), kFunctions}, v);
}

Material phong(const Rgb& albedo, const Rgb& specular, float exponent) {
  Material m = lambert(albedo);
  m.model = MaterialModel::Phong, m.specular = specular, m.exponent = exponent;
  return m;
}

struct World {
  Scene scene;
  SampleSet samples;
  Camera camera;
  explicit World(TriMesh mesh, const Material& material = lambert(Rgb(0.8f, 0.5f, 0.3f)))
      : scene(sceneOf(std::move(mesh), material)), samples(samplesAtVertices(scene)) {
    camera.eye = {1.5f, 2, 3};
  }
  Image draw(const Transfer& transfer, const ShRgb& light, ShadeMethod method = ShadeMethod::Auto,
             int grid = 2, const LightRig* background = nullptr) const {
    Job job;
    return render({scene, samples, transfer, light, method, {}, background}, camera, 48, 40, grid, job);
  }
};

double largestDifference(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    most = std::max(most, std::abs(double(a.data[i]) - b.data[i]));
  return most;
}

TEST(Render, WhitePlaneUnderWhiteSkyIsExactlyOne) {
  const World w(grid({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, 4, 4), lambert(Rgb(1)));
  const Transfer forms[] = {noTransfer(25), openVisibility(25), identityMatrices(25, 1),
                            identityMatrices(25, 3), openDiffuse(w.samples)};
  for (const Transfer& t : forms) {
    const Image image = w.draw(t, constantLight(1));
    for (std::size_t i = 0; i < image.data.size(); ++i) ASSERT_NEAR(image.data[i], 1, 2e-6) << int(t.form);
  }
}

TEST(Render, FormsThatMeanTheSameShowTheSame) {
  const World w(rock(40));
  const std::size_t n = w.samples.size();
  const Image none = w.draw(noTransfer(n), variedLight());
  EXPECT_LT(largestDifference(none, w.draw(openVisibility(n), variedLight())), 1e-5);
  EXPECT_LT(largestDifference(none, w.draw(identityMatrices(n, 1), variedLight())), 1e-5);
  EXPECT_LT(largestDifference(none, w.draw(identityMatrices(n, 3), variedLight())), 1e-5);
  // Vertex irradiance, interpolated, differs from per-pixel normals by the interpolation only.
  const double interpolated = largestDifference(none, w.draw(openDiffuse(w.samples), variedLight()));
  EXPECT_GT(interpolated, 1e-5);
  EXPECT_LT(interpolated, 0.05);
}

/// The plain twin: one pixel at one sample, by brute force in double.
TEST(Render, PixelsAreIrradianceTimesAlbedo) {
  const World w(rock(40));
  const Image image = w.draw(noTransfer(w.samples.size()), variedLight(), ShadeMethod::Diffuse, 1);
  const RayScene rays(w.scene);
  const CameraRays through(w.camera, 48, 40);
  int compared = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) {
      const Hit hit = rays.intersect({w.camera.eye, 0, through.direction(float(x) + 0.5f, float(y) + 0.5f)});
      if (!hit.valid() || image.pixel(x, y)[3] == 0) continue;
      const UVec3& t = w.scene.mesh.triangles[hit.triangle];
      const Vec2 b = hit.barycentric;
      const DVec3 n = normalize(DVec3((1 - b.x - b.y) * w.scene.mesh.normals[t.x] +
                                      b.x * w.scene.mesh.normals[t.y] + b.y * w.scene.mesh.normals[t.z]));
      std::vector<double> basis(kFunctions);
      shEvaluate(kBands, n, basis);
      const double a[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24};
      DVec3 e(0);
      for (int l = 0; l < kBands; ++l)
        for (int m = -l; m <= l; ++m)
          e += a[l] * basis[std::size_t(shIndex(l, m))] * DVec3(variedLight().c[std::size_t(shIndex(l, m))]);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.pixel(x, y)[c], std::max(0.0, w.scene.materials[0].albedo[c] * e[c] / kPi), 2e-3)
            << x << " " << y;
      ++compared;
    }
  EXPECT_GT(compared, 300);
}

TEST(Render, GlossyPlaneUnderWhiteSkyShowsItsDirectionalAlbedo) {
  const Material material = phong(Rgb(0.3f), Rgb(0.5f, 0.4f, 0.2f), 20);
  const World w(grid({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, 4, 4), material);
  for (const Transfer& t : {noTransfer(25), openVisibility(25), identityMatrices(25, 3)}) {
    const Image image = w.draw(t, constantLight(1), ShadeMethod::Auto, 1);
    const CameraRays through(w.camera, 48, 40);
    for (const auto& [x, y] : {std::pair(24, 20), std::pair(2, 35), std::pair(40, 3)}) {
      const Vec3 d = -through.direction(float(x) + 0.5f, float(y) + 0.5f);
      const Rgb expected = directionalAlbedo(material, {d.x, -d.z, d.y});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.pixel(x, y)[c], expected[c], 2e-3);
    }
  }
}

TEST(Render, GlossOfNothingIsLambert) {
  const World matte(rock(30)), glossless(rock(30), phong(Rgb(0.8f, 0.5f, 0.3f), Rgb(1e-6f), 50));
  const std::size_t n = matte.samples.size();
  EXPECT_LT(largestDifference(matte.draw(identityMatrices(n, 1), variedLight()),
                              glossless.draw(identityMatrices(n, 1), variedLight())),
            1e-4);
}

TEST(Render, GlossyPictureTurnsWithEverything) {
  // Turn mesh, light and camera by 90 degrees about Y: the picture stays.
  const Material material = phong(Rgb(0.2f), Rgb(0.7f), 12);
  const World w(rock(40), material);
  TriMesh turned = rock(40);
  const auto turn = [](const Vec3& v) { return Vec3(v.z, v.y, -v.x); };
  for (Vec3& p : turned.positions) p = turn(p);
  for (Vec3& n : turned.normals) n = turn(n);
  World v(turned, material);
  v.camera.eye = turn(w.camera.eye);
  const ShRgb light = variedLight();
  ShRgb turnedLight(kBands);  // c'(w) = c(R^-1 w), projected by a fine grid
  const int steps = 200;
  std::vector<float> y(kFunctions);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      const double theta = kPi * (i + 0.5) / steps, phi = kPi * (j + 0.5) / steps;
      const Vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const Rgb l = light.evaluate({-d.z, d.y, d.x});
      shEvaluate(kBands, d, y);
      for (std::size_t k = 0; k < kFunctions; ++k)
        turnedLight.c[k] += l * y[k] * float(std::sin(theta) * kPi / steps * kPi / steps);
    }
  const std::size_t n = w.samples.size();
  EXPECT_LT(largestDifference(w.draw(noTransfer(n), light), v.draw(noTransfer(n), turnedLight)), 2e-3);
}

TEST(Render, GivenIrradianceIsShownInterpolated) {
  const World w(grid({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, 4, 4), lambert(Rgb(0.5f)));
  std::vector<Rgb> e;  // linear in x: interpolation is exact
  for (const Vec3& p : w.scene.mesh.positions) e.push_back(Rgb(10 + p.x));
  Job job;
  const Transfer t = noTransfer(25);
  const ShRgb light(kBands);
  const Image image = render({w.scene, w.samples, t, light, ShadeMethod::Auto, e}, w.camera, 48, 40, 1, job);
  const CameraRays through(w.camera, 48, 40);
  for (const auto& [x, y] : {std::pair(24, 20), std::pair(2, 35), std::pair(46, 39)}) {
    const Vec3 d = through.direction(float(x) + 0.5f, float(y) + 0.5f);
    const float hit = w.camera.eye.x - d.x * w.camera.eye.y / d.y;
    EXPECT_NEAR(image.pixel(x, y)[0], 0.5f / kPiF * (10 + hit), 1e-3);
  }
}

TEST(Render, IrradianceThatFewBandsMissIsAdded) {
  // A visibility form whose exact vectors say a quarter more than its bands can: the picture believes them.
  const World w(grid({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, 4, 4), lambert(Rgb(0.5f)));
  Transfer t = openVisibility(25);
  t.diffuse = openDiffuse(w.samples).values;
  std::vector<float> more(t.diffuse.as<float>().begin(), t.diffuse.as<float>().end());
  for (std::size_t i = 0; i < more.size(); ++i) more[i] *= 1.25f;
  t.diffuse = Array::from<float>(more, t.diffuse.shape);
  const Image matte = w.draw(t, constantLight(1));
  EXPECT_NEAR(matte.pixel(24, 20)[0], 0.625, 1e-5);
  // The diffuse part of a glossy material as well.
  World glossy(grid({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, 4, 4), phong(Rgb(0.5f), Rgb(0.4f), 20));
  const Image with = glossy.draw(t, constantLight(1)),
              without = glossy.draw(openVisibility(25), constantLight(1));
  EXPECT_NEAR(with.pixel(24, 20)[0] - without.pixel(24, 20)[0], 0.125, 1e-5);
}

TEST(Render, BacksAreBlackUnlessTwoSided) {
  TriMesh lid = grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2, 2);
  World oneSided(lid, lambert(Rgb(1)));
  Material both = lambert(Rgb(1));
  both.twoSided = true;
  World twoSided(lid, both);
  oneSided.camera.eye = twoSided.camera.eye = {0.5f, -3, 0.5f};
  ShRgb light = constantLight(1);
  light.c[1] = Rgb(0.5f);  // brighter from above: the back sees less than 1
  const Image black = oneSided.draw(noTransfer(oneSided.samples.size()), light);
  const Image lit = twoSided.draw(noTransfer(twoSided.samples.size()), light);
  EXPECT_EQ(black.rgb(24, 20), Rgb(0));
  EXPECT_EQ(black.pixel(24, 20)[3], 1);
  const double expected = 1 - 0.5 * 2.0 / 3 * std::sqrt(3 / (4 * kPi));
  EXPECT_NEAR(lit.pixel(24, 20)[0], expected, 1e-4);
  EXPECT_NEAR(twoSided.draw(openDiffuse(twoSided.samples), light).pixel(24, 20)[0], expected, 1e-4);
}

TEST(Render, BackgroundFillsWhatIsNotCovered) {
  const World w(sphere(16, 32), lambert(Rgb(1)));
  LightRig rig;
  rig.constant = Rgb(0.25f, 0.5f, 1);
  const Image image = w.draw(noTransfer(w.samples.size()), constantLight(1), ShadeMethod::Auto, 4, &rig);
  const Image plain = w.draw(noTransfer(w.samples.size()), constantLight(1), ShadeMethod::Auto, 4);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) {
      const float alpha = plain.pixel(x, y)[3];
      EXPECT_EQ(image.pixel(x, y)[3], 1);
      EXPECT_NEAR(length(image.rgb(x, y) - (plain.rgb(x, y) + (1 - alpha) * rig.constant)), 0, 1e-5);
    }
  EXPECT_EQ(plain.pixel(0, 0)[3], 0);
}

TEST(Render, RingingAndBadNumbersNeverShow) {
  const World w(rock(30), phong(Rgb(0.5f), Rgb(0.5f), 40));
  ShRgb light(kBands);
  light.c[2] = Rgb(5);  // as much negative light as positive
  light.c[7] = Rgb(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1);
  const std::size_t n = w.samples.size();
  for (const Transfer& t : {noTransfer(n), openVisibility(n)})
    for (const float v : w.draw(t, light).data) {
      EXPECT_TRUE(std::isfinite(v));
      EXPECT_GE(v, 0);
    }
}

TEST(Render, DoesNotDependOnThreads) {
  const World w(rock(40), phong(Rgb(0.3f), Rgb(0.5f), 10));
  const std::size_t n = w.samples.size();
  setThreadCount(1);
  const Image one = w.draw(openVisibility(n), variedLight());
  setThreadCount(6);
  const Image six = w.draw(openVisibility(n), variedLight());
  setThreadCount(0);
  EXPECT_EQ(one.data, six.data);
}

TEST(Render, RefusesWhatDoesNotFit) {
  const World w(sphere(8, 16), phong(Rgb(0.3f), Rgb(0.5f), 10));
  const std::size_t n = w.samples.size();
  EXPECT_THROW(w.draw(openVisibility(n - 1), constantLight(1)), ValueError);
  EXPECT_THROW(w.draw(openDiffuse(w.samples), constantLight(1), ShadeMethod::Glossy), ValueError);
  EXPECT_NO_THROW(w.draw(openDiffuse(w.samples), constantLight(1)));  // Auto shows what the form can
}

}  // namespace
}  // namespace prt
