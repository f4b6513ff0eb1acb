#include "libprt/transport/area_means.h"

#include "libprt/core/sampling.h"
#include "libprt/transport/path_tracer.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using test::BakeInput;

DirectSettings settings(int rays) {
  DirectSettings s;
  s.rays = rays;
  return s;
}

SampleRows randomRows(std::size_t count, std::size_t width, std::uint64_t seed) {
  SampleRows rows(count, width);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < width; ++k) rows.row(i)[k] = hashUniform(seed, i, std::uint32_t(k));
  return rows;
}

TEST(AreaMeans, PointsLieInTheirTriangles) {
  const BakeInput input(test::rock(12));
  const SampleSet points = pointsInTriangles(*input.scene, 3);
  ASSERT_EQ(points.size(), input.scene->mesh.triangleCount());
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_EQ(points.triangle[p], p);
    const Vec2 b = points.barycentric[p];
    EXPECT_GE(std::min({b.x, b.y, 1 - b.x - b.y}), 0);
    EXPECT_GT(dot(points.geometricNormal[p], normalize(input.scene->mesh.areaNormal(p))), 0.9999f);
  }
  EXPECT_NE(pointsInTriangles(*input.scene, 4).barycentric, points.barycentric);
}

/// The interpolation of corrected values holds what the points have: its integral is that of the plain one
/// plus area times what each point is off.
TEST(AreaMeans, CorrectedValuesHaveTheSurfacesMean) {
  const BakeInput input(test::rock(12));
  Job job;
  const DirectTransfer direct = input.direct(settings(64));
  const AreaMeans means(*input.scene, *input.rays, *input.samples, direct, 0, job);
  const SampleSet points = pointsInTriangles(*input.scene, direct.settings.seed);
  const SampleRows atVertices = randomRows(input.samples->size(), 3, 1),
                   atPoints = randomRows(points.size(), 3, 2);
  const SampleRows corrected = means.corrected(atVertices, atPoints);
  const TriMesh& mesh = input.scene->mesh;
  const std::span<const std::uint8_t> buried = means.buried();
  ASSERT_EQ(std::count(buried.begin(), buried.end(), 1), 0);
  for (std::size_t k = 0; k < 3; ++k) {
    double expected = 0, actual = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const double area = length(mesh.areaNormal(t));
      const Vec2 b = points.barycentric[t];
      const std::array<double, 3> weight{1.0 - b.x - b.y, b.x, b.y};
      double off = atPoints.row(t)[k];
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = mesh.triangles[t][c];
        off -= weight[std::size_t(c)] * atVertices.row(v)[k];
        expected += area * atVertices.row(v)[k] / 3;
        actual += area * corrected.row(v)[k] / 3;
      }
      expected += area * off;
    }
    EXPECT_NEAR(actual, expected, 1e-4 * std::abs(expected)) << k;
  }
}

/// Mean of irradiance over all vertices under a white sky, from bounces alone, against the path tracer's.
double biasOfBounces(const BakeInput& input, bool areaMeans) {
  Job job;
  LightRig rig;
  rig.constant = Rgb(1);
  const PathTracer tracer(*input.scene, rig, job);
  double truth = 0, baked = 0;
  for (const int bounces : {2, 0}) {
    PathOptions path;
    path.bounces = bounces;
    TransferSettings s;
    s.rays = 1024, s.bounces = bounces, s.stopThreshold = 0, s.areaMeans = areaMeans;
    const double sign = bounces > 0 ? 1 : -1;
    for (const Rgb& e : irradianceAtSamples(tracer, *input.samples, {}, 512, path, job).mean)
      truth += sign * e.x;
    for (const Rgb& e : irradiance(input.transfer(s), test::constantLight(Rgb(1)), {})) baked += sign * e.x;
  }
  return baked / truth - 1;
}

/// Inside the triangles of a coarse smooth body the flat faces hide light that its vertices see.
TEST(AreaMeans, TakeTheBiasOutOfBouncesOfCoarseMeshes) {
  const BakeInput input(test::rock(12), Rgb(0.8f));
  const double without = biasOfBounces(input, false), with = biasOfBounces(input, true);
  EXPECT_GT(std::abs(without), 0.02);
  EXPECT_LT(std::abs(with), 0.5 * std::abs(without)) << with << " against " << without;
}

/// With few rays the points' directions must differ: those of one bake are turned copies of eight sets, and
/// in a bowl, where every point sees the same share of the sky, their mean is off by what these sets are off.
TEST(AreaMeans, PointsTogetherSeeWithoutBias) {
  const BakeInput input(test::bowl(24, 48));
  Job job;
  const DirectTransfer direct = input.direct(settings(64));
  const AreaMeans means(*input.scene, *input.rays, *input.samples, direct, 0, job);
  const SampleRows& e = means.direct();
  double mean = 0, area = 0;
  for (std::size_t t = 0; t < e.count(); ++t) {
    const double share = length(DVec3(input.scene->mesh.areaNormal(t)));
    mean += share * e.row(t)[0] * std::sqrt(4 * kPi) / kPi, area += share;
  }
  EXPECT_NEAR(mean / area, 0.5, 0.001);
}

/// Backs of two-sided surfaces have points of their own.
TEST(AreaMeans, BacksHavePointsToo) {
  Material sheet = test::lambert(Rgb(0.8f));
  sheet.twoSided = true;
  const SceneObject object{"sheet",
                           std::make_shared<TriMesh>(test::grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 3, 3)),
                           Mat4(1), sheet};
  const BakeInput input(flattenScene({&object, 1}));
  const SampleSet points = pointsInTriangles(*input.scene, 1);
  ASSERT_EQ(points.size(), 2 * input.scene->mesh.triangleCount());
  EXPECT_GT(points.geometricNormal.front().y, 0.99f);
  EXPECT_LT(points.geometricNormal.back().y, -0.99f);
  Job job;
  const DirectTransfer direct = input.direct(settings(64));
  const AreaMeans means(*input.scene, *input.rays, *input.samples, direct, 0, job);
  SampleRows atPoints(points.size(), 1);
  for (std::size_t p = 0; p < points.size(); ++p)
    atPoints.row(p)[0] = points.geometricNormal[p].y > 0 ? 1.0f : 5.0f;
  const SampleRows corrected = means.corrected(SampleRows(input.samples->size(), 1), atPoints);
  for (std::size_t v = 0; v < input.samples->vertices; ++v) {
    EXPECT_NEAR(corrected.row(v)[0], 1, 1e-6);
    EXPECT_NEAR(corrected.row(input.samples->back[v])[0], 5, 1e-6);
  }
}

}  // namespace
}  // namespace prt
