#include "libprt/transport/sample_set.h"

#include "libprt/core/sampling.h"
#include "libprt/transport/ray_scene.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::append;
using test::box;
using test::grid;
using test::rock;
using test::sceneOf;
using test::sphere;

Vec3 randomDirection(std::uint64_t i, std::uint64_t seed) {
  const float z = 2 * hashUniform(seed, i, 0) - 1, phi = 2 * kPiF * hashUniform(seed, i, 1);
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Share of directions above the sample's plane that are blocked.
double blockedShare(const RayScene& rays, const SampleSet& set, std::size_t s, int n = 2000) {
  int blocked = 0;
  for (int i = 0; i < n; ++i) {
    Vec3 d = randomDirection(std::uint64_t(i), s);
    if (dot(d, set.geometricNormal[s]) < 0) d = -d;
    blocked += rays.occluded({set.origin[s], 0, d});
  }
  return double(blocked) / n;
}

TEST(SamplesAtVertices, ConvexBodiesBlockNothing) {
  for (const TriMesh& mesh :
       {sphere(12, 24), box(Vec3(-1), Vec3(1), 3), sphere(40, 80, 1e-3f, Vec3(5, -3, 2))}) {
    const Scene scene = sceneOf(mesh);
    const RayScene rays(scene);
    const SampleSet set = samplesAtVertices(scene);
    ASSERT_EQ(set.size(), scene.mesh.vertexCount());
    for (std::size_t s = 0; s < set.size(); s += 7) EXPECT_EQ(blockedShare(rays, set, s, 500), 0) << s;
  }
}

TEST(SamplesAtVertices, NormalsAndPlacesAreThoseOfTheVertex) {
  const Scene scene = sceneOf(rock(20));
  const SampleSet set = samplesAtVertices(scene);
  for (std::size_t v = 0; v < set.size(); ++v) {
    EXPECT_GT(dot(set.geometricNormal[v], scene.mesh.normals[v]), 0.999f);
    EXPECT_EQ(set.shadingNormal[v], scene.mesh.normals[v]);
    const UVec3& t = scene.mesh.triangles[set.triangle[v]];
    const Vec2 b = set.barycentric[v];
    EXPECT_EQ(b.x == 1 ? t.y : b.y == 1 ? t.z : t.x, v);
    EXPECT_LT(length(set.origin[v] - scene.mesh.positions[v]), 1e-3f);
  }
}

TEST(SamplesAtVertices, CreasesKeepTheirFlatSides) {
  const Scene scene = sceneOf(box(Vec3(-1), Vec3(1), 2));
  const SampleSet set = samplesAtVertices(scene);
  for (std::size_t v = 0; v < set.size(); ++v)
    EXPECT_GT(dot(set.geometricNormal[v], scene.mesh.normals[v]), 0.999999f);
}

TEST(SamplesAtVertices, TextureSeamsMakeNoDifference) {
  TriMesh seamed = rock(20);
  for (UVec3& t : seamed.triangles)  // every corner gets a vertex of its own
    for (int k = 0; k < 3; ++k) {
      seamed.positions.push_back(seamed.positions[t[k]]);
      seamed.normals.push_back(seamed.normals[t[k]]);
      t[k] = std::uint32_t(seamed.positions.size() - 1);
    }
  const Scene scene = sceneOf(rock(20)), split = sceneOf(seamed);
  const SampleSet one = samplesAtVertices(scene), many = samplesAtVertices(split);
  for (std::size_t t = 0; t < scene.mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = scene.mesh.triangles[t][k], b = split.mesh.triangles[t][k];
      EXPECT_LT(length(one.origin[a] - many.origin[b]), 1e-6f);
      EXPECT_LT(length(one.geometricNormal[a] - many.geometricNormal[b]), 1e-6f);
    }
}

/// Floor and wall with an edge in common, as separate vertices: the floor's vertices there see the wall
/// over exactly half of their hemisphere, at any opening angle the angle's share.
TEST(SamplesAtVertices, VerticesInACornerSeeTheOtherSide) {
  for (const double degreesOpen : {20.0, 90.0, 150.0}) {
    const double a = radians(degreesOpen);
    TriMesh mesh = grid({0, 0, 0}, {0, 0, 100}, {100, 0, 0}, 4, 4);
    append(mesh, grid({0, 0, 0}, Vec3(std::cos(a), std::sin(a), 0) * 100.0f, {0, 0, 100}, 4, 4));
    const Scene scene = sceneOf(mesh);
    const RayScene rays(scene);
    const SampleSet set = samplesAtVertices(scene);
    ASSERT_EQ(scene.mesh.positions[2], Vec3(0, 0, 50));
    EXPECT_NEAR(blockedShare(rays, set, 2, 20000), 1 - degreesOpen / 180, 0.012);
  }
}

TEST(SamplesAtVertices, SharpValleysAreLeftOnTheirOuterSide) {
  for (const double halfOpening : {0.5, 2.0, 10.0}) {  // degrees
    const float s = float(std::sin(radians(halfOpening))), c = float(std::cos(radians(halfOpening)));
    TriMesh mesh = grid({0, 0, -64}, {0, 0, 128}, Vec3(s, c, 0) * 10.0f, 16, 4);  // faces -x
    append(mesh, grid({0, 0, -64}, Vec3(-s, c, 0) * 10.0f, {0, 0, 128}, 4, 16));  // faces +x
    const Scene scene = sceneOf(mesh);
    const RayScene rays(scene);
    const SampleSet set = samplesAtVertices(scene);
    for (std::size_t v = 3; v < 14; ++v) {
      ASSERT_EQ(scene.mesh.positions[v].y, 0);
      const Hit left = rays.intersect({set.origin[v], 0, {-1, 0, 0}}),
                right = rays.intersect({set.origin[v], 0, {1, 0, 0}});
      ASSERT_TRUE(left.valid() && right.valid());
      EXPECT_GT(scene.mesh.areaNormal(left.triangle).x, 0);  // the fronts of both sides
      EXPECT_LT(scene.mesh.areaNormal(right.triangle).x, 0);
    }
  }
}

/// A box standing exactly on the ground: the lower edge of its sides sees ground below and sky above.
TEST(SamplesAtVertices, EdgesThatLieOnAnotherSurfaceSeeItsFront) {
  TriMesh mesh = box({-1, 0, -1}, {1, 2, 1}, 4);
  append(mesh, grid({-100, 0, 100}, {200, 0, 0}, {0, 0, -200}, 7, 7));
  const Scene scene = sceneOf(mesh);
  const RayScene rays(scene);
  const SampleSet set = samplesAtVertices(scene);
  int tested = 0;
  for (std::size_t v = 0; v < set.size(); ++v) {
    const Vec3 p = scene.mesh.positions[v], n = set.geometricNormal[v];
    if (p.y != 0 || n.y != 0) continue;
    EXPECT_NEAR(blockedShare(rays, set, v, 4000), 0.5, 0.035);
    ++tested;
  }
  EXPECT_EQ(tested, 20);
}

TEST(SamplesAtVertices, TwoSidedObjectsGetSamplesOnTheirBacks) {
  Material leaf;
  leaf.twoSided = true;
  const std::vector<SceneObject> objects{
      {"body", std::make_shared<TriMesh>(sphere(6, 12)), Mat4(1), Material{}},
      {"leaf", std::make_shared<TriMesh>(grid({-1, 2, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1)), Mat4(1), leaf}};
  const Scene scene = flattenScene(objects);
  const SampleSet set = samplesAtVertices(scene);
  const std::size_t vertices = scene.mesh.vertexCount();
  ASSERT_EQ(set.size(), vertices + 4);
  ASSERT_EQ(set.back.size(), vertices);
  EXPECT_EQ(set.back[0], kNone);
  for (std::size_t v = vertices - 4; v < vertices; ++v) {
    const std::size_t back = set.back[v];
    EXPECT_EQ(set.geometricNormal[back], Vec3(0, -1, 0));
    EXPECT_EQ(set.shadingNormal[back], Vec3(0, -1, 0));
    EXPECT_LT(set.origin[back].y, 2);
    EXPECT_GT(set.origin[v].y, 2);
    EXPECT_EQ(set.triangle[back], set.triangle[v]);
  }
}

TEST(SamplesAtVertices, AVertexWithoutFacesStandsFree) {
  TriMesh mesh = sphere(6, 12);
  mesh.positions.push_back({0, 3, 0});
  mesh.normals.push_back({1, 0, 0});
  const SampleSet set = samplesAtVertices(sceneOf(mesh));
  EXPECT_EQ(set.triangle.back(), kNone);
  EXPECT_EQ(set.geometricNormal.back(), Vec3(1, 0, 0));
}

TEST(SamplesOnSurface, DensityFollowsAreaAndPointsLieOnTheSurface) {
  TriMesh mesh = grid(Vec3(0), {1, 0, 0}, {0, 1, 0}, 1, 1);
  append(mesh, grid({5, 0, 0}, {3, 0, 0}, {0, 1, 0}, 1, 1));
  const Scene scene = sceneOf(mesh);
  const SampleSet set = samplesOnSurface(scene, 4000, 9);
  std::size_t right = 0;
  Vec3 mean(0);
  for (std::size_t i = 0; i < set.size(); ++i) {
    right += set.origin[i].x > 4;
    if (set.origin[i].x > 4) mean += set.origin[i];
    const UVec3& t = scene.mesh.triangles[set.triangle[i]];
    const Vec2 b = set.barycentric[i];
    EXPECT_GE(std::min({b.x, b.y, 1 - b.x - b.y}), -1e-6f);
    const Vec3 p = (1 - b.x - b.y) * scene.mesh.positions[t.x] + b.x * scene.mesh.positions[t.y] +
                   b.y * scene.mesh.positions[t.z];
    EXPECT_LT(length(p - set.origin[i]), 2e-5f * scene.mesh.bounds().diagonal());
    EXPECT_GT(set.origin[i].z, 0);
  }
  EXPECT_EQ(right, 3000u);  // strata: exactly the area's share
  EXPECT_LT(length(mean / 3000.0f - Vec3(6.5f, 0.5f, 0)), 0.03f);
}

TEST(SamplesOnSurface, SeedDecidesThePoints) {
  const Scene scene = sceneOf(rock(20));
  EXPECT_EQ(samplesOnSurface(scene, 50, 1).origin, samplesOnSurface(scene, 50, 1).origin);
  EXPECT_NE(samplesOnSurface(scene, 50, 1).origin, samplesOnSurface(scene, 50, 2).origin);
}

}  // namespace
}  // namespace prt
