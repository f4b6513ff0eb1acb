#include "libprt/meso/patch_scene.h"

#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

using namespace test;

/// The plain twin: a scene of many real copies.
class ManyCopies {
 public:
  ManyCopies(const Patch& patch, int copies) : count_(patch.mesh.triangleCount()) {
    Scene scene;
    for (int y = -copies; y <= copies; ++y)
      for (int x = -copies; x <= copies; ++x) {
        const auto first = std::uint32_t(scene.mesh.positions.size());
        for (const Vec3& p : patch.mesh.positions)
          scene.mesh.positions.push_back(p + Vec3(float(x), float(y), 0));
        for (const UVec3& t : patch.mesh.triangles) scene.mesh.triangles.push_back(t + first);
      }
    scene.mesh.normals.assign(scene.mesh.positions.size(), Vec3(0, 0, 1));
    scene.triangleObject.assign(scene.mesh.triangleCount(), 0);
    scene.vertexObject.assign(scene.mesh.vertexCount(), 0);
    scene.materials = {Material{}}, scene.names = {"copies"};
    rays_ = std::make_unique<RayScene>(scene);
  }
  Hit intersect(const Ray& ray) const {
    Hit hit = rays_->intersect(ray);
    if (hit.valid()) hit.triangle %= std::uint32_t(count_);
    return hit;
  }

 private:
  std::size_t count_;
  std::unique_ptr<RayScene> rays_;
};

TEST(PatchScene, RaysMeetWhatManyRealCopiesHave) {
  const Patch patch = heightField(bumps(24, 0.3f), Rgb(0.5f));
  const PatchScene torus = sceneOf(patch);
  const ManyCopies copies(patch, 12);
  int hits = 0, far = 0, different = 0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    Vec3 d = sampleUniformSphere(sobol2(i, 0, 1));
    if (i % 2) d = normalize(d * Vec3(1, 1, 0.05f));  // many near the horizon
    const Ray ray{Vec3(sobol2(i, 2, 1), 0.15f + 0.2f * sobol(i, 4, 1)), 0, d};
    const Hit a = torus.rays->intersect(ray), b = copies.intersect(ray);
    if (std::max(a.t, b.t) > 10) continue;  // where the real copies end
    different += a.triangle != b.triangle;
    if (!a.valid() || a.triangle != b.triangle) continue;
    ++hits, far += b.t > 2;
    EXPECT_NEAR(a.t, b.t, 1e-4 * (1 + b.t));
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(far, 50);
  EXPECT_LE(different, 8);  // edges met exactly
  EXPECT_EQ(torus.rays->refusedRays(), 0u);
}

TEST(PatchScene, AllCallsAgree) {
  const PatchScene torus = sceneOf(heightField(bumps(24, 0.3f), Rgb(0.5f)));
  std::vector<float> x, y, z;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vec3 d = normalize(sampleUniformSphere(sobol2(i, 0, 5)) * Vec3(1, 1, 0.1f));
    x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
  }
  for (const Vec3 origin : {Vec3(0.3f, 0.7f, 0.31f), Vec3(-4.7f, 3.7f, 0.31f)}) {
    std::vector<std::uint8_t> blocked(x.size());
    std::vector<Hit> hits(x.size()), any(x.size());
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < x.size(); ++i) rays.push_back({origin, 0, Vec3(x[i], y[i], z[i])});
    torus.rays->occludedFrom(origin, x, y, z, blocked);
    torus.rays->intersectFrom(origin, x, y, z, hits);
    torus.rays->intersectRays(rays, any);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_EQ(bool(blocked[i]), hits[i].valid());
      EXPECT_EQ(any[i].valid(), hits[i].valid());
      EXPECT_EQ(torus.rays->occluded(rays[i]), hits[i].valid());
      EXPECT_EQ(torus.rays->intersect(rays[i]).valid(), hits[i].valid());
    }
  }
}

TEST(PatchScene, RaysNearTheHorizonEnd) {
  const PatchScene torus = sceneOf(heightField(bumps(24, 0.3f), Rgb(0.5f)));
  const float above = torus.patch->high + 0.01f, tip = torus.patch->high - 1e-4f;
  for (const float slope : {0.0f, 1e-8f, 1e-5f, -1e-8f, 1e-3f, -1e-3f})
    for (const float height : {above, tip}) {
      const Ray ray{Vec3(0.1f, 0.2f, height), 0, normalize(Vec3(0.7f, 0.31f, slope))};
      const Hit hit = torus.rays->intersect(ray);
      if (slope == -1e-3f) {
        EXPECT_TRUE(hit.valid());
      }
      if (slope >= 0 && height == above) {
        EXPECT_FALSE(hit.valid());
      }
    }
  EXPECT_EQ(torus.rays->refusedRays(), 0u);
}

TEST(PatchScene, RefusesWhatIsNotFinite) {
  const PatchScene torus = sceneOf(flatPatch(Rgb(1)));
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<Ray> rays{{Vec3(nan, 0, 1), 0, Vec3(0, 0, -1)},
                              {Vec3(0, 0, inf), 0, Vec3(0, 0, -1)},
                              {Vec3(0.5f, 0.5f, 1), 0, Vec3(0, 0, 0)},
                              {Vec3(0.5f, 0.5f, 1), nan, Vec3(0, 0, -1)},
                              {Vec3(0.5f, 0.5f, 1), 0, Vec3(0, 0, -1)}};
  std::vector<Hit> hits(rays.size());
  torus.rays->intersectRays(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].valid(), i == 4);
  EXPECT_EQ(torus.rays->refusedRays(), 4u);
}

TEST(PatchScene, ViewRaysCrossTheMiddlePlaneWhereTheyShould) {
  const PatchScene torus = sceneOf(heightField(bumps(16, 0.3f), Rgb(1)));
  const Vec3 view = normalize(Vec3(0.8f, -0.3f, 0.25f));
  const Ray ray = viewRay(*torus.patch, {0.3f, 0.6f}, view);
  EXPECT_GT(ray.origin.z, torus.patch->high);
  const Vec3 middle = ray.origin + ray.direction * ((ray.origin.z - torus.patch->middle()) / view.z);
  EXPECT_NEAR(middle.x, 0.3f, 1e-5);
  EXPECT_NEAR(middle.y, 0.6f, 1e-5);
  EXPECT_TRUE(torus.rays->intersect(ray).valid());
}

}  // namespace
}  // namespace prt
