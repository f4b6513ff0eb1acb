#include "libprt/transport/error_map.h"

#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/transport/interpolation_floor.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace prt {
namespace {

using test::BakeInput;

TransferSettings settings(int rays, int bounces, std::uint64_t seed = 1) {
  TransferSettings s;
  s.rays = rays, s.bounces = bounces, s.seed = seed;
  return s;
}

struct Probed {
  std::shared_ptr<const Transfer> product;
  ErrorProbe probe;
};

Probed probed(const BakeInput& input, const TransferSettings& s) {
  Job job;
  const auto product = std::make_shared<const Transfer>(input.transfer(s));
  return {product, ErrorProbe::measure(input.scene, input.rays, *input.samples, product, s, job)};
}

/// Shown as it is: nothing is cut off.
JudgedLight uncut(const ShRgb& light) {
  return {light, light};
}

std::vector<double> vertexAreas(const TriMesh& mesh) {
  std::vector<double> area(mesh.vertexCount(), 0);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) area[mesh.triangles[t][k]] += double(length(mesh.areaNormal(t)));
  return area;
}

/// Root-mean-square of `predicted` and of `measured` over the share of places with the largest predictions.
struct Group {
  double predicted = 0, measured = 0, squares = 0;
};
Group worst(const std::vector<double>& predicted, const std::vector<double>& measured, double share) {
  std::vector<std::size_t> order(predicted.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return predicted[a] > predicted[b]; });
  const auto count = std::size_t(share * double(order.size()));
  Group group;
  for (std::size_t i = 0; i < count; ++i) {
    group.predicted += predicted[order[i]] * predicted[order[i]];
    group.squares += measured[order[i]] * measured[order[i]];
  }
  group.predicted = std::sqrt(group.predicted / double(count));
  group.measured = std::sqrt(group.squares / double(count));
  return group;
}

/// The estimate against what many rays say, as a whole and where it is largest.
TEST(ErrorMap, MonteCarloIsTheNoiseOfTheBake) {
  const BakeInput input(test::rock(40), Rgb(0.6f));
  const ShRgb light = test::lobeLight({0.3f, 1, 0.5f});
  const std::vector<double> area = vertexAreas(input.scene->mesh);
  const std::vector<Rgb> truth = irradiance(input.transfer(settings(16384, 1, 77)), light, {});
  for (const auto& [rays, form] :
       {std::pair(128, TransferForm::Diffuse), std::pair(512, TransferForm::Diffuse),
        std::pair(512, TransferForm::Matrix)}) {
    TransferSettings s = settings(rays, 1);
    s.form = form;
    const Probed bake = probed(input, s);
    const ErrorMap map = bake.probe.under(uncut(light));
    const std::vector<Rgb> product = irradiance(*bake.product, light, {});
    double error = 0, norm = 0;
    std::vector<double> predicted, measured;
    for (std::size_t v = 0; v < area.size(); ++v) {
      const DVec3 difference(product[v] - truth[v]);
      error += area[v] * dot(difference, difference);
      norm += area[v] * dot(DVec3(product[v]), DVec3(product[v]));
      predicted.push_back(map.vertices[v].x);
      measured.push_back(length(difference) / map.meanIrradiance);
    }
    const double expected = std::sqrt(error / norm);
    EXPECT_GT(expected, 1e-3);
    EXPECT_NEAR(map.rms.x, expected, 0.2 * expected) << rays << " rays";
    const Group noisy = worst(predicted, measured, 0.25), all = worst(predicted, measured, 1);
    EXPECT_NEAR(noisy.predicted, noisy.measured, 0.25 * noisy.measured) << rays << " rays, the noisy quarter";
    EXPECT_GT(noisy.squares, 0.5 * all.squares) << "the noise is where the map says";
  }
}

TEST(ErrorMap, InterpolationIsTheFloor) {
  const BakeInput input(test::rock(32), Rgb(0.6f));
  const TransferSettings s = settings(1024, 1);
  const Probed bake = probed(input, s);
  Job job;
  FloorOptions options;
  options.points = 3000;
  const InterpolationFloor floor =
      measureInterpolationFloor(input.scene, input.rays, *input.samples, *bake.product, s, {}, job, options);
  const ErrorMap map = bake.probe.underPrior();
  EXPECT_GT(floor.interpolation, 0.01);
  EXPECT_NEAR(map.rms.y, floor.interpolation, 6 * floor.interpolationError);
}

/// Where the map is bright, points inside the faces are far from what their corners say, with many rays.
TEST(ErrorMap, InterpolationIsWhereFacesDiffer) {
  const BakeInput input(test::rock(28), Rgb(0.6f));
  const ShRgb light = test::lobeLight({0.3f, 1, 0.5f});
  const TriMesh& mesh = input.scene->mesh;
  const ErrorMap map = probed(input, settings(512, 0)).probe.under(uncut(light));

  std::vector<std::uint32_t> triangles(4 * mesh.triangleCount());
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = std::uint32_t(i / 4);
  const auto places = std::make_shared<SampleSet>(samplesInTriangles(*input.scene, triangles, 5));
  BakeInput inside = input;
  inside.samples = places;
  const std::vector<Rgb> corner = irradiance(input.transfer(settings(4096, 0, 9)), light, {});
  const std::vector<Rgb> truth = irradiance(inside.transfer(settings(4096, 0, 9)), light, {});
  std::vector<double> predicted(mesh.triangleCount()), measured(mesh.triangleCount(), 0.0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const UVec3& t = mesh.triangles[triangles[i]];
    const Vec2 b = places->barycentric[i];
    const DVec3 difference((1 - b.x - b.y) * corner[t.x] + b.x * corner[t.y] + b.y * corner[t.z] - truth[i]);
    measured[triangles[i]] += dot(difference, difference) / 4;
  }
  for (std::size_t t = 0; t < measured.size(); ++t) {
    measured[t] = std::sqrt(measured[t]) / map.meanIrradiance;
    for (int k = 0; k < 3; ++k) predicted[t] += std::pow(map.vertices[mesh.triangles[t][k]].y, 2) / 3;
    predicted[t] = std::sqrt(predicted[t]);
  }
  const Group bright = worst(predicted, measured, 0.25), all = worst(predicted, measured, 1);
  EXPECT_GT(bright.squares, 0.5 * all.squares);
  EXPECT_NEAR(bright.predicted, bright.measured, 0.35 * bright.measured);
  EXPECT_NEAR(all.predicted, all.measured, 0.25 * all.measured);
}

/// Over an open plane every band is known exactly: A_l Y(normal) times its coefficient.
TEST(ErrorMap, TruncationOfAnOpenPlaneIsExact) {
  const Vec3 normal = normalize(Vec3(0.2f, 1, 0.3f));
  const Frame frame = frameFromNormal(normal);
  const BakeInput input(test::grid(Vec3(0), frame.tangent, frame.bitangent, 6, 6));
  JudgedLight light;
  light.whole = test::constantLight(Rgb(1), kErrorBands);
  light.shown = test::constantLight(Rgb(1));
  light.whole.c[std::size_t(shIndex(6, 2))] = Rgb(7, 2, 1);
  const ErrorMap map = probed(input, settings(64, 0)).probe.under(light);
  std::vector<double> y(std::size_t(shCount(kErrorBands)));
  shEvaluate(kErrorBands, DVec3(normal), y);
  const double beyond =
      clampedCosineFactors(kErrorBands)[6] * y[std::size_t(shIndex(6, 2))] * length(DVec3(7, 2, 1));
  const double expected = std::abs(beyond) / (kPi * std::sqrt(3.0));
  EXPECT_GT(expected, 1e-3);
  EXPECT_NEAR(map.rms.z, expected, 1e-4);
  EXPECT_NEAR(map.vertices[20].z, expected, 1e-4);
  EXPECT_NEAR(map.rms.x, 0, 1e-5) << "nothing is blocked: no noise";
  EXPECT_NEAR(map.rms.y, 0, 1e-3);
}

TEST(ErrorMap, AWindowCutsToo) {
  const BakeInput input(test::grid(Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0), 4, 4));
  JudgedLight light;
  light.whole = light.shown = test::constantLight(Rgb(1));
  light.shown.c[0] *= 0.9f;
  EXPECT_NEAR(probed(input, settings(64, 0)).probe.under(light).rms.z, 0.1 / 0.9, 1e-3);
}

TEST(ErrorMap, BandsThatAreBakedAreNotCutOff) {
  const BakeInput input(test::rock(24), Rgb(0.5f));
  TransferSettings s = settings(2048, 0);
  const ShRgb light = test::lobeLight({0, 1, 0.2f}, kErrorBands);
  const auto cut = [&](int bands) {
    s.bands = bands;
    JudgedLight judged{light, light};
    judged.shown.bands = bands;
    judged.shown.c.resize(std::size_t(shCount(bands)));
    return probed(input, s).probe.under(judged).rms.z;
  };
  const double three = cut(3), five = cut(5), eight = cut(8);
  EXPECT_GT(three, 1.3 * five);
  EXPECT_GT(five, eight);
  EXPECT_NEAR(cut(kErrorBands), 0, 1e-9);
}

/// Everything is relative: twice the light, the same map; and one probe serves every light.
TEST(ErrorMap, IsRelativeToTheLight) {
  const BakeInput input(test::rock(16), Rgb(0.5f, 0.3f, 0.2f));
  const Probed bake = probed(input, settings(128, 2));
  EXPECT_EQ(bake.product->channels, 3);
  ShRgb light = test::lobeLight({1, 1, 0});
  const ErrorMap once = bake.probe.under(uncut(light));
  for (Rgb& c : light.c) c *= 2.0f;
  const ErrorMap twice = bake.probe.under(uncut(light));
  EXPECT_NEAR(twice.meanIrradiance, 2 * once.meanIrradiance, 1e-6 * once.meanIrradiance);
  for (std::size_t v = 0; v < once.vertices.size(); ++v)
    EXPECT_NEAR(length(once.vertices[v] - twice.vertices[v]), 0, 1e-5);
  EXPECT_NEAR(once.totalRms(), length(once.rms), 1e-12);
  EXPECT_NEAR(once.share(ErrorMap::MonteCarlo) + once.share(ErrorMap::Interpolation) +
                  once.share(ErrorMap::Truncation),
              1, 1e-9);
  EXPECT_NEAR(once.total(3), length(once.vertices[3]), 1e-6);
}

TEST(ErrorMap, MoreRaysLessNoise) {
  const BakeInput input(test::rock(24));
  const double few = probed(input, settings(64, 0)).probe.underPrior().rms.x,
               many = probed(input, settings(1024, 0)).probe.underPrior().rms.x;
  EXPECT_LT(many, 0.2 * few);
  EXPECT_GT(many, 0.02 * few);
}

TEST(ErrorMap, FormsShareTheMeaning) {
  const BakeInput input(test::rock(20), Rgb(0.6f));
  TransferSettings s = settings(512, 1);
  const ErrorMap diffuse = probed(input, s).probe.underPrior();
  s.form = TransferForm::Matrix;
  const ErrorMap matrix = probed(input, s).probe.underPrior();
  EXPECT_NEAR(matrix.rms.y, diffuse.rms.y, 0.1 * diffuse.rms.y);
  s.form = TransferForm::None, s.shadows = false;
  EXPECT_EQ(probed(input, s).probe.underPrior().totalRms(), 0);
}

/// Half of a ball under the ground: nothing is known of what nobody sees.
TEST(ErrorMap, BuriedVerticesAreUnknown) {
  TriMesh mesh = test::sphere(16, 32, 1, {0, 0, 0});
  test::append(mesh, test::box({-2, -3, -2}, {2, -0.2f, 2}, 8));
  const BakeInput input(std::move(mesh));
  const ErrorMap map = probed(input, settings(256, 0)).probe.underPrior();
  const std::vector<Vec3>& positions = input.scene->mesh.positions;
  int unknown = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (length(positions[v]) < 1.01f && positions[v].y > 0.1f) {
      EXPECT_GE(map.total(v), 0);
    }
    if (length(positions[v]) < 1.01f && positions[v].y < -0.5f) unknown += map.total(v) == -1;
  }
  EXPECT_GT(unknown, 50);
}

TEST(ErrorMap, APreviewKnowsAllButInterpolation) {
  const BakeInput input(test::rock(12));
  const TransferSettings s = settings(64, 0);
  const auto product = std::make_shared<const Transfer>(input.transfer(s));
  Job job;
  int previews = 0;
  double noise = 0;
  const ErrorProbe probe = ErrorProbe::measure(input.scene, input.rays, *input.samples, product, s, job,
                                               [&](const ErrorProbe& early) {
                                                 ++previews;
                                                 EXPECT_FALSE(early.knowsInterpolation());
                                                 noise = early.underPrior().rms.x;
                                                 EXPECT_EQ(early.underPrior().rms.y, 0);
                                               });
  EXPECT_EQ(previews, 1);
  EXPECT_TRUE(probe.knowsInterpolation());
  EXPECT_EQ(probe.underPrior().rms.x, noise);
}

TEST(ErrorMap, CanBeCancelledAndRefusesWhatDoesNotFit) {
  const BakeInput input(test::rock(12)), other(test::rock(16));
  const TransferSettings s = settings(64, 0);
  const auto product = std::make_shared<const Transfer>(input.transfer(s));
  Job job;
  EXPECT_THROW(ErrorProbe::measure(other.scene, other.rays, *other.samples, product, s, job), ValueError);
  job.cancel();
  EXPECT_THROW(ErrorProbe::measure(input.scene, input.rays, *input.samples, product, s, job), Cancelled);
}

}  // namespace
}  // namespace prt
