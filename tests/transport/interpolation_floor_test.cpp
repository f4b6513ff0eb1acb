#include "libprt/transport/interpolation_floor.h"

#include "libprt/core/error.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::BakeInput;

TransferSettings settings(int rays, int bounces) {
  TransferSettings s;
  s.rays = rays, s.bounces = bounces;
  return s;
}

InterpolationFloor measure(const BakeInput& input, const TransferSettings& s, std::size_t points,
                           std::span<const ShRgb> lights = {}) {
  Job job;
  FloorOptions options;
  options.points = points;
  return measureInterpolationFloor(input.scene, input.rays, *input.samples, input.transfer(s), s, lights, job,
                                   options);
}

/// The definition with so many rays that their noise does not matter.
double plainFloor(const BakeInput& input, int bounces, std::size_t points, const ShRgb& light) {
  Job job;
  const TransferSettings s = settings(4096, bounces);
  const Transfer vertices = input.transfer(s);
  const SampleSet places = samplesOnSurface(*input.scene, points, 99);
  BakeInput free = input;
  free.samples = std::make_shared<SampleSet>(places);
  const DirectTransfer direct = free.direct(directSettings(s, TransferForm::Diffuse));
  const Transfer truth =
      finishTransfer(*input.scene, *input.rays, places, direct, s, TransferForm::Diffuse, job, &vertices);
  const std::vector<Rgb> a = irradiance(vertices, light, {}), r = irradiance(truth, light, {});
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const UVec3 t = input.scene->mesh.triangles[places.triangle[i]];
    const Vec2 b = places.barycentric[i];
    const Rgb mean = (1 - b.x - b.y) * a[t.x] + b.x * a[t.y] + b.y * a[t.z];
    error += dot(DVec3(mean - r[i]), DVec3(mean - r[i]));
    norm += dot(DVec3(r[i]), DVec3(r[i]));
  }
  return std::sqrt(error / norm);
}

TEST(InterpolationFloor, IsWhatItsDefinitionGives) {
  const BakeInput input(test::rock(32), Rgb(0.6f));
  const ShRgb light = test::lobeLight({0.3f, 1, 0.5f});
  const double expected = plainFloor(input, 2, 1500, light);
  const InterpolationFloor floor = measure(input, settings(1024, 2), 1500, {&light, 1});
  EXPECT_GT(expected, 0.01);
  EXPECT_GT(floor.interpolationError, 0);
  EXPECT_LT(floor.interpolationError, 0.15 * expected);
  EXPECT_NEAR(floor.interpolation, expected, 4 * floor.interpolationError);
}

/// Few rays add sampling error to the product, none to the floor.
TEST(InterpolationFloor, SamplingNoiseIsKeptApart) {
  const BakeInput input(test::rock(32), Rgb(0.6f));
  const InterpolationFloor few = measure(input, settings(8, 1), 1500),
                           many = measure(input, settings(2048, 1), 1500);
  EXPECT_NEAR(few.interpolation, many.interpolation,
              4 * std::hypot(few.interpolationError, many.interpolationError));
  EXPECT_GT(few.sampling, 0.03);
  EXPECT_LT(many.sampling, 0.2 * few.sampling);
  EXPECT_NEAR(few.product, std::hypot(few.interpolation, few.sampling), 1e-9);
}

TEST(InterpolationFloor, FinerMeshesHaveALowerOne) {
  const InterpolationFloor coarse = measure(BakeInput(test::rock(20)), settings(256, 0), 800),
                           fine = measure(BakeInput(test::rock(60)), settings(256, 0), 800);
  EXPECT_LT(fine.interpolation, 0.5 * coarse.interpolation);
}

TEST(InterpolationFloor, FormsShareTheMeaning) {
  const BakeInput input(test::rock(20), Rgb(0.6f));
  TransferSettings s = settings(512, 1);
  const double diffuse = measure(input, s, 400).interpolation;
  s.form = TransferForm::Matrix;
  EXPECT_NEAR(measure(input, s, 400).interpolation, diffuse, 0.02 * diffuse + 0.002);
  s.form = TransferForm::None, s.shadows = false;
  EXPECT_EQ(measure(input, s, 400).interpolation, 0);
}

TEST(InterpolationFloor, PartsThatDoNotFitAreRefused) {
  const BakeInput input(test::rock(12)), other(test::rock(16));
  Job job;
  const TransferSettings s = settings(64, 0);
  const Transfer transfer = input.transfer(s);
  EXPECT_THROW(measureInterpolationFloor(other.scene, other.rays, *other.samples, transfer, s, {}, job),
               ValueError);
  FloorOptions few;
  few.points = 3;
  EXPECT_THROW(measureInterpolationFloor(input.scene, input.rays, *input.samples, transfer, s, {}, job, few),
               ValueError);
}

}  // namespace
}  // namespace prt
