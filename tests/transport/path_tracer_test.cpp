#include "libprt/transport/path_tracer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/material/bsdf.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::append;
using test::grid;
using test::lambert;
using test::rock;
using test::sceneOf;
using test::sphere;

LightRig whiteSky() {
  LightRig rig;
  rig.constant = Rgb(1);
  return rig;
}

LightRig disc(float halfAngle, const Vec3& direction = {0, 1, 0}) {
  LightRig rig;
  rig.circles.push_back({normalize(direction), halfAngle, Rgb(1)});
  return rig;
}

Material phong(const Rgb& albedo, const Rgb& specular, float exponent) {
  Material material = lambert(albedo);
  material.model = MaterialModel::Phong;
  material.specular = specular;
  material.exponent = exponent;
  return material;
}

/// Every face on its own with its own normal: shading and geometry agree, and no energy is lost between them.
TriMesh flat(const TriMesh& mesh) {
  TriMesh out;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto first = std::uint32_t(out.vertexCount());
    for (int k = 0; k < 3; ++k) {
      out.positions.push_back(mesh.positions[mesh.triangles[t][k]]);
      out.normals.push_back(normalize(mesh.areaNormal(t)));
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

/// A mean of many paths and its standard error, which well-spread paths stay below.
struct Estimate {
  double mean = 0, error = 0;
};

/// The estimate must be sharp, and hold the truth: within the standard error (well-spread paths err by
/// less than half of it) and `bias` of a tessellated scene whose closed form is for a smooth one; both
/// relative.
void expectEstimate(const Estimate& e, double truth, double sharpness, double bias,
                    const std::string& what = {}) {
  EXPECT_LT(e.error, sharpness * truth) << what;
  EXPECT_NEAR(e.mean, truth, e.error + bias * truth) << what;
}

/// Irradiance / pi at some points of a scene.
std::vector<Estimate> measure(const Scene& scene, const LightRig& rig, const SampleSet& samples,
                              const std::vector<std::uint32_t>& indices, int paths, int bounces) {
  Job job;
  const PathTracer tracer(scene, rig, job);
  PathOptions options;
  options.bounces = bounces;
  const SampleIrradiance e = irradianceAtSamples(tracer, samples, indices, paths, options, job);
  std::vector<Estimate> m;
  for (std::size_t i = 0; i < e.mean.size(); ++i)
    m.push_back({e.mean[i].x / kPi, e.standardError[i].x / kPi});
  return m;
}

/// Red radiance along one ray.
Estimate radianceAlong(const Scene& scene, const LightRig& rig, const Vec3& eye, const Vec3& towards,
                       int paths, int bounces, bool diffuseBounces = false) {
  Job job;
  const PathTracer tracer(scene, rig, job);
  PathOptions options;
  options.bounces = bounces, options.diffuseBounces = diffuseBounces;
  double sum = 0, squares = 0;
  for (int i = 0; i < paths; ++i) {
    SobolStream stream(1, std::uint32_t(i));
    const PathSample path = tracer.trace({eye, 0, normalize(towards - eye)}, options, stream);
    EXPECT_TRUE(path.hit);
    sum += path.radiance.x, squares += double(path.radiance.x) * path.radiance.x;
  }
  const double mean = sum / paths;
  return {mean, std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths)};
}

TEST(PathTracer, ConvexBodyUnderWhiteSkySeesAllOfIt) {
  const Scene scene = sceneOf(sphere(24, 48), lambert(Rgb(1)));
  const SampleSet samples = samplesAtVertices(scene);
  for (const Estimate& e : measure(scene, whiteSky(), samples, {0, 100, 500, 1000}, 4096, 3))
    expectEstimate(e, 1, 5e-3, 0);
}

TEST(PathTracer, DiscOverheadGivesSineSquared) {
  const Scene plane = sceneOf(grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2, 2));
  const SampleSet samples = samplesAtVertices(plane);
  for (const double angle : {0.005, 0.1, 0.7, 1.5}) {  // the smallest is the sun's
    const Estimate e = measure(plane, disc(float(angle)), samples, {4}, 16384, 0)[0];
    expectEstimate(e, std::pow(std::sin(angle), 2), 3e-3, 2e-4, std::to_string(angle));
  }
}

TEST(PathTracer, DirectionalLightFollowsTheCosineAndIsShadowed) {
  TriMesh mesh = grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2, 2);
  LightRig rig;
  rig.directionals.push_back({normalize(Vec3(1, 1, 0)), Rgb(2, 1, 0.5f)});
  Job job;
  const Scene open = sceneOf(mesh);
  const PathTracer lit(open, rig, job);
  const SampleIrradiance e =
      irradianceAtSamples(lit, samplesAtVertices(open), std::vector<std::uint32_t>{4}, 1, {}, job);
  EXPECT_NEAR(e.mean[0].x, 2 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(e.mean[0].z, 0.5 * std::sqrt(0.5), 1e-5);

  append(mesh, grid({0.5f, 0, 1}, {0, 0, -2}, {0, 2, 0}, 1, 1));  // a wall between point and light
  const Scene walled = sceneOf(mesh);
  const PathTracer shaded(walled, rig, job);
  EXPECT_EQ(irradianceAtSamples(shaded, samplesAtVertices(walled), std::vector<std::uint32_t>{4}, 1, {}, job)
                .mean[0],
            Rgb(0));
}

/// Every inner point of a spherical bowl whose missing cap is an area fraction f has sky-visible cosine
/// fraction f: bounce k adds f (albedo (1-f))^k. Half bowl, white: 1/2, 3/4, 7/8, 15/16.
TEST(PathTracer, BowlFillsByHalves) {
  const Scene bowl = sceneOf(sphere(96, 192, 1, Vec3(0), 0, true), lambert(Rgb(1)));
  const SampleSet samples = samplesAtVertices(bowl);
  const std::vector<std::uint32_t> inside{20 * 192 + 7, 50 * 192 + 90, 80 * 192 + 150, 96 * 192};
  for (int bounces = 0; bounces <= 3; ++bounces) {
    for (const Estimate& e : measure(bowl, whiteSky(), samples, inside, 32768, bounces))
      expectEstimate(e, 1 - std::pow(0.5, bounces + 1), 6e-3, 1e-3, std::to_string(bounces));
  }
}

TEST(PathTracer, BowlBouncesUnevenLightEvenly) {
  // E_indirect = albedo (1-f) mean(E_direct) for one bounce, the same everywhere. Light: a disc.
  const Scene bowl = sceneOf(sphere(96, 192, 1, Vec3(0), 0, true), lambert(Rgb(0.8f)));
  const SampleSet samples = samplesAtVertices(bowl);
  const LightRig light = disc(0.3f, {0.4f, 1, 0.2f});
  const std::vector<std::uint32_t> inside{20 * 192 + 7, 50 * 192 + 90, 80 * 192 + 150};
  const std::vector<Estimate> direct = measure(bowl, light, samples, inside, 32768, 0);
  const std::vector<Estimate> bounced = measure(bowl, light, samples, inside, 65536, 1);
  // All of the disc's flux through the opening lands on the bowl: mean E = flux / (2 pi).
  const double flux = kPi * kPi * std::pow(std::sin(0.3), 2) * normalize(Vec3(0.4f, 1, 0.2f)).y;
  const double expected = 0.8 * 0.5 * flux / (2 * kPi) / kPi;
  for (std::size_t i = 0; i < inside.size(); ++i)
    expectEstimate({bounced[i].mean - direct[i].mean, bounced[i].error + direct[i].error}, expected, 0.012,
                   1e-3);
}

/// Infinite dihedral of opening a under a white sky: cosine fraction f = (1 - cos a)/2 on both walls and
/// constant radiosity; a right corner of albedo p shines with p/(2-p).
TEST(PathTracer, RightCornerOfTwoWalls) {
  const float far = 4e5f;  // a wall that ends leaks in proportion to 1 / far
  TriMesh mesh = grid({-far, 0, far}, {2 * far, 0, 0}, {0, 0, -far}, 1, 1);  // floor: z from far to 0
  append(mesh, grid({-far, 0, 0}, {2 * far, 0, 0}, {0, far, 0}, 1, 1));      // wall: z = 0, facing +z
  const float albedo = 0.7f;
  const Scene corner = sceneOf(mesh, lambert(Rgb(albedo)));
  const Vec3 eye(0, 2, 3), onFloor(0, 0, 2), onWall(0, 1, 0);
  expectEstimate(radianceAlong(corner, whiteSky(), eye, onFloor, 65536, 0), albedo * 0.5, 4e-3, 0);
  expectEstimate(radianceAlong(corner, whiteSky(), eye, onFloor, 65536, 24), albedo / (2 - albedo), 2e-3, 0);
  expectEstimate(radianceAlong(corner, whiteSky(), eye, onWall, 65536, 24), albedo / (2 - albedo), 2e-3, 0);
}

TEST(PathTracer, FurnaceRisesToOneAndNeverAbove) {
  const Scene scene = sceneOf(flat(rock(40)), lambert(Rgb(1)));
  const Vec3 eye(0, 1.5f, 4);
  double last = 0;
  for (const int bounces : {0, 1, 3, 8, 30}) {
    const Estimate l = radianceAlong(scene, whiteSky(), eye, {0.3f, 0.1f, 0}, 65536, bounces);
    EXPECT_GT(l.mean, last - 4 * l.error);
    EXPECT_LT(l.mean, 1 + 4 * l.error);
    if (bounces == 30) expectEstimate(l, 1, 2e-3, 0);
    last = l.mean;
  }
}

TEST(PathTracer, GlossyFurnaceNeverExceedsTheAlbedo) {
  for (const float exponent : {1.0f, 20.0f, 3000.0f}) {
    const Scene scene = sceneOf(flat(rock(40)), phong(Rgb(0.3f), Rgb(0.7f), exponent));
    const Estimate l = radianceAlong(scene, whiteSky(), {0, 1.5f, 4}, {0.3f, 0.1f, 0}, 16384, 12);
    EXPECT_LT(l.error, 5e-3);
    EXPECT_LT(l.mean, 1 + 4 * l.error);
    EXPECT_GT(l.mean, 0.5);
  }
}

TEST(PathTracer, PhongPlaneUnderWhiteSkyShowsItsDirectionalAlbedo) {
  for (const float exponent : {1.0f, 30.0f, 1000.0f}) {
    const Material material = phong(Rgb(0.2f), Rgb(0.6f), exponent);
    const Scene plane = sceneOf(grid({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 1, 1), material);
    const Vec3 eye(2, 1.5f, 0.5f);
    const Rgb albedo = directionalAlbedo(material, normalize(Vec3(2, -0.5f, 1.5f)));  // local: z = normal
    expectEstimate(radianceAlong(plane, whiteSky(), eye, Vec3(0), 65536, 0), albedo.x, 3e-3, 0);
  }
}

/// The plain twin: f cos over a disc of light by a fine grid on its cap.
double discReflected(const Material& m, const Vec3& out, const Vec3& axis, double halfAngle) {
  const Frame frame = frameFromNormal(axis);
  const int rings = 600, turns = 600;
  double sum = 0;
  for (int r = 0; r < rings; ++r)
    for (int t = 0; t < turns; ++t) {
      const double theta = (r + 0.5) / rings * halfAngle, phi = 2 * kPi * (t + 0.5) / turns;
      const double s = std::sin(theta);
      const Vec3 in =
          frame.toWorld({float(s * std::cos(phi)), float(s * std::sin(phi)), float(std::cos(theta))});
      if (in.z > 0) sum += evalBrdf(m, in, out).x * in.z * s;
    }
  return sum * (halfAngle / rings) * (2 * kPi / turns);
}

TEST(PathTracer, BothSamplingTechniquesAreNeededAndAgree) {
  // Wide lobe and small light, narrow lobe and large light: each is hopeless for one technique alone.
  const Vec3 eye(-1.2f, 1, 0.3f);
  for (const auto& [exponent, angle] :
       {std::pair(5.0f, 0.02), std::pair(2000.0f, 0.9), std::pair(100.0f, 0.2)}) {
    const Material material = phong(Rgb(0.1f), Rgb(0.8f), exponent);
    const Scene plane = sceneOf(grid({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 1, 1), material);
    const Vec3 mirror = normalize(Vec3(1.2f, 1, -0.3f) + Vec3(0.05f, 0, 0.03f));
    // World to local: x -> x, z -> -y, y -> z: any rotation that takes +y to +z serves an isotropic BRDF.
    const auto local = [](const Vec3& v) { return normalize(Vec3(v.x, -v.z, v.y)); };
    const double expected = discReflected(material, local(eye), local(mirror), angle);
    const Estimate got = radianceAlong(plane, disc(float(angle), mirror), eye, Vec3(0), 65536, 0);
    expectEstimate(got, expected, 4e-3, 5e-4, std::to_string(exponent));
  }
}

TEST(PathTracer, DiffuseBouncesLeaveOutGlossOfOtherSurfacesOnly) {
  // A mirror-like floor, a matte wall above it lit only by way of the floor.
  TriMesh floor = grid({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 1, 1);
  TriMesh wall = grid({-5, 0, -1}, {10, 0, 0}, {0, 4, 0}, 1, 1);
  const std::vector<SceneObject> objects{
      {"floor", std::make_shared<TriMesh>(floor), Mat4(1), phong(Rgb(0.2f), Rgb(0.8f), 50)},
      {"wall", std::make_shared<TriMesh>(wall), Mat4(1), lambert(Rgb(0.5f))}};
  const Scene scene = flattenScene(objects);
  const LightRig light = disc(0.2f, {0, 1, 1});
  const Vec3 eye(0, 2, 4), onWall(0, 1, -1), onFloor(0, 0, 1);
  const double full = radianceAlong(scene, light, eye, onWall, 65536, 1).mean;
  const double diffuse = radianceAlong(scene, light, eye, onWall, 65536, 1, true).mean;
  const double direct = radianceAlong(scene, light, eye, onWall, 65536, 0).mean;
  EXPECT_GT(full, diffuse * 1.05);
  EXPECT_GT(diffuse, direct * 1.02);
  // Seen directly the floor keeps its gloss.
  EXPECT_EQ(radianceAlong(scene, light, eye, onFloor, 1024, 0, true).mean,
            radianceAlong(scene, light, eye, onFloor, 1024, 0, false).mean);
}

TEST(PathTracer, BackFacesBlockAndReflectOnlyWhenTwoSided) {
  Material material = lambert(Rgb(0.5f));
  const TriMesh lid = grid({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1);
  const Vec3 below(0.2f, -1, 0.1f);
  EXPECT_EQ(radianceAlong(sceneOf(lid, material), whiteSky(), below, {0, 1, 0}, 64, 2).mean, 0);
  material.twoSided = true;
  expectEstimate(radianceAlong(sceneOf(lid, material), whiteSky(), below, {0, 1, 0}, 65536, 2), 0.5, 2e-3, 0);
  // One-sided: nothing shines through it from behind. A floor close under the lid's back sees no sky.
  TriMesh both = grid({-0.1f, 0, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}, 1, 1);
  append(both, grid({-50, 0.01f, 50}, {100, 0, 0}, {0, 0, -100}, 1, 1));
  const Scene covered = sceneOf(both);
  for (const Estimate& e : measure(covered, whiteSky(), samplesAtVertices(covered), {0, 1, 2, 3}, 1024, 2))
    EXPECT_LT(e.mean, 1e-3);
}

TEST(PathTracer, LambertLooksTheSameFromEverywhereInFront) {
  // Shading normals lean away from the face: some views are under their horizon.
  TriMesh mesh = grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1);
  for (Vec3& n : mesh.normals) n = normalize(Vec3(1, 0.5f, 0));
  const Scene scene = sceneOf(mesh, lambert(Rgb(0.6f)));
  const Estimate front = radianceAlong(scene, whiteSky(), {1, 1, 0}, {0, 0, 0}, 65536, 0);
  const Estimate under = radianceAlong(scene, whiteSky(), {-1, 0.2f, 0}, {0, 0, 0}, 65536, 0);
  expectEstimate(under, front.mean, 5e-3, 0);
  EXPECT_GT(front.mean, 0.1);
}

TEST(PathTracer, MissesReturnTheLight) {
  const Scene scene = sceneOf(sphere(8, 16));
  Job job;
  const PathTracer tracer(scene, disc(0.2f), job);
  SobolStream stream(1, 0);
  EXPECT_EQ(tracer.trace({{0, 2, 0}, 0, {0, 1, 0}}, {}, stream).radiance, Rgb(1));
  EXPECT_EQ(tracer.trace({{0, 2, 0}, 0, {1, 0, 0}}, {}, stream).radiance, Rgb(0));
  EXPECT_FALSE(tracer.trace({{0, 2, 0}, 0, {1, 0, 0}}, {}, stream).hit);
}

TEST(PathTracer, ResultsDependOnTheSeedAndOnNothingElse) {
  const Scene scene = sceneOf(rock(30), lambert(Rgb(0.7f)));
  const SampleSet samples = samplesAtVertices(scene);
  const auto run = [&](int threads, std::uint64_t seed, std::vector<std::uint32_t> indices) {
    setThreadCount(threads);
    Job job;
    const PathTracer tracer(scene, disc(0.5f), job);
    PathOptions options;
    options.seed = seed;
    auto e = irradianceAtSamples(tracer, samples, indices, 64, options, job);
    setThreadCount(0);
    return e.mean;
  };
  const std::vector<Rgb> one = run(1, 5, {});
  EXPECT_EQ(one, run(6, 5, {}));
  EXPECT_NE(one, run(6, 6, {}));
  const std::vector<Rgb> some = run(3, 5, {7, 3});
  EXPECT_EQ(some[0], one[7]);
  EXPECT_EQ(some[1], one[3]);
}

TEST(PathTracer, StandardErrorBoundsTheSpreadBetweenSeeds) {
  const Scene scene = sceneOf(rock(30), lambert(Rgb(0.7f)));
  const SampleSet samples = samplesAtVertices(scene);
  Job job;
  const PathTracer tracer(scene, disc(0.5f, {1, 1, 1}), job);
  const int seeds = 64;
  DVec3 sum(0), squares(0), claimed(0);
  for (int s = 0; s < seeds; ++s) {
    PathOptions options;
    options.seed = std::uint64_t(s);
    const SampleIrradiance e =
        irradianceAtSamples(tracer, samples, std::vector<std::uint32_t>{100}, 64, options, job);
    const DVec3 v(e.mean[0]);
    sum += v, squares += v * v, claimed += DVec3(e.standardError[0]);
  }
  const double spread = std::sqrt(squares.x / seeds - std::pow(sum.x / seeds, 2));
  EXPECT_LT(spread, 1.3 * claimed.x / seeds);  // stratified numbers do better than independent ones
  EXPECT_GT(spread, 0);
}

TEST(PathTracer, OddGeometryGivesFiniteLight) {
  TriMesh mesh = rock(20);
  mesh.triangles.push_back({1, 1, 2});                             // no area
  for (std::size_t i = 0; i < 50; ++i) mesh.normals[i] = Vec3(0);  // no normal
  const Scene scene = sceneOf(mesh, phong(Rgb(0.5f), Rgb(0.5f), 10000));
  Job job;
  const PathTracer tracer(scene, disc(0.001f), job);
  for (std::uint32_t i = 0; i < 4000; ++i) {
    SobolStream stream(3, i);
    const Vec3 eye(std::sin(float(i)) * 3, 2, std::cos(float(i)) * 3);
    EXPECT_TRUE(isFinite(tracer.trace({eye, 0, normalize(-eye)}, {}, stream).radiance));
  }
  EXPECT_EQ(tracer.rays().refusedRays(), 0u);
}

TEST(PathTracer, CancelEndsIt) {
  const Scene scene = sceneOf(sphere(8, 16));
  Job job;
  const PathTracer tracer(scene, whiteSky(), job);
  const SampleSet samples = samplesAtVertices(scene);
  job.cancel();
  EXPECT_THROW(irradianceAtSamples(tracer, samples, {}, 16, {}, job), Cancelled);
}

}  // namespace
}  // namespace prt
