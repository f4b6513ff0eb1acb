// How far light captured at the model's middle is from an object that truly stands there: the numbers in
// docs/lights.md.

#include "libprt/core/warp.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/pipeline.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/transfer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

constexpr float kBall = 0.3f;  // radius, in radii of the rock

/// A rock and a ball of radius 1 about the origin, as they are baked and captured.
struct Yard {
  Recipe recipe;
  Products products;
  std::shared_ptr<const Scene> rock;
  std::shared_ptr<const MeshProduct> meshes;
  Vec3 middle{0};
  float radius = 0;

  Yard() {
    recipe.objects.resize(2);
    recipe.objects[0].mesh.path = "builtin:rock";
    recipe.objects[0].mesh.detail = 0.5f;
    recipe.objects[1].mesh.path = "builtin:sphere";
    recipe.objects[1].material.albedo = Rgb(0);
    recipe.objects[1].captured = true;
    recipe.transfer.kind = TransferKind::Diffuse;
    recipe.transfer.bounces = 0;
    Job job;
    products = Pipeline(nullptr, {}).run(recipe, {"mesh", "scene", "samples", "transfer"}, job);
    rock = products.get<SceneProduct>("scene")->scene;
    meshes = products.get<MeshProduct>("mesh");
    middle = rock->mesh.bounds().center();
    for (const Vec3& p : rock->mesh.positions) radius = std::max(radius, length(p - middle));
  }
};

/// Irradiance of a ball of radiance 1 at a sample, the rock in its way: rays into the cone that it fills.
double ballIrradiance(const RayScene& rays, const SampleSet& samples, std::size_t s, const Vec3& centre,
                      float radius) {
  constexpr int kRays = 1024;
  const Vec3 to = centre - samples.origin[s];
  const float height = coneHeight(std::asin(radius / length(to)));
  const Frame frame = frameFromNormal(normalize(to));
  double sum = 0;
  for (int i = 0; i < kRays; ++i) {
    const float turns = float(i) * 0.61803399f;
    const Vec3 d =
        frame.toWorld(sampleUniformCone({turns - std::floor(turns), (float(i) + 0.5f) / kRays}, height));
    const float cosine = dot(d, samples.shadingNormal[s]);
    if (cosine > 0 && dot(d, samples.geometricNormal[s]) > 0 && !rays.occluded({samples.origin[s], 0, d}))
      sum += double(cosine);
  }
  return 2 * kPi * double(height) * sum / kRays;
}

struct Errors {
  double lamp = 0;   ///< of the ball's light alone, relative to its root mean square
  double black = 0;  ///< of what a black ball leaves of an even sky, relative to that of the sky
  double bands = 0;  ///< of the ball's light, were it as far away as it seems: what bands alone leave
};

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / double(values.size()));
}

/// With the ball so many radii of the rock from its middle.
Errors errorsAt(const Yard& yard, float distance) {
  const SampleSet& samples = *yard.products.get<SamplesProduct>("samples")->samples;
  const Transfer& transfer = yard.products.get<TransferProduct>("transfer")->transfer;
  const RayScene rays(*yard.rock);
  const Vec3 direction = normalize(Vec3(1, 0.6f, 0.8f));
  const auto ballAt = [&](float away) {
    Recipe recipe = yard.recipe;
    const Box3 unit = yard.meshes->meshes[1]->bounds();
    const float scale = 2 * kBall * yard.radius / (unit.high.x - unit.low.x) * (away / distance);
    recipe.objects[1].emission = Rgb(1);
    recipe.objects[1].transform.scale = Vec3(scale);
    recipe.objects[1].transform.translate =
        yard.middle + away * yard.radius * direction - scale * unit.center();
    return recipe;
  };
  Job job;
  const ShRgb light = SceneLighting()
                          .light({}, ShRgb(transfer.bands), {},
                                 surroundingsOf(ballAt(distance), *yard.meshes), yard.middle, job)
                          .light;
  const std::vector<Rgb> captured = irradiance(transfer, light, samples.shadingNormal);
  ShRgb even(transfer.bands);
  even.c[0] = Rgb(float(std::sqrt(4 * kPi)));
  const std::vector<Rgb> sky = irradiance(transfer, even, samples.shadingNormal);
  // As far away as light from infinity: the same ball a thousand times as large and as far.
  std::vector<double> lampError, lamp, skyLight, farError, farLamp;
  for (std::size_t s = 0; s < samples.vertices; s += 5) {
    const auto truth = [&](float away) {
      return ballIrradiance(rays, samples, s, yard.middle + away * yard.radius * direction,
                            kBall * yard.radius * away / distance);
    };
    const double near = truth(distance), far = truth(1000 * distance);
    lamp.push_back(near), lampError.push_back(double(captured[s].x) - near);
    farLamp.push_back(far), farError.push_back(double(captured[s].x) - far);
    skyLight.push_back(double(sky[s].x));
  }
  // Before an even sky the ball is a lamp of radiance -1: what is wrong is the same.
  return {rms(lampError) / rms(lamp), rms(lampError) / rms(skyLight), rms(farError) / rms(farLamp)};
}

TEST(CapturedError, GrowsAsTheObjectComesNear) {
  const Yard yard;
  double before = 0;
  for (const float distance : {8.0f, 4.0f, 2.0f, 1.4f}) {
    const Errors e = errorsAt(yard, distance);
    EXPECT_GT(e.lamp, before) << distance;
    before = e.lamp;
    // Of the order of the rock's radius over the distance, and what five bands leave.
    EXPECT_LT(e.lamp, 0.12 + 0.9 / double(distance)) << distance;
    EXPECT_LT(e.bands, 0.13) << distance;
    EXPECT_LT(e.black, 0.08 / double(distance * distance)) << distance;
  }
}

}  // namespace
}  // namespace prt
