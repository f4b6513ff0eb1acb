// Transfer at the texels of an atlas instead of at vertices.

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/transport/interpolation_floor.h"
#include "tests/support/atlases.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using test::BakeInput;

/// The same scene with samples at the texels of its charts, cut by itself.
BakeInput atTexels(const Scene& scene, int size) {
  BakeInput input(scene);
  input.samples = test::texelSamples(*input.scene, size);
  return input;
}

TransferSettings settings(int rays, int bounces, TransferForm form = TransferForm::Diffuse) {
  TransferSettings s;
  s.rays = rays, s.bounces = bounces, s.form = form;
  return s;
}

InterpolationFloor floorOf(const BakeInput& input, const TransferSettings& s, std::size_t points) {
  Job job;
  FloorOptions options;
  options.points = points;
  return measureInterpolationFloor(input.scene, input.rays, *input.samples, input.transfer(s), s, {}, job,
                                   options);
}

// Nothing blocks anything: not the other faces of a box either, on whose edges texels lie.
TEST(SamplesAtTexels, ConvexBodiesBlockNothing) {
  const BakeInput input = atTexels(test::sceneOf(test::box(Vec3(-1), Vec3(1), 2)), 48);
  const std::vector<Rgb> irradiance =
      prt::irradiance(input.transfer(settings(256, 0)), test::constantLight(Rgb(1)), {});
  ASSERT_GT(irradiance.size(), 500u);
  for (const Rgb& e : irradiance) EXPECT_NEAR(e.x, kPi, 2e-3);
}

TEST(SamplesAtTexels, LieOnTheSurfaceUnderItsNormals) {
  const BakeInput input = atTexels(test::sceneOf(test::rock(16)), 40);
  const SampleSet& set = *input.samples;
  EXPECT_TRUE(set.coversSurface());
  EXPECT_EQ(set.around(), 4);
  EXPECT_EQ(set.fronts(), set.size());
  const TriMesh& mesh = input.scene->mesh;
  for (std::size_t s = 0; s < set.size(); ++s) {
    const UVec3& t = mesh.triangles[set.triangle[s]];
    const Vec2 b = set.barycentric[s];
    const Vec3 at =
        (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
    EXPECT_LT(length(set.origin[s] - at), 1e-4f);
    EXPECT_GT(dot(set.geometricNormal[s], normalize(mesh.areaNormal(set.triangle[s]))), 0.9999f);
    EXPECT_NEAR(length(set.shadingNormal[s]), 1, 1e-5f);
  }
}

// In the line where a wall meets the floor texels of both see the other's front: half of what the floor
// receives is blocked, however near.
TEST(SamplesAtTexels, TexelsInACreaseSeeTheOtherSide) {
  TriMesh mesh = test::grid(Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0), 4, 4);
  const TriMesh wall = test::grid(Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1), 4, 4);
  test::append(mesh, wall);
  const BakeInput input = atTexels(test::sceneOf(std::move(mesh)), 64);
  const std::vector<Rgb> e =
      prt::irradiance(input.transfer(settings(1024, 0)), test::constantLight(Rgb(1)), {});
  int near = 0;
  for (std::size_t s = 0; s < input.samples->size(); ++s) {
    const Vec3& at = input.samples->origin[s];
    const bool middle = at.z > 0.3f && at.z < 0.7f;
    if (!middle || std::min(at.x, at.y) > 0.01f || std::max(at.x, at.y) > 0.03f) continue;
    ++near;
    EXPECT_NEAR(e[s].x / kPi, 0.5, 0.05);
  }
  EXPECT_GT(near, 4);
}

// What pictures interpolate is as exact as the texels are small, with bounces too; few vertices are not.
TEST(SamplesAtTexels, FinerTexelsHaveALowerFloorThanACoarseMesh) {
  const Scene scene = test::sceneOf(test::rock(16), test::lambert(Rgb(0.6f)));
  const TransferSettings s = settings(256, 2);
  const InterpolationFloor vertices = floorOf(BakeInput(scene), s, 1200),
                           coarse = floorOf(atTexels(scene, 48), s, 1200),
                           fine = floorOf(atTexels(scene, 192), s, 1200);
  EXPECT_GT(vertices.interpolation, 0.03);
  EXPECT_LT(coarse.interpolation, 0.6 * vertices.interpolation);
  EXPECT_LT(fine.interpolation, 0.5 * coarse.interpolation);
  EXPECT_LT(fine.product, 0.4 * vertices.product);
}

// What points all over the surface gather from texels, they gather from vertices too, whose values were set
// right in the mean over their neighbourhoods.
TEST(SamplesAtTexels, BouncesAreThoseOfVertices) {
  const Scene scene = test::sceneOf(test::rock(40), test::lambert(Rgb(0.7f)));
  const TransferSettings s = settings(512, 2);
  const SampleSet points = samplesOnSurface(scene, 2000, 5);
  const auto gathered = [&](const BakeInput& input) {
    Job job;
    BakeInput free = input;
    free.samples = std::make_shared<SampleSet>(points);
    const Transfer surface = input.transfer(s);
    EXPECT_EQ(surface.bounces, 2);
    const DirectTransfer direct = free.direct(directSettings(s, TransferForm::Diffuse));
    const auto e =
        prt::irradiance(finishTransfer(*input.scene, *input.rays, points, direct, s, TransferForm::Diffuse,
                                       job, &surface, nullptr, input.samples.get()),
                        test::constantLight(Rgb(1)), {});
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      sum += e[i].x - std::sqrt(4 * kPi) * test::rowOf(direct.diffuse, i)[0];
    return sum / double(points.size());
  };
  const double vertices = gathered(BakeInput(scene)), texels = gathered(atTexels(scene, 128));
  EXPECT_GT(vertices, 0.05);
  EXPECT_NEAR(texels, vertices, 0.03 * vertices);
}

TEST(SamplesAtTexels, TwoSidedObjectsGetSamplesOnTheirBacks) {
  Material both = test::lambert(Rgb(0.5f));
  both.twoSided = true;
  const BakeInput input =
      atTexels(test::sceneOf(test::grid(Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0), 3, 3), both), 24);
  const SampleSet& set = *input.samples;
  ASSERT_EQ(set.size(), 2 * set.fronts());
  ASSERT_EQ(set.back.size(), set.fronts());
  for (std::size_t s = 0; s < set.fronts(); ++s)
    EXPECT_EQ(set.geometricNormal[set.back[s]], -set.geometricNormal[s]);
  SamplePlace front, back;
  ASSERT_TRUE(set.at(input.scene->mesh, 2, Vec2(0.2f, 0.3f), false, front));
  ASSERT_TRUE(set.at(input.scene->mesh, 2, Vec2(0.2f, 0.3f), true, back));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(back.sample[k], set.back[front.sample[k]]);
  const Transfer transfer = input.transfer(settings(64, 1));
  EXPECT_EQ(transfer.samples, set.size());
}

// A ball sunk into the ground: what lies below is dark, and takes the values of its neighbours.
TEST(SamplesAtTexels, BuriedTexelsTakeTheirNeighboursValues) {
  const auto shared = [](TriMesh mesh) { return std::make_shared<const TriMesh>(std::move(mesh)); };
  const Material grey = test::lambert(Rgb(0.5f));
  const SceneObject objects[] = {
      {"block", shared(test::box(Vec3(-2, -1, -2), Vec3(2, 0, 2), 2)), Mat4(1), grey},
      {"ball", shared(test::sphere(10, 20, 0.6f)), Mat4(1), grey}};
  const BakeInput input = atTexels(flattenScene(objects), 96);
  const DirectTransfer direct = input.direct(directSettings(settings(256, 0), TransferForm::Diffuse));
  const auto buried = direct.buried.as<std::uint8_t>();
  int below = 0;
  for (std::size_t s = 0; s < input.samples->size(); ++s) {
    const bool ball = input.scene->triangleObject[input.samples->triangle[s]] == 1;
    if (!ball || input.samples->origin[s].y > -0.05f) continue;
    ++below;
    EXPECT_TRUE(buried[s]);
    EXPECT_GT(test::rowOf(direct.diffuse, s)[0], 0.05f);
  }
  EXPECT_GT(below, 20);
}

TEST(SamplesAtTexels, VisibilityAndMatricesAgree) {
  const BakeInput input = atTexels(test::sceneOf(test::rock(12), test::lambert(Rgb(0.5f))), 32);
  const ShRgb light = test::lobeLight({0.2f, 1, 0.4f});
  const Transfer visibility = input.transfer(settings(256, 0, TransferForm::Visibility));
  TransferSettings whole = settings(256, 0, TransferForm::Matrix);
  whole.storage = DType::f32;
  const std::vector<Rgb> a = transferredRadiance(visibility, light),
                         b = transferredRadiance(input.transfer(whole), light);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].x, b[i].x, 1e-4);
}

TEST(SamplesAtTexels, RefusesTheAtlasOfAnotherMesh) {
  Job job;
  Atlas atlas;
  atlas.uv = {{0, 0}, {1, 0}, {0, 1}};
  atlas.uvTriangles = {{0, 1, 2}};
  atlas.chartOf = {0};
  atlas.chartCount = 1;
  EXPECT_THROW(samplesAtTexels(test::sceneOf(test::rock(8)), makeChartTexels(atlas, 16, job), job),
               ValueError);
}

}  // namespace
}  // namespace prt
