#include "libprt/transport/transfer_bake.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/bake_rays.h"
#include "libprt/transport/path_tracer.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::append;
using test::BakeInput;
using test::bowl;
using test::constantLight;
using test::lambert;
using test::lobeLight;
using test::rock;

TransferSettings settings(int rays, int bounces, std::optional<TransferForm> form = std::nullopt) {
  TransferSettings s;
  s.rays = rays, s.bounces = bounces, s.form = form, s.stopThreshold = 0;
  return s;
}

std::vector<Rgb> irradianceOf(const BakeInput& input, const Transfer& transfer, const ShRgb& light) {
  return irradiance(transfer, light, input.samples->shadingNormal);
}

/// Area-weighted mean over the surface of what is given at the vertices.
Rgb surfaceMean(const TriMesh& mesh, std::span<const Rgb> values) {
  DVec3 sum(0);
  double total = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const double area = length(DVec3(mesh.areaNormal(t)));
    for (int k = 0; k < 3; ++k) sum += area / 3 * DVec3(values[mesh.triangles[t][k]]);
    total += area;
  }
  return Rgb(sum / total);
}

/// Two objects of different albedo.
Scene twoObjects(Rgb rockAlbedo, Rgb ballAlbedo) {
  const std::vector<SceneObject> objects{
      {"rock", std::make_shared<TriMesh>(rock(12)), Mat4(1), lambert(rockAlbedo)},
      {"ball", std::make_shared<TriMesh>(test::sphere(6, 12, 0.5f, {1.6f, 0, 0})), Mat4(1),
       lambert(ballAlbedo)}};
  return flattenScene(objects);
}

// ---- Closed forms ----

/// Every point of half a sphere sees half a white sky by cosine, and the other half is the bowl itself:
/// with albedo 1 the sums are 1/2, 3/4, 7/8, 15/16.
TEST(Bounces, BowlFillsUpByHalves) {
  const BakeInput input(bowl(24, 48), Rgb(1));
  for (int k = 0; k < 4; ++k) {
    const Transfer transfer = input.transfer(settings(1024, k));
    EXPECT_EQ(transfer.bounces, k);
    const std::vector<Rgb> e = irradianceOf(input, transfer, constantLight(Rgb(1)));
    double mean = 0;
    for (std::size_t v = 48; v < e.size(); ++v) {  // without the rim, whose faces all lie on one side
      EXPECT_NEAR(e[v].x / kPiF, 1 - std::pow(0.5, k + 1), 0.012) << k << " " << v;
      mean += e[v].x / kPi / double(e.size() - 48);
    }
    EXPECT_NEAR(mean, 1 - std::pow(0.5, k + 1), 0.0015) << k;
  }
}

/// Any light: what bounces in a bowl is the same everywhere, albedo (1-f) E0 / (1 - albedo (1-f)).
TEST(Bounces, BowlSpreadsBouncesEvenly) {
  const Rgb albedo(0.9f, 0.5f, 0.2f);
  const BakeInput input(bowl(24, 48), albedo);
  const ShRgb light = lobeLight({0.7f, 1, 0.2f});
  const std::vector<Rgb> direct = irradianceOf(input, input.transfer(settings(1024, 0)), light),
                         all = irradianceOf(input, input.transfer(settings(1024, 60)), light);
  const Rgb mean = surfaceMean(input.scene->mesh, direct),
            expected = 0.5f * albedo * mean / (1.0f - 0.5f * albedo);
  for (std::size_t v = 48; v < all.size(); v += 7)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR((all[v] - direct[v])[c], expected[c], 0.015f * mean[c]) << v;
}

TEST(Bounces, WallsOfACornerHaveConstantRadiosity) {
  const Rgb albedo(0.8f, 0.5f, 0.3f);
  for (const double degrees : {60.0, 90.0}) {
    const double f = (1 - std::cos(radians(degrees))) / 2;
    const BakeInput input(test::dihedral(radians(degrees), 20), albedo);
    const std::vector<Rgb> e = irradianceOf(input, input.transfer(settings(1024, 40)), constantLight(Rgb(1)));
    for (std::size_t v = 0; v < e.size(); ++v) {
      const Vec3 p = input.scene->mesh.positions[v];
      if (length(p) > 5) continue;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e[v][c] / kPi, f / (1 - albedo[c] * (1 - f)), 0.012) << degrees << " " << v;
    }
  }
}

/// White surfaces under a white sky: every bounce brings everything nearer to 1, and nothing above it.
TEST(Bounces, FurnaceFillsFromBelow) {
  const BakeInput input(rock(24), Rgb(1));
  std::vector<float> before(input.samples->size(), 0);
  for (const int k : {0, 1, 2, 4, 40}) {
    TransferSettings fromVertices = settings(256, k);
    fromVertices.areaMeans = false;
    const std::vector<Rgb> e = irradianceOf(input, input.transfer(fromVertices), constantLight(Rgb(1)));
    for (std::size_t v = 0; v < e.size(); ++v) {
      EXPECT_GE(e[v].x / kPiF, before[v] - 1e-5f);
      EXPECT_LE(e[v].x / kPiF, 1 + 1e-5f);
      before[v] = e[v].x / kPiF;
    }
  }
  EXPECT_GT(*std::min_element(before.begin(), before.end()), 0.98f);
}

/// Flat faces hide part of what smooth normals see, so a coarse furnace does not fill up: it ends where path
/// tracing ends, and never above 1.
TEST(Bounces, CoarseFurnaceLosesWhatItsFacesHide) {
  const BakeInput input(rock(24), Rgb(1));
  Job job;
  LightRig rig;
  rig.constant = Rgb(1);
  PathOptions path;
  path.bounces = 4;
  const PathTracer tracer(*input.scene, rig, job);
  double truth = 0, baked = 0, bare = 0;
  for (const Rgb& e : irradianceAtSamples(tracer, *input.samples, {}, 1024, path, job).mean)
    truth += 1 - e.x / kPi;
  TransferSettings s = settings(1024, 4);
  for (const Rgb& e : irradianceOf(input, input.transfer(s), constantLight(Rgb(1)))) {
    EXPECT_LE(e.x / kPiF, 1 + 1e-5f);
    baked += 1 - e.x / kPi;
  }
  s.areaMeans = false;
  for (const Rgb& e : irradianceOf(input, input.transfer(s), constantLight(Rgb(1)))) bare += 1 - e.x / kPi;
  EXPECT_LT(bare, 0.1 * truth) << "nothing to tell apart";
  EXPECT_NEAR(baked / truth, 1, 0.2);
}

/// A sheet that reflects on both sides keeps a furnace full; one that does not leaves shadows behind it.
TEST(Bounces, BacksReflectOnlyWhenTwoSided) {
  for (const bool twoSided : {true, false}) {
    Material sheet = lambert(Rgb(1));
    sheet.twoSided = twoSided;
    const std::vector<SceneObject> objects{
        {"bowl", std::make_shared<TriMesh>(bowl(8, 16)), Mat4(1), sheet},
        {"ball", std::make_shared<TriMesh>(test::sphere(6, 12, 0.5f, {0, -1.6f, 0})), Mat4(1),
         lambert(Rgb(1))}};
    const BakeInput input(flattenScene(objects));
    const Transfer transfer = input.transfer(settings(256, 60));
    const std::vector<Rgb> e = irradianceOf(input, transfer, constantLight(Rgb(1)));
    const std::size_t vertices = input.scene->mesh.vertexCount(),
                      top = vertices - 1;  // the ball's upper pole
    EXPECT_EQ(e.size(), twoSided ? vertices + 16 * 8 + 1 : vertices);
    if (twoSided) {
      EXPECT_NEAR(e[top].x / kPi, 1, 0.01);
    } else {
      EXPECT_LT(e[top].x / kPi, 0.5);
    }
  }
}

// ---- Slow twins ----

/// The rays of one sample as the bake sends them, traced one by one: direction, function values, hit.
struct PlainRay {
  DVec3 direction;
  std::vector<double> y;
  Hit hit;
  double weight;  // cosine included
};

std::vector<PlainRay> plainRays(const BakeInput& input, std::size_t s, RaySpread spread, int count,
                                std::uint64_t seed) {
  Job job;
  const RayTable table(spread, 2, 0, count, seed, job);
  const int scramble = bakeScramble(*input.samples, s, seed);
  WorldRays world;
  world.turn(table, scramble, bakeFrame(*input.samples, s, spread, seed));
  std::vector<PlainRay> rays;
  for (std::size_t i = 0; i < std::size_t(count); ++i) {
    const Vec3 d(world.x[i], world.y[i], world.z[i]);
    PlainRay ray{DVec3(d), std::vector<double>(25), {}, 0};
    if (dot(d, input.samples->geometricNormal[s]) <= 0 && spread == RaySpread::Cosine) continue;
    shEvaluate(5, normalize(ray.direction), ray.y);
    ray.hit = input.rays->intersect({input.samples->origin[s], 0, d});
    ray.weight = spread == RaySpread::Cosine
                     ? kPi / count
                     : 2 * kPi / count * std::max(0.0f, dot(d, input.samples->shadingNormal[s]));
    rays.push_back(ray);
  }
  return rays;
}

using Vectors = std::vector<std::vector<double>>;  // [S][25]

/// Radiance coefficients that leave towards a ray's origin from where it hit: one channel.
std::vector<double> plainReflected(const BakeInput& input, const PlainRay& ray, const Vectors& irradiance,
                                   int channel) {
  std::vector<double> g(25, 0);
  if (!ray.hit.valid() || ray.hit.back) return g;
  const UVec3 t = input.scene->mesh.triangles[ray.hit.triangle];
  const Vec2 b = ray.hit.barycentric;
  const std::array<double, 3> w{1.0 - b.x - b.y, b.x, b.y};
  for (int c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 25; ++k)
      g[k] += input.scene->materialOf(ray.hit.triangle).albedo[channel] / kPi * w[std::size_t(c)] *
              irradiance[t[c]][k];
  return g;
}

/// The chain from given direct vectors on, in double, ray by ray: all bounces, and all but the last.
std::pair<Vectors, Vectors> plainBounces(const BakeInput& input,
                                         const std::vector<std::vector<PlainRay>>& rays,
                                         const Vectors& direct, int bounces, int channel) {
  Vectors last = direct, total = direct, beforeLast = direct;
  for (int b = 0; b < bounces; ++b) {
    beforeLast = total;
    Vectors next(direct.size(), std::vector<double>(25, 0));
    for (std::size_t s = 0; s < direct.size(); ++s)
      for (const PlainRay& ray : rays[s]) {
        const std::vector<double> g = plainReflected(input, ray, last, channel);
        for (std::size_t k = 0; k < 25; ++k) next[s][k] += ray.weight * g[k];
      }
    last = next;
    for (std::size_t s = 0; s < direct.size(); ++s)
      for (std::size_t k = 0; k < 25; ++k) total[s][k] += last[s][k];
  }
  return {total, beforeLast};
}

std::vector<std::vector<PlainRay>> allPlainRays(const BakeInput& input, RaySpread spread, int count) {
  std::vector<std::vector<PlainRay>> rays;
  for (std::size_t s = 0; s < input.samples->size(); ++s)
    rays.push_back(plainRays(input, s, spread, count, 1));
  return rays;
}

Vectors vectorsOf(const Array& array) {
  Vectors vectors;
  for (std::size_t s = 0; s < std::size_t(array.shape[0]); ++s) {
    const std::span<const float> row = test::rowOf(array, s);
    vectors.emplace_back(row.begin(), row.end());
  }
  return vectors;
}

TEST(Bounces, AgreeWithPlainRecursionRayByRay) {
  const BakeInput input(twoObjects({0.8f, 0.4f, 0.1f}, {0.3f, 0.9f, 0.5f}));
  TransferSettings fromVertices = settings(256, 3);
  fromVertices.areaMeans = false;
  const Transfer direct = input.transfer(settings(256, 0)), transfer = input.transfer(fromVertices);
  ASSERT_EQ(transfer.form, TransferForm::Diffuse);
  ASSERT_EQ(transfer.channels, 3);
  const auto rays = allPlainRays(input, RaySpread::Cosine, 256);
  for (int c = 0; c < 3; ++c) {
    const auto [plain, beforeLast] = plainBounces(input, rays, vectorsOf(direct.values), 3, c);
    double worst = 0, worstSurface = 0, added = 0;
    for (std::size_t s = 0; s < plain.size(); ++s)
      for (std::size_t k = 0; k < 25; ++k) {
        const std::size_t at = (s * 25 + k) * 3 + std::size_t(c);
        worst = std::max(worst, std::abs(transfer.values.as<float>()[at] - plain[s][k]));
        worstSurface = std::max(worstSurface, std::abs(transfer.surface.as<float>()[at] - beforeLast[s][k]));
        added = std::max(added, std::abs(plain[s][k] - direct.values.as<float>()[s * 25 + k]));
      }
    EXPECT_LT(worst, 2e-5) << c;
    EXPECT_LT(worstSurface, 2e-5) << c;
    EXPECT_GT(added, 0.05) << c;
  }
}

TEST(Bounces, MatricesAgreeWithPlainGatherRayByRay) {
  const BakeInput input(twoObjects({0.8f, 0.4f, 0.1f}, {0.3f, 0.9f, 0.5f}));
  TransferSettings s0 = settings(256, 0, TransferForm::Matrix), s2 = settings(256, 2, TransferForm::Matrix);
  s0.storage = s2.storage = DType::f32;
  s2.areaMeans = false;
  const Transfer direct = input.transfer(s0), transfer = input.transfer(s2);
  ASSERT_EQ(transfer.channels, 3);
  const Array before = expandedMatrices(direct), after = expandedMatrices(transfer);
  EXPECT_EQ(after.shape, (std::vector<std::int64_t>{std::int64_t(input.samples->size()), 25, 25, 3}));
  const auto rays = allPlainRays(input, RaySpread::Uniform, 256);
  for (int c = 0; c < 3; c += 2) {
    const auto [plain, beforeLast] = plainBounces(input, rays, vectorsOf(direct.diffuse), 2, c);
    double worst = 0, worstVector = 0;
    for (std::size_t s = 0; s < input.samples->size(); s += 3) {
      std::vector<double> expected(625, 0);
      for (const PlainRay& ray : rays[s]) {
        const std::vector<double> g = plainReflected(input, ray, beforeLast, c);
        for (std::size_t k = 0; k < 625; ++k) expected[k] += 2 * kPi / 256 * ray.y[k / 25] * g[k % 25];
      }
      for (std::size_t k = 0; k < 625; ++k)
        worst = std::max(worst, std::abs(after.as<float>()[(s * 625 + k) * 3 + std::size_t(c)] -
                                         before.as<float>()[s * 625 + k] - expected[k]));
      for (std::size_t k = 0; k < 25; ++k)
        worstVector =
            std::max(worstVector,
                     std::abs(transfer.diffuse.as<float>()[(s * 25 + k) * 3 + std::size_t(c)] - plain[s][k]));
    }
    EXPECT_LT(worst, 3e-5) << c;
    EXPECT_LT(worstVector, 2e-5) << c;
  }
}

// ---- Colours, storage, memory, threads ----

/// Each channel of a coloured bake is the grey bake with that channel's albedos.
TEST(Bounces, ChannelsAreIndependent) {
  const Rgb a(0.8f, 0.4f, 0.1f), b(0.3f, 0.9f, 0.5f);
  for (const bool equal : {false, true}) {  // one albedo everywhere takes a shorter way
    const BakeInput coloured(twoObjects(a, equal ? a : b));
    const Transfer all = coloured.transfer(settings(128, 4));
    for (int c = 0; c < 3; ++c) {
      const Transfer one =
          BakeInput(twoObjects(Rgb(a[c]), Rgb(equal ? a[c] : b[c]))).transfer(settings(128, 4));
      ASSERT_EQ(one.channels, 1);
      double worst = 0;
      for (std::size_t i = 0; i < one.values.as<float>().size(); ++i)
        worst = std::max(worst, double(std::abs(all.values.as<float>()[3 * i + std::size_t(c)] -
                                                one.values.as<float>()[i])));
      EXPECT_LT(worst, 5e-6) << c << equal;
    }
  }
}

bool sameBits(const Transfer& a, const Transfer& b) {
  return a.values.bytes == b.values.bytes && a.diffuse.bytes == b.diffuse.bytes &&
         a.surface.bytes == b.surface.bytes && a.bounces == b.bounces;
}

TEST(Bounces, BitsDoNotDependOnMemoryOrThreads) {
  const BakeInput input(twoObjects({0.8f, 0.4f, 0.1f}, {0.3f, 0.9f, 0.5f}));
  for (const TransferForm form : {TransferForm::Diffuse, TransferForm::Matrix}) {
    const Transfer expected = input.transfer(settings(1500, 2, form));
    for (const std::size_t memory : {std::size_t{0}, std::size_t{200000}, std::size_t{1} << 30})
      for (const int threads : {1, 2, 5}) {
        TransferSettings s = settings(1500, 2, form);
        s.hitMemory = memory;
        setThreadCount(threads);
        EXPECT_TRUE(sameBits(input.transfer(s), expected)) << memory << " " << threads;
      }
    setThreadCount(0);
  }
}

TEST(Bounces, EndWhenTheyNoLongerShow) {
  const BakeInput input(bowl(16, 32), Rgb(0.5f));
  int expected = 0;
  for (double share = 1; share >= 0.01;) {  // what the last of `expected` bounces adds
    const Transfer before = input.transfer(settings(256, expected)),
                   after = input.transfer(settings(256, ++expected));
    double added = 0, total = 0;
    for (std::size_t i = 0; i < after.values.size(); ++i) {
      added += std::pow(after.values.as<float>()[i] - before.values.as<float>()[i], 2);
      total += std::pow(after.values.as<float>()[i], 2);
    }
    share = std::sqrt(added / total);
  }
  EXPECT_GT(expected, 1);
  TransferSettings s = settings(256, 50);
  s.stopThreshold = 0.01f;
  EXPECT_EQ(input.transfer(s).bounces, expected);
}

TEST(TransferBake, StorageTypesDifferByWhatIsReported) {
  const BakeInput input(rock(16), Rgb(0.7f));
  for (const TransferForm form : {TransferForm::Diffuse, TransferForm::Visibility, TransferForm::Matrix}) {
    TransferSettings s = settings(256, form == TransferForm::Visibility ? 0 : 2, form);
    s.storage = DType::f32;
    const Transfer full = input.transfer(s);
    s.storage = DType::f16;
    const Transfer half = input.transfer(s);
    EXPECT_EQ(full.storageError, 0);
    EXPECT_LT(half.storageError, 3e-4);
    EXPECT_GT(half.storageError, 3e-5);
    const Array a = form == TransferForm::Diffuse ? diffuseVectors(full) : expandedMatrices(full);
    const Array b = form == TransferForm::Diffuse ? diffuseVectors(half) : expandedMatrices(half);
    const std::vector<double> exact(a.as<float>().begin(), a.as<float>().end());
    EXPECT_NEAR(test::relativeError(b.as<float>(), exact), half.storageError,
                form == TransferForm::Visibility ? 2e-4 : 1e-6);
    EXPECT_EQ(half.values.bytes.size() * 2, full.values.bytes.size());
  }
}

/// Points between the vertices gather the same bounces.
TEST(TransferBake, PointsOffTheVerticesBounceToo) {
  const BakeInput input(bowl(24, 48), Rgb(1));
  Job job;
  for (const int bounces : {1, 2}) {
    const Transfer vertices = input.transfer(settings(256, bounces));
    const SampleSet points = samplesOnSurface(*input.scene, 200, 5);
    BakeInput free = input;
    free.samples = std::make_shared<SampleSet>(points);
    const TransferSettings s = settings(1024, bounces);
    const DirectTransfer direct = free.direct(directSettings(s, TransferForm::Diffuse));
    const Transfer transfer =
        finishTransfer(*input.scene, *input.rays, points, direct, s, TransferForm::Diffuse, job, &vertices);
    EXPECT_EQ(transfer.bounces, bounces);
    double mean = 0;
    for (const Rgb& e : irradiance(transfer, constantLight(Rgb(1)), points.shadingNormal))
      mean += e.x / kPi / 200;
    EXPECT_NEAR(mean, 1 - std::pow(0.5, bounces + 1), 0.005);
    EXPECT_THROW(finishTransfer(*input.scene, *input.rays, points, direct, s, TransferForm::Diffuse, job),
                 ValueError);
  }
}

TEST(TransferBake, TheCheapestSufficientFormIsChosen) {
  Material matt = lambert(Rgb(0.5f)), shiny = matt;
  shiny.model = MaterialModel::Phong, shiny.specular = Rgb(0.3f);
  const std::vector<Material> diffuse{matt, matt}, mixed{matt, shiny};
  const auto form = [](int bounces, bool shadows, std::optional<TransferForm> wanted,
                       const std::vector<Material>& materials) {
    TransferSettings s = settings(64, bounces, wanted);
    s.shadows = shadows;
    return resolveForm(s, materials);
  };
  EXPECT_EQ(form(3, true, {}, diffuse), TransferForm::Diffuse);
  EXPECT_EQ(form(0, true, {}, diffuse), TransferForm::Diffuse);
  EXPECT_EQ(form(0, true, {}, mixed), TransferForm::Visibility);
  EXPECT_EQ(form(1, true, {}, mixed), TransferForm::Matrix);
  EXPECT_EQ(form(3, false, {}, mixed), TransferForm::None);
  EXPECT_EQ(form(3, false, TransferForm::Matrix, mixed), TransferForm::None);
  EXPECT_EQ(form(0, true, TransferForm::Matrix, diffuse), TransferForm::Matrix);
}

TEST(TransferBake, SettingsThatMakeNoSenseAreRefused) {
  const auto refused = [](const std::function<void(TransferSettings&)>& change) {
    TransferSettings s;
    change(s);
    EXPECT_THROW(check(s), ValueError);
  };
  refused([](TransferSettings& s) { s.bands = 0; });
  refused([](TransferSettings& s) { s.bands = 11; });
  refused([](TransferSettings& s) { s.rays = 0; });
  refused([](TransferSettings& s) { s.bounces = -1; });
  refused([](TransferSettings& s) { s.bounces = kMaxBounces + 1; });
  refused([](TransferSettings& s) { s.stopThreshold = std::nanf(""); });
  refused([](TransferSettings& s) { s.storage = DType::u8; });
  refused([](TransferSettings& s) { s.form = TransferForm::Visibility; });
  EXPECT_NO_THROW(check(TransferSettings{}));
}

TEST(TransferBake, PreviewsComeFirstAndRefine) {
  const BakeInput input(rock(16), Rgb(0.6f));
  std::vector<int> rays;
  std::vector<double> errors;
  const Transfer reference = input.transfer(settings(8192, 2));
  const std::vector<double> exact(reference.values.as<float>().begin(), reference.values.as<float>().end());
  Job job;
  const Transfer last = bakeTransfer(
      input.scene, input.rays, input.samples, settings(1024, 2), job, [&](const Transfer& preview) {
        EXPECT_FALSE(preview.final());
        rays.push_back(preview.raysPerSample);
        errors.push_back(test::relativeError(preview.values.as<float>(), exact));
      });
  EXPECT_TRUE(last.final());
  EXPECT_EQ(rays, (std::vector<int>{16, 64, 256}));
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(errors[2], 0.5 * errors[1]);
  EXPECT_LT(test::relativeError(last.values.as<float>(), exact), 0.5 * errors[2]);
}

TEST(Bounces, GoOnFromAnyOfThemToTheSameBits) {
  const BakeInput grey(bowl(16, 32), Rgb(0.6f));
  Scene coloured = *grey.scene;
  coloured.materials[0].albedo = Rgb(0.8f, 0.5f, 0.2f);
  for (const BakeInput& input : {grey, BakeInput(coloured)})
    for (const TransferForm form : {TransferForm::Diffuse, TransferForm::Matrix}) {
      TransferSettings s = settings(128, 4, form);
      s.stopThreshold = 0;
      const DirectTransfer direct = input.direct(directSettings(s, form));
      Job job;
      const auto finish = [&](const BounceCheckpoint& checkpoint) {
        return finishTransfer(*input.scene, *input.rays, *input.samples, direct, s, form, job, nullptr,
                              &checkpoint);
      };
      std::vector<std::map<std::string, Array>> states;
      const Transfer whole =
          finish({{}, [&](std::map<std::string, Array> state) { states.push_back(std::move(state)); }});
      ASSERT_EQ(states.size(), 4u);
      for (std::size_t done = 1; done <= states.size(); ++done) {
        std::size_t more = 0;
        const Transfer resumed = finish({states[done - 1], [&](const auto&) { ++more; }});
        EXPECT_EQ(more, states.size() - done);
        EXPECT_EQ(resumed.bounces, 4);
        EXPECT_EQ(resumed.values.bytes, whole.values.bytes);
        EXPECT_EQ(resumed.surface.bytes, whole.surface.bytes);
      }
      // What is of another bake is not taken up.
      for (const char* name : {"bounces", "share", "total", "before_last", "last"}) {
        std::map<std::string, Array> other = states[1];
        other[name].bytes.pop_back();
        std::size_t all = 0;
        EXPECT_EQ(finish({other, [&](const auto&) { ++all; }}).values.bytes, whole.values.bytes);
        EXPECT_EQ(all, states.size()) << name;
      }
    }
}

TEST(Bounces, AChainThatHasEndedIsNotGoneOnWith) {
  const BakeInput input(bowl(16, 32), Rgb(0.2f));
  TransferSettings s = settings(128, 50);
  s.stopThreshold = 0.01f;
  const DirectTransfer direct = input.direct(directSettings(s, TransferForm::Diffuse));
  Job job;
  BounceCheckpoint checkpoint;
  checkpoint.keep = [&](std::map<std::string, Array> state) { checkpoint.saved = std::move(state); };
  const auto finish = [&] {
    return finishTransfer(*input.scene, *input.rays, *input.samples, direct, s, TransferForm::Diffuse, job,
                          nullptr, &checkpoint);
  };
  const int bounces = finish().bounces;
  EXPECT_LT(bounces, 10);
  EXPECT_EQ(finish().bounces, bounces);
}

TEST(TransferBake, CancellingStopsEveryPhase) {
  const BakeInput input(rock(24), Rgb(0.6f));
  for (const std::string phase : {"direct transfer", "area means", "bounces", "transfer matrices"}) {
    Job* self = nullptr;
    Job job(
        [&](const Progress& p) {
          if (p.phase == phase) self->cancel();
        },
        1e9);
    self = &job;
    EXPECT_THROW(
        bakeTransfer(input.scene, input.rays, input.samples, settings(512, 2, TransferForm::Matrix), job),
        Cancelled)
        << phase;
  }
}

// ---- Buried samples ----

TEST(Buried, VerticesInsideAnotherBodyTakeTheirNeighboursValues) {
  const std::vector<SceneObject> objects{
      {"ground", std::make_shared<TriMesh>(test::grid({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 40, 40)), Mat4(1),
       lambert(Rgb(0.5f))},
      {"ball", std::make_shared<TriMesh>(test::sphere(24, 48, 0.7f)), Mat4(1), lambert(Rgb(0.5f))}};
  const BakeInput input(flattenScene(objects));
  for (const TransferForm form : {TransferForm::Diffuse, TransferForm::Matrix}) {
    const DirectTransfer direct = input.direct(directSettings(settings(256, 2), form));
    const std::vector<Rgb> e =
        irradianceOf(input, input.transfer(settings(256, 2, form)), constantLight(Rgb(1)));
    const std::vector<Rgb> l =
        form == TransferForm::Matrix
            ? transferredRadiance(input.transfer(settings(256, 2, form)), constantLight(Rgb(1)))
            : std::vector<Rgb>(e.size() * 25, Rgb(1));
    for (std::size_t v = 0; v < 41 * 41; ++v) {
      const float r = length(input.scene->mesh.positions[v]);
      if (std::abs(r - 0.7f) < 0.03f) continue;  // on the contact itself
      EXPECT_EQ(direct.buried.as<std::uint8_t>()[v], r < 0.7f) << r;
      EXPECT_GT(e[v].x, 0.4f) << r;
      EXPECT_GT(l[v * 25].x, 0.4f) << r;
    }
  }
}

/// A plate of 1 x 1 whose underside is `gap` over a ground of cells of 0.1.
Scene plateOverGround(float gap) {
  const std::vector<SceneObject> objects{
      {"ground", std::make_shared<TriMesh>(test::grid({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 40, 40)), Mat4(1),
       lambert(Rgb(0.5f))},
      {"plate", std::make_shared<TriMesh>(test::box({-0.5f, gap, -0.5f}, {0.5f, gap + 0.2f, 0.5f})), Mat4(1),
       lambert(Rgb(0.5f))}};
  return flattenScene(objects);
}

TEST(Buried, VerticesInAGapNarrowerThanTheirMeshTakeTheirNeighboursValues) {
  const BakeInput input(plateOverGround(0.02f));
  const TransferSettings diffuse = settings(256, 1, TransferForm::Diffuse);
  const DirectTransfer direct = input.direct(directSettings(diffuse, TransferForm::Diffuse));
  const std::vector<Rgb> e = irradianceOf(input, input.transfer(diffuse), constantLight(Rgb(1)));
  for (std::size_t v = 0; v < 41 * 41; ++v) {
    const Vec3& p = input.scene->mesh.positions[v];
    const bool under = std::max(std::abs(p.x), std::abs(p.z)) < 0.45f;
    if (under) {
      EXPECT_EQ(direct.buried.as<std::uint8_t>()[v], 1) << p.x << " " << p.z;
    }
    if (std::max(std::abs(p.x), std::abs(p.z)) > 0.55f) {
      EXPECT_EQ(direct.buried.as<std::uint8_t>()[v], 0) << p.x << " " << p.z;
    }
    EXPECT_GT(e[v].x, 0.4f) << p.x << " " << p.z;
  }
}

TEST(Buried, AGapThatTheMeshCanShowStaysDark) {
  const BakeInput input(plateOverGround(0.15f));
  const TransferSettings diffuse = settings(256, 0, TransferForm::Diffuse);
  const DirectTransfer direct = input.direct(directSettings(diffuse, TransferForm::Diffuse));
  for (std::size_t v = 0; v < 41 * 41; ++v) EXPECT_EQ(direct.buried.as<std::uint8_t>()[v], 0) << v;
}

TEST(Buried, NothingIsBuriedUnderAnOpenSheet) {
  TriMesh mesh = test::grid({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8, 8);
  append(mesh, test::grid({-2, 0.5f, 2}, {4, 0, 0}, {0, 0, -4}, 8, 8));
  const DirectTransfer direct =
      BakeInput(mesh).direct(directSettings(settings(64, 0), TransferForm::Diffuse));
  for (const std::uint8_t flag : direct.buried.as<std::uint8_t>()) EXPECT_EQ(flag, 0);
  EXPECT_LT(test::rowOf(direct.diffuse, 40)[0], 0.3f);  // and it is dark there
}

TEST(Buried, ABodyBuriedAsAWholeKeepsItsOwnValues) {
  TriMesh mesh = test::sphere(8, 16);
  append(mesh, test::sphere(8, 16, 0.3f));
  const BakeInput input(mesh);
  const DirectTransfer direct = input.direct(directSettings(settings(64, 0), TransferForm::Diffuse));
  const std::size_t half = direct.samples() / 2;
  for (std::size_t s = 0; s < direct.samples(); ++s) {
    EXPECT_EQ(direct.buried.as<std::uint8_t>()[s], s >= half);
    if (s < half) continue;
    EXPECT_EQ(test::rowOf(direct.diffuse, s)[0], 0);
  }
}

}  // namespace
}  // namespace prt
