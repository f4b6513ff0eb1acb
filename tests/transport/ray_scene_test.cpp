#include "libprt/transport/ray_scene.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <array>

namespace prt {
namespace {

using test::grid;
using test::rock;
using test::sceneOf;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Vec3 randomDirection(std::uint64_t i, std::uint64_t seed) {
  const float z = 2 * hashUniform(seed, i, 0) - 1, phi = 2 * kPiF * hashUniform(seed, i, 1);
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Directions as separate coordinates.
struct Directions {
  std::vector<float> x, y, z;
  explicit Directions(std::size_t n, std::uint64_t seed = 1) {
    for (std::size_t i = 0; i < n; ++i) add(randomDirection(i, seed));
  }
  void add(const Vec3& d) { x.push_back(d.x), y.push_back(d.y), z.push_back(d.z); }
  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Nearest hit by testing every triangle in double (Moeller and Trumbore 1997).
Hit slowHit(const TriMesh& mesh, const Vec3& origin, const Vec3& direction) {
  Hit best;
  double nearest = std::numeric_limits<double>::infinity();
  const DVec3 o(origin), d(direction);
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const UVec3& c = mesh.triangles[t];
    const DVec3 a(mesh.positions[c.x]), e1 = DVec3(mesh.positions[c.y]) - a,
                                        e2 = DVec3(mesh.positions[c.z]) - a;
    const DVec3 p = cross(d, e2);
    const double det = dot(e1, p);
    if (det == 0) continue;
    const DVec3 s = o - a, q = cross(s, e1);
    const double u = dot(s, p) / det, v = dot(d, q) / det, at = dot(e2, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || at <= 0 || at >= nearest) continue;
    nearest = at;
    best = {t, float(at), {float(u), float(v)}};
  }
  return best;
}

TEST(RayScene, FindsWhatASlowSearchFinds) {
  const Scene scene = sceneOf(rock(16));
  const RayScene rays(scene);
  for (std::size_t i = 0; i < 2000; ++i) {
    const Vec3 origin = 1.6f * randomDirection(i, 7), d = randomDirection(i, 8);
    const Hit fast = rays.intersect({origin, 0, d}), slow = slowHit(scene.mesh, origin, d);
    ASSERT_EQ(fast.valid(), slow.valid()) << i;
    EXPECT_EQ(rays.occluded({origin, 0, d}), slow.valid()) << i;
    if (!slow.valid()) continue;
    EXPECT_NEAR(fast.t, slow.t, 1e-5f);
    ASSERT_EQ(fast.triangle, slow.triangle) << i;
    EXPECT_LT(length(fast.barycentric - slow.barycentric), 1e-3f);
  }
}

TEST(RayScene, PacketsAgreeWithEachOtherToTheBit) {
  const Scene scene = sceneOf(rock(60));
  const RayScene rays(scene);
  for (std::uint64_t s = 0; s < 200; ++s) {
    const Vec3 origin = 1.2f * randomDirection(s, 3);
    const Directions d(1000 + s, s);
    std::vector<std::uint8_t> blocked(d.x.size());
    std::vector<Hit> hits(d.x.size());
    rays.occludedFrom(origin, d.x, d.y, d.z, blocked);
    rays.intersectFrom(origin, d.x, d.y, d.z, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(blocked[i] != 0, hits[i].valid());
  }
}

TEST(RayScene, ARayDoesNotDependOnItsNeighboursInThePacket) {
  const Scene scene = sceneOf(rock(60));
  const RayScene rays(scene);
  const Vec3 origin(0, 1.3f, 0);
  const Directions d(4096);
  std::vector<Hit> together(4096), apart(4096);
  rays.intersectFrom(origin, d.x, d.y, d.z, together);
  for (std::size_t i = 0; i < 4096; i += 5) {
    const std::size_t n = std::min<std::size_t>(5, 4096 - i);
    rays.intersectFrom(origin, std::span(d.x).subspan(i, n), std::span(d.y).subspan(i, n),
                       std::span(d.z).subspan(i, n), std::span(apart).subspan(i, n));
  }
  for (std::size_t i = 0; i < 4096; ++i) {
    EXPECT_EQ(together[i].triangle, apart[i].triangle);
    EXPECT_EQ(together[i].barycentric, apart[i].barycentric);
  }
}

/// Rays at vertices and at middles of edges meet several triangles at once: the choice must be the same in
/// every build, or interpolated values, and with them the bits of a bake, would change from run to run.
TEST(RayScene, EveryBuildChoosesTheSameTriangles) {
  const Scene scene = sceneOf(rock(120));
  std::vector<std::uint32_t> first;
  for (int build = 0; build < 6; ++build) {
    setThreadCount(build % 2 ? 1 : 5);
    const RayScene rays(scene);
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); t += 3) {
      const UVec3& c = scene.mesh.triangles[t];
      const Vec3 n = scene.mesh.normals[c.x];
      for (const Vec3& p :
           {scene.mesh.positions[c.x], 0.5f * (scene.mesh.positions[c.x] + scene.mesh.positions[c.y])})
        chosen.push_back(rays.intersect({p + 0.3f * n, 0, -n}).triangle);
    }
    if (build == 0) first = chosen;
    EXPECT_EQ(chosen, first);
  }
  setThreadCount(0);
}

TEST(RayScene, RefusesAndCountsRaysThatEmbreeWouldDieOf) {
  const Scene scene = sceneOf(grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1));
  const RayScene rays(scene);
  const Vec3 above(0, 1, 0), down(0, -1, 0);
  const std::array<Ray, 9> bad{{{{kNaN, 1, 0}, 0, down},
                                {{0, kInf, 0}, 0, down},
                                {above, 0, {0, kNaN, 0}},
                                {above, 0, {0, -kInf, 0}},
                                {above, kNaN, down},
                                {above, -1, down},
                                {above, 0, Vec3(0)},
                                {above, 0, down, kNaN},
                                {{1e30f, 0, 0}, 0, down}}};
  for (const Ray& ray : bad) {
    EXPECT_FALSE(rays.occluded(ray));
    EXPECT_FALSE(rays.intersect(ray).valid());
  }
  EXPECT_EQ(rays.refusedRays(), 18u);

  Directions d(0);
  for (const Vec3& v : {down, Vec3(kNaN, 0, 0), down, Vec3(0), Vec3(0, 0, kInf)}) d.add(v);
  std::vector<std::uint8_t> blocked(5);
  std::vector<Hit> hits(5);
  rays.occludedFrom(above, d.x, d.y, d.z, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 0, 1, 0, 0}));
  rays.intersectFrom({0, kNaN, 0}, d.x, d.y, d.z, hits);
  EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](const Hit& h) { return h.valid(); }), 0);
  EXPECT_EQ(rays.refusedRays(), 18u + 3u + 5u);
}

TEST(RayScene, RangeOfARayIsKept) {
  const Scene scene = sceneOf(grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1));
  const RayScene rays(scene);
  const Vec3 above(0, 1, 0), down(0, -1, 0);
  EXPECT_TRUE(rays.occluded({above, 0, down, 1.5f}));
  EXPECT_FALSE(rays.occluded({above, 0, down, 0.5f}));
  EXPECT_FALSE(rays.occluded({above, 1.5f, down}));
  EXPECT_FALSE(rays.occluded({above, 0, down, -1}));
  EXPECT_FALSE(rays.intersect({above, 2, down, 1}).valid());
  EXPECT_EQ(rays.refusedRays(), 0u);
  EXPECT_FLOAT_EQ(rays.intersect({above, 0, down}).t, 1);
}

TEST(RayScene, SizesMustAgree) {
  const Scene scene = sceneOf(rock(8));
  const RayScene rays(scene);
  const Directions d(4);
  std::vector<std::uint8_t> blocked(3);
  EXPECT_THROW(rays.occludedFrom(Vec3(0), d.x, d.y, d.z, blocked), ValueError);
}

TEST(RayScene, RefusesPositionsThatAreNotFinite) {
  Scene scene = sceneOf(rock(8));
  scene.mesh.positions[3].y = kNaN;
  EXPECT_THROW(RayScene{scene}, GeometryError);
}

TEST(RayScene, CancelledJobStopsTheBuild) {
  const Scene scene = sceneOf(rock(300));
  Job job;
  job.cancel();
  EXPECT_THROW(RayScene(scene, job), Cancelled);
}

/// Rays that leave a surface on its outer side must not meet it, at any scale and any place.
TEST(RayScene, OffsetOriginsLeaveTheirSurface) {
  for (const float scale : {1e-4f, 1.0f, 1e4f})
    for (const float away : {0.0f, 3.0f, 1000.0f}) {
      const Vec3 centre = scale * away * Vec3(1, -0.7f, 0.3f);
      const Scene scene = sceneOf(test::sphere(24, 48, scale, centre));
      const RayScene rays(scene);
      int wrong = 0;
      for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); ++t) {
        const UVec3& c = scene.mesh.triangles[t];
        const Vec3 p =
            (scene.mesh.positions[c.x] + scene.mesh.positions[c.y] + scene.mesh.positions[c.z]) / 3.0f;
        const Vec3 n = normalize(scene.mesh.areaNormal(t));
        const Vec3 origin = offsetOrigin(p, n, rays.size());
        EXPECT_LT(length(origin - p), 6e-5f * (scale + length(p)));
        for (std::uint64_t i = 0; i < 32; ++i) {
          Vec3 d = randomDirection(i, t);
          if (dot(d, n) < 0) d = -d;
          if (dot(d, n) > 1e-3f) wrong += rays.occluded({origin, 0, d});
        }
      }
      EXPECT_EQ(wrong, 0) << scale << " " << away;
    }
}

TEST(RayScene, TightOffsetsLeaveTheirSurfaceAndStayClose) {
  for (const float scale : {1e-4f, 0.15f, 1.0f, 1e4f})
    for (const float away : {0.0f, 3.0f, 1000.0f}) {
      const Vec3 centre = scale * away * Vec3(1, -0.7f, 0.3f);
      const Scene scene = sceneOf(test::sphere(24, 48, scale, centre));
      const RayScene rays(scene);
      int wrong = 0;
      for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); ++t) {
        const UVec3& c = scene.mesh.triangles[t];
        const Vec3 corner[3] = {scene.mesh.positions[c.x], scene.mesh.positions[c.y],
                                scene.mesh.positions[c.z]};
        const Vec3 n = normalize(scene.mesh.areaNormal(t));
        for (std::uint64_t i = 0; i < 32; ++i) {
          Vec2 b(hashUniform(7, i, 0), hashUniform(7, i, 1));
          if (b.x + b.y > 1) b = Vec2(1) - b;
          const Vec3 p = (1 - b.x - b.y) * corner[0] + b.x * corner[1] + b.y * corner[2];
          const Vec3 origin = offsetOrigin(corner[0], corner[1], corner[2], b, n);
          EXPECT_LT(length(origin - p), 3e-6f * (scale + length(p)));
          Vec3 d = randomDirection(i, t);
          if (dot(d, n) < 0) d = -d;
          if (dot(d, n) > 1e-3f) wrong += rays.occluded({origin, 0, d});
        }
      }
      EXPECT_EQ(wrong, 0) << scale << " " << away;
    }
}

}  // namespace
}  // namespace prt
