#include "libprt/shade/surroundings.h"

#include "libprt/light/projection.h"
#include "libprt/shade/live_renderer.h"
#include "libprt/shade/render.h"
#include "libprt/transport/ray_scene.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::lambert;

std::shared_ptr<const TriMesh> shared(TriMesh mesh) {
  return std::make_shared<const TriMesh>(std::move(mesh));
}

ShRgb someLight(int bands) {
  LightRig rig;
  rig.constant = Rgb(0.4f, 0.5f, 0.6f);
  rig.circles = {{normalize(Vec3(1, 1, 1)), 0.5f, Rgb(3, 2, 1)}};
  return projectLights(rig, bands);
}

Surroundings surroundings(const std::vector<SceneObject>& objects, std::vector<Rgb> emission,
                          const ShRgb& light) {
  Surroundings s{std::make_shared<const Scene>(flattenScene(objects))};
  s.samples = bareSamples(*s.scene);
  s.emission = std::move(emission);
  s.light = light;
  return s;
}

CapturedCube captured(const Surroundings& s, const Vec3& place) {
  Job job;
  return CubeView(s.scene->mesh, place, job).capture(s, job);
}

double difference(const ShRgb& a, const ShRgb& b) {
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < b.c.size(); ++k)
    worst = std::max(worst, double(length(a.c[k] - b.c[k]))), scale = std::max(scale, double(length(b.c[k])));
  return worst / scale;
}

TEST(Surroundings, AShiningSphereIsACircleLight) {
  const Vec3 place(1, 2, 3), axis = normalize(Vec3(-1, 0.4f, 0.7f));
  for (const float distance : {1.5f, 3.0f, 6.0f}) {
    const Surroundings s = surroundings(
        {{"ball", shared(test::sphere(48, 96, 1, place + distance * axis)), Mat4(1), lambert(Rgb(0))}},
        {Rgb(3, 2, 1)}, ShRgb(5));
    LightRig circle;
    circle.circles = {{axis, std::asin(1 / distance), Rgb(3, 2, 1)}};
    EXPECT_LT(difference(capturedDifference(captured(s, place), {}, nullptr, 5), projectLights(circle, 5)),
              0.01)
        << distance;
  }
}

/// Rays in a hundred thousand directions, and the integral over them: the slow twin.
TEST(Surroundings, TheCubeShowsWhatRaysMeet) {
  Material shiny = lambert(Rgb(0.5f, 0.2f, 0.1f));
  shiny.twoSided = true;
  const Vec3 place(0.2f, -0.1f, 0.3f);
  const Surroundings s = surroundings(
      {{"rock", shared(test::rock(24)),
        Mat4(Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(2, 1, 0, 1)), lambert(Rgb(0.7f))},
       {"wall", shared(test::grid({-2, -1, -2}, {0, 0, 3}, {0, 2, 0}, 4, 4)), Mat4(1), shiny},
       {"lid", shared(test::grid({-1, 2, -1}, {0, 0, 2}, {2, 0, 0}, 2, 2)), Mat4(1), lambert(Rgb(1))}},
      {Rgb(0), Rgb(0.3f, 0, 0), Rgb(5)}, someLight(5));
  const RayScene rays(*s.scene);
  constexpr int kBands = 4, kRows = 220;
  std::vector<DVec3> sum(16, DVec3(0));
  std::vector<double> y(16);
  int met = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < 2 * kRows; ++column) {
      const double z = 1 - 2 * (row + 0.5) / kRows, r = std::sqrt(1 - z * z),
                   phi = kPi * (column + 0.5) / kRows;
      const DVec3 d(r * std::cos(phi), r * std::sin(phi), z);
      const Hit hit = rays.intersect({place, 0, Vec3(d)});
      Rgb radiance(1);  // of the sky
      if (hit.valid()) {
        ++met;
        const TriMesh& mesh = s.scene->mesh;
        const UVec3& t = mesh.triangles[hit.triangle];
        const Vec2& b = hit.barycentric;
        const bool back = dot(mesh.areaNormal(hit.triangle), Vec3(d)) > 0;
        const Vec3 n = (back ? -1.0f : 1.0f) * normalize((1 - b.x - b.y) * mesh.normals[t.x] +
                                                         b.x * mesh.normals[t.y] + b.y * mesh.normals[t.z]);
        const Material& m = s.scene->materialOf(hit.triangle);
        radiance = back && !m.twoSided ? Rgb(0)
                                       : s.emission[s.scene->triangleObject[hit.triangle]] +
                                             m.albedo * max(lambertRadiance(5, n, s.light.c), Rgb(0));
      }
      shEvaluate(kBands, d, y);
      for (std::size_t k = 0; k < y.size(); ++k)
        sum[k] += y[k] * (4 * kPi / (2.0 * kRows * kRows)) * DVec3(radiance);
    }
  EXPECT_GT(met, kRows * kRows / 4);
  ShRgb expected(kBands);
  for (std::size_t k = 0; k < sum.size(); ++k) expected.c[k] = Rgb(sum[k]);
  LightRig sky;
  sky.constant = Rgb(1);
  ShRgb light = projectLights(sky, kBands);
  const ShRgb more = capturedDifference(captured(s, place), sky, nullptr, kBands);
  for (std::size_t k = 0; k < light.c.size(); ++k) light.c[k] += more.c[k];
  EXPECT_LT(difference(light, expected), 0.003);
}

TEST(Surroundings, BlackOnesUnderNoLightChangeNothing) {
  const Surroundings s = surroundings(
      {{"ball", shared(test::sphere(12, 24, 1, {3, 0, 0})), Mat4(1), lambert(Rgb(0))}}, {Rgb(0)}, ShRgb(5));
  const CapturedCube cube = captured(s, Vec3(0));
  EXPECT_FALSE(cube.empty());
  for (const Rgb& c : capturedDifference(cube, {}, nullptr, 5).c) EXPECT_EQ(c, Rgb(0));
}

TEST(Surroundings, WhatStandsFarFromTheOriginIsSeenAsWell) {
  const Vec3 place(4096, -8192, 1024);
  const auto around = [&](const Vec3& at) {
    return surroundings(
        {{"ball", shared(test::sphere(24, 48, 1, at + Vec3(2, 1, 0.5f))), Mat4(1), lambert(Rgb(0))}},
        {Rgb(1)}, ShRgb(5));
  };
  const ShRgb here = capturedDifference(captured(around(Vec3(0)), Vec3(0)), {}, nullptr, 5);
  const ShRgb there = capturedDifference(captured(around(place), place), {}, nullptr, 5);
  EXPECT_LT(difference(there, here), 0.005);
}

// ---- pictures ----

/// A model between two objects, one of which reaches into it, and everything in one scene.
struct Yard {
  std::vector<SceneObject> model, around;
  Scene all, alone;
  Surroundings surroundings;
  Transfer open;
  SampleSet samples, allSamples;

  explicit Yard(int bands = 5) {
    Material gloss = lambert(Rgb(0.4f, 0.5f, 0.6f));
    gloss.model = MaterialModel::Phong, gloss.specular = Rgb(0.4f), gloss.exponent = 20;
    Material sheet = lambert(Rgb(0.7f, 0.2f, 0.2f));
    sheet.twoSided = true;
    model = {{"model", shared(test::rock(40)), Mat4(1), lambert(Rgb(0.6f, 0.5f, 0.3f))}};
    around = {
        {"ball", shared(test::sphere(16, 32, 0.6f, {0.7f, 0.5f, 0.9f})), Mat4(1), gloss},
        {"sheet", shared(test::grid({-1.5f, -1, -0.8f}, {3, 0, 0.5f}, {0, 2, 0}, 5, 5)), Mat4(1), sheet}};
    std::vector<SceneObject> both = model;
    both.insert(both.end(), around.begin(), around.end());
    all = flattenScene(both), alone = flattenScene(model);
    surroundings = prt::surroundings(around, {Rgb(0), Rgb(0)}, someLight(bands));
    open.bands = bands;
    samples = samplesAtVertices(alone), allSamples = samplesAtVertices(all);
  }

  std::vector<Camera> cameras() const {
    Camera behind = frameBox(all.mesh.bounds());
    behind.eye = behind.target - Vec3(0.6f, -0.3f, 1) * length(behind.eye - behind.target);
    Camera parallel = frameBox(all.mesh.bounds());
    parallel.orthographic = true;
    return {frameBox(all.mesh.bounds()), behind, parallel};
  }
};

int differing(const Image& a, const Image& b, float tolerance) {
  int count = 0;
  for (std::size_t i = 0; i < a.data.size(); i += 4) {
    bool same = true;
    for (std::size_t c = 0; c < 4; ++c) same = same && std::abs(a.data[i + c] - b.data[i + c]) <= tolerance;
    count += !same;
  }
  return count;
}

TEST(Surroundings, AreSeenAsIfTheyWereOfTheScene) {
  const Yard yard;
  Job job;
  LightRig sky;
  sky.constant = Rgb(0.4f);
  for (const Camera& camera : yard.cameras())
    for (const LightRig* background :
         {static_cast<const LightRig*>(nullptr), static_cast<const LightRig*>(&sky)}) {
      RenderInput whole{yard.all, yard.allSamples, yard.open, yard.surroundings.light};
      RenderInput parts{yard.alone, yard.samples, yard.open, yard.surroundings.light};
      whole.background = parts.background = background;
      parts.surroundings = &yard.surroundings;
      const Image expected = render(whole, camera, 120, 100, 3, job);
      const Image image = render(parts, camera, 120, 100, 3, job);
      // Where the two meet, either may be the nearer one.
      EXPECT_LE(differing(image, expected, 1e-5f), 12);
      parts.surroundings = nullptr;
      EXPECT_GT(differing(render(parts, camera, 120, 100, 3, job), expected, 1e-5f), 1000);
    }
}

TEST(Surroundings, ShineOnTheSidesThatReflect) {
  Job job;
  const Camera camera{{0, 0, 3}, {0, 0, 0}};
  const auto centre = [&](bool away, bool twoSided) {
    Material m = lambert(Rgb(0));
    m.twoSided = twoSided;
    const Vec3 u(away ? -1 : 1, 0, 0);
    const Surroundings s = surroundings(
        {{"sheet", shared(test::grid(-0.5f * u - Vec3(0, 0.5f, 0), u, {0, 1, 0}, 2, 2)), Mat4(1), m}},
        {Rgb(1, 2, 3)}, ShRgb(5));
    Image image(9, 9, 4);
    addSurroundings(&s, test::sphere(4, 8, 0.1f, {0, 0, -5}), camera, 2, image, job);
    EXPECT_EQ(image.pixel(4, 4)[3], 1);
    return image.rgb(4, 4);
  };
  EXPECT_EQ(centre(false, false), Rgb(1, 2, 3));
  EXPECT_EQ(centre(true, false), Rgb(0));
  EXPECT_EQ(centre(true, true), Rgb(1, 2, 3));
}

TEST(Surroundings, TheLiveRendererShowsWhatTheRendererShows) {
  Yard yard;
  yard.surroundings.emission = {Rgb(0.1f, 0.3f, 0), Rgb(0)};
  Job job;
  LiveRenderer renderer;
  LiveScene live;
  live.scene = std::make_shared<const Scene>(yard.alone);
  live.materials = yard.alone.materials;
  live.light = yard.surroundings.light;
  live.surroundings = yard.surroundings;
  for (const Camera& camera : yard.cameras()) {
    const LivePicture picture{.camera = camera, .width = 150, .height = 140};
    std::vector<std::uint32_t> pixels(150 * 140);
    renderer.draw(live, picture, pixels, job);
    RenderInput input{yard.alone, yard.samples, yard.open, live.light};
    input.surroundings = &yard.surroundings;
    const Image expected = toDisplay(render(input, camera, 150, 140, 1, job), picture.tone);
    int off = 0;
    for (int y = 0; y < 140; ++y)
      for (int x = 0; x < 150; ++x) {
        bool same = true;
        for (int c = 0; c < 3; ++c)
          same = same && std::abs(float(pixels[std::size_t(y * 150 + x)] >> (16 - 8 * c) & 255) -
                                  255 * expected.pixel(x, y)[c]) <= 1;
        off += !same;
      }
    EXPECT_LE(off, 105);  // 0.5 %
  }
}

TEST(Surroundings, TheLiveRendererFollowsWhatMoves) {
  Yard yard;
  Job job;
  LiveScene live;
  live.scene = std::make_shared<const Scene>(yard.alone);
  live.materials = yard.alone.materials;
  live.light = yard.surroundings.light;
  const LivePicture picture{.camera = yard.cameras()[0], .width = 80, .height = 70};
  std::vector<std::uint32_t> pixels(80 * 70), fresh(80 * 70);
  LiveRenderer renderer;
  for (int step = 0; step < 4; ++step) {
    if (step == 1) live.surroundings = yard.surroundings;
    if (step == 2) {
      yard.around[0].transform[3] = Vec4(-0.5f, 0.2f, 0, 1);
      live.surroundings = surroundings(yard.around, {Rgb(1), Rgb(0)}, live.light);
    }
    if (step == 3) live.surroundings.light = someLight(3);
    renderer.draw(live, picture, pixels, job);
    const auto before = fresh;
    LiveRenderer().draw(live, picture, fresh, job);
    EXPECT_EQ(pixels, fresh) << step;
    EXPECT_NE(fresh, before) << step;
  }
}

}  // namespace
}  // namespace prt
