// Physics of the fast bake: closed forms, furnace, invariance, and a slow plain twin.

#include "libprt/meso/rtt_bake.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"
#include "libprt/material/glossy_response.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using namespace test;

TEST(RttBake, FlatPatchIsLambertFromEveryView) {
  const Rgb albedo(0.8f, 0.4f, 0.1f);
  const Rtt rtt = baked(flatPatch(albedo), small(4, 8));
  EXPECT_EQ(rtt.channels, 1);  // scalar times albedo, exactly
  const double lambert[25] = {0.282095, 0, 0.325735, 0, 0, 0, 0.157696, 0,         0, 0, 0, 0, 0,
                              0,        0, 0,        0, 0, 0, 0,        -0.035262, 0, 0, 0, 0};
  for (int view = 0; view < 64; ++view)
    for (int t = 0; t < 16; ++t) {
      std::vector<Rgb> b(25);
      rtt.response(t % 4, t / 4, ViewSquare(8).centre(view), b);
      for (int k = 0; k < 25; ++k)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[std::size_t(k)][c], albedo[c] * lambert[k], 2e-6);
    }
}

TEST(RttBake, WhiteFurnaceGivesOne) {
  RttSettings settings = small(24, 4, 256, 60);
  const Rtt rtt = baked(heightField(bumps(48, 0.3f), Rgb(1)), settings);
  expectWhiteFurnace(rtt);
}

TEST(RttBake, GrooveSeesAsMuchSkyAsTheCrossedStringsSay) {
  for (const double opening : {kPi / 3, kPi / 2, 2 * kPi / 3}) {
    RttSettings settings = small(128, 1, 1024);
    settings.supersamples = 4;
    const Rtt rtt = baked(vGroove(opening, 64, Rgb(1)), settings);
    EXPECT_NEAR(mean(underWhiteSky(rtt, 0)), std::sin(opening / 2), 2e-3) << opening;
  }
}

/// From a point `s` of the way up a wall of the groove the sky is cut off by the other wall's edge only: a
/// dihedral of its own opening angle, whose sky share is (1 - cos)/2.
double dihedralShare(double opening, double s) {
  const double half = opening / 2;  // in a plane across, walls of length 1 from the origin
  const DVec3 wall(std::sin(half), std::cos(half), 0), edge(-std::sin(half), std::cos(half), 0);
  const double angle = std::acos(dot(wall, normalize(edge - s * wall)));
  return (1 - std::cos(angle)) / 2;
}

TEST(RttBake, GrooveFollowsTheDihedralAlongItsWalls) {
  const double opening = kPi / 2;
  RttSettings settings = small(64, 1, 4096);
  settings.supersamples = 4;
  const Rtt rtt = baked(vGroove(opening, 128, Rgb(1)), settings);
  const std::vector<double> sky = underWhiteSky(rtt, 0);
  for (int u = 0; u < 64; ++u) {
    const double s = std::abs((u + 0.5) / 64 - 0.5) * 2;
    EXPECT_NEAR(sky[std::size_t(u)], dihedralShare(opening, s), 5e-3) << u;
  }
}

/// Radiosity of the groove's walls with bounces, by a fine one-dimensional quadrature of the integral
/// equation: form factor density between two strips of infinite length, cos cos / (2 r).
std::vector<double> grooveRadiosity(double opening, double albedo, int cells, int bounces) {
  const double half = opening / 2;
  const auto count = std::size_t(cells);
  std::vector<double> e(count), last, total(count, 0.0);
  const auto place = [&](int i) { return (i + 0.5) / cells; };
  for (int i = 0; i < cells; ++i) e[std::size_t(i)] = dihedralShare(opening, place(i));
  for (int b = 0; b <= bounces; ++b) {
    for (int i = 0; i < cells; ++i) total[std::size_t(i)] += albedo * e[std::size_t(i)];
    last = e;
    for (int i = 0; i < cells; ++i) {
      double sum = 0;
      for (int j = 0; j < cells; ++j) {
        const DVec3 p = place(i) * DVec3(std::sin(half), std::cos(half), 0);
        // Each strip's share is exact: sines of the angles to its ends.
        const auto sine = [&](double s) {
          const DVec3 d = normalize(s * DVec3(-std::sin(half), std::cos(half), 0) - p);
          return dot(d, DVec3(std::sin(half), std::cos(half), 0));  // along the wall
        };
        sum += std::abs(sine(double(j + 1) / cells) - sine(double(j) / cells)) / 2 * last[std::size_t(j)];
      }
      e[std::size_t(i)] = albedo * sum;
    }
  }
  return total;
}

TEST(RttBake, GrooveBouncesFollowTheIntegralEquation) {
  const double opening = kPi / 2;
  for (const float albedo : {0.5f, 0.9f}) {
    RttSettings settings = small(64, 1, 4096, 4);
    settings.supersamples = 4;
    const Rtt rtt = baked(vGroove(opening, 128, Rgb(albedo)), settings);
    const std::vector<double> wanted = grooveRadiosity(opening, albedo, 512, 4), sky = underWhiteSky(rtt, 0);
    double square = 0, size = 0;
    for (int u = 0; u < 64; ++u) {
      const int at = std::min(511, int(std::abs((u + 0.5) / 64 - 0.5) * 2 * 512));
      square += std::pow(sky[std::size_t(u)] - wanted[std::size_t(at)], 2),
          size += wanted[std::size_t(at)] * wanted[std::size_t(at)];
    }
    EXPECT_LT(std::sqrt(square / size), 5e-3) << albedo;
  }
}

TEST(RttBake, ShiftsMoveTheTable) {
  const Patch patch = heightField(bumps(32, 0.2f), Rgb(0.7f));
  const RttSettings settings = small(16, 4, 4096, 1);
  const Rtt here = baked(patch, settings),
            there = baked(shifted(patch, Vec2(5.0f / 16, 10.0f / 16)), settings);
  Rtt back = here;
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 16; ++u)
      std::copy_n(there.block((u + 5) % 16, (v + 10) % 16, 0), 16 * 25, back.block(u, v, 0));
  EXPECT_LT(relativeDifference(back, here), 4e-3);
  EXPECT_GT(relativeDifference(there, here), 0.05);
}

TEST(RttBake, QuarterTurnsTurnLightAndViews) {
  const Patch patch = heightField(bumps(32, 0.2f), Rgb(0.7f));
  RttSettings settings = small(16, 4, 1024, 1);
  settings.supersamples = 8;  // their places in a texel do not turn with it
  const Rtt here = baked(patch, settings), turned = baked(quarterTurned(patch), settings);
  Rtt back = here;
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 16; ++u)
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
          float* to = back.block(u, v, y * 4 + x);
          std::copy_n(turned.block(15 - v, u, x * 4 + 3 - y), 25, to);
          rotateShAboutZ(5, -kPi / 2, std::span(to, 25));
        }
  EXPECT_LT(relativeDifference(back, here), 1e-2);
}

/// One texel and view by brute force: random paths from the sample points, no vertices and no tables.
std::vector<double> plainTwin(const PatchScene& patch, const RttSettings& s, int u, int v, const Vec3& view,
                              int paths, double albedo) {
  std::vector<double> sum(std::size_t(shCount(s.bands)), 0), y(sum.size());
  for (int i = 0; i < paths; ++i) {
    SobolStream random(99, std::uint32_t(i));
    Ray ray = viewRay(*patch.patch, (Vec2(float(u), float(v)) + random.next2()) / float(s.texels), view);
    double weight = 1;
    for (int bounce = 0; bounce <= s.bounces + 1; ++bounce) {
      const Hit hit = patch.rays->intersect(ray);
      if (!hit.valid()) {
        if (bounce == 0) break;
        shEvaluate(s.bands, DVec3(ray.direction), y);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * y[k] / paths;
        break;
      }
      const TriMesh& mesh = patch.patch->mesh;
      const UVec3& t = mesh.triangles[hit.triangle];
      const Vec3 face = normalize(mesh.areaNormal(hit.triangle));
      const Vec2 b = hit.barycentric;
      const Vec3 n =
          normalize((1 - b.x - b.y) * mesh.normals[t.x] + b.x * mesh.normals[t.y] + b.y * mesh.normals[t.z]);
      weight *= albedo;
      const Vec3 d = frameFromNormal(n).toWorld(sampleCosineHemisphere(random.next2()));
      if (dot(d, face) <= 0) break;
      ray = {offsetOrigin(patch.patch->positionAt(hit.triangle, b), face), 0, d};
    }
  }
  return sum;
}

TEST(RttBake, AgreesWithPathsTracedPlainly) {
  const PatchScene patch = sceneOf(heightField(bumps(64, 0.25f), Rgb(0.8f)));
  RttSettings settings = small(16, 4, 1024, 2);
  settings.supersamples = 8;
  Job job;
  const Rtt rtt = bakeRtt(patch, settings, job);
  double square = 0, size = 0;
  for (const auto& [u, v, view] :
       {std::array{3, 4, 5}, std::array{12, 0, 15}, std::array{7, 9, 0}, std::array{8, 15, 10}}) {
    const std::vector<double> wanted =
        plainTwin(patch, settings, u, v, ViewSquare(4).centre(view), 1 << 14, 0.8);
    for (int k = 0; k < 25; ++k) {
      const double x = double(rtt.block(u, v, view)[k]) * double(rtt.colour.x);
      square += std::pow(x - wanted[std::size_t(k)], 2),
          size += wanted[std::size_t(k)] * wanted[std::size_t(k)];
    }
  }
  EXPECT_LT(std::sqrt(square / size), 0.015);
}

TEST(RttBake, FlatGlossIsThePhongResponse) {
  Patch patch = flatPatch(Rgb(0.2f));
  patch.specular = Rgb(0.6f), patch.exponent = 8;
  RttSettings settings = small(4, 4);
  settings.lobeRays = 256;
  const Rtt rtt = baked(patch, settings);
  const GlossyResponse lobe(8, 5);
  std::vector<float> wanted(25), diffuse(25);
  lambertResponse(5, {0, 0, 1}, diffuse);
  for (int view = 0; view < 16; ++view) {
    lobe.evaluate({0, 0, 1}, ViewSquare(4).centre(view), wanted);
    double square = 0, size = 0;
    for (int k = 0; k < 25; ++k) {
      double b = 0;
      for (int t = 0; t < 16; ++t) b += double(rtt.block(t % 4, t / 4, view)[k * rtt.channels]) / 16;
      const double w = 0.6 * double(wanted[std::size_t(k)]) + 0.2 * double(diffuse[std::size_t(k)]);
      square += (b - w) * (b - w), size += w * w;
    }
    EXPECT_LT(std::sqrt(square / size), 0.01) << view;
  }
}

TEST(RttBake, ColourBleedsWhereItMust) {
  Patch patch = heightField(bumps(24, 0.3f), Rgb(1));
  for (std::size_t v = 0; v < patch.albedo.size(); ++v)
    patch.albedo[v] = patch.mesh.positions[v].z > 0.15f ? Rgb(0.9f, 0.1f, 0.1f) : Rgb(0.7f);
  const Rtt coloured = baked(patch, small(12, 2, 256, 2));
  EXPECT_EQ(coloured.channels, 3);
  // Channel by channel it is the scalar bake of that channel's albedo.
  for (const int c : {0, 1}) {
    Patch grey = patch;
    for (Rgb& a : grey.albedo) a = Rgb(a[c]);
    const Rtt scalar = baked(grey, small(12, 2, 256, 2));
    EXPECT_EQ(scalar.channels, 1);
    for (std::size_t i = 0; i < scalar.values.size(); ++i)
      ASSERT_NEAR(coloured.values[3 * i + std::size_t(c)], scalar.values[i], 1e-5);
  }
}

TEST(RttBake, OneColourBouncesAsPowersOfIt) {
  const Patch patch = heightField(bumps(24, 0.3f), Rgb(0.9f, 0.5f, 0.2f));
  const Rtt coloured = baked(patch, small(12, 2, 256, 2));
  for (const int c : {0, 2}) {
    const Rtt scalar = baked(heightField(bumps(24, 0.3f), Rgb(patch.albedo[0][c])), small(12, 2, 256, 2));
    for (std::size_t i = 0; i < scalar.values.size(); ++i)
      ASSERT_NEAR(coloured.values[3 * i + std::size_t(c)], scalar.values[i] * scalar.colour.x, 1e-5);
  }
}

TEST(RttBake, IsTheSameForAnyNumberOfThreads) {
  const Patch patch = heightField(bumps(24, 0.3f), Rgb(0.9f, 0.5f, 0.2f));
  const int before = threadCount();
  setThreadCount(1);
  const Rtt one = baked(patch, small(12, 2, 100, 2));
  setThreadCount(4);
  const Rtt four = baked(patch, small(12, 2, 100, 2));
  setThreadCount(before);
  EXPECT_EQ(one.values, four.values);
}

TEST(RttBake, HandsOutPreviewsImageByImage) {
  const PatchScene patch = sceneOf(heightField(bumps(24, 0.3f), Rgb(0.5f)));
  std::vector<std::string> phases;
  Job job([&](const Progress& p) {
    if (phases.empty() || phases.back() != p.phase) phases.push_back(p.phase);
  });
  int coarse = 0, last = 0;
  const Rtt rtt = bakeRtt(patch, small(8, 2, 512, 1), job, [&](const RttPreview& p) {
    coarse += p.coarse;
    if (p.coarse) return;
    EXPECT_EQ(p.viewsDone, ++last);
    EXPECT_EQ(p.viewsWanted, 4);
    EXPECT_NE(p.rtt.block(0, 0, p.viewsDone - 1)[0], 0);
  });
  EXPECT_EQ(coarse, 1);
  EXPECT_EQ(last, 4);
  EXPECT_EQ(phases.back(), "images of the patch");
}

TEST(RttBake, StopsWhenCancelled) {
  const PatchScene patch = sceneOf(heightField(bumps(24, 0.3f), Rgb(0.5f)));
  Job job;
  int images = 0;
  EXPECT_THROW(bakeRtt(patch, small(8, 2, 64, 1), job,
                       [&](const RttPreview& p) {
                         images = p.viewsDone;
                         if (images == 2) job.cancel();
                       }),
               Cancelled);
  EXPECT_EQ(images, 2);
}

TEST(RttBake, RefusesWhatIsOutOfRange) {
  const Patch patch = flatPatch(Rgb(0.5f));
  const auto with = [&](auto change) {
    RttSettings s = small(4, 2);
    change(s);
    return baked(patch, s);
  };
  EXPECT_THROW(with([](RttSettings& s) { s.texels = 0; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.views = 33; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.bands = 11; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.supersamples = 0; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.lobeRays = 0; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.bounces = 501; }), ValueError);
  EXPECT_THROW(with([](RttSettings& s) { s.rays = 0; }), ValueError);
}

TEST(Rtt, LooksUpTexelsAndViews) {
  Rtt rtt(4, 2, 2, 3);
  EXPECT_EQ(rtt.texelAt({0.3f, 0.99f}), (std::pair{1, 3}));
  EXPECT_EQ(rtt.texelAt({-0.1f, 2.3f}), (std::pair{3, 1}));
  rtt.colour = Rgb(1, 2, 0.5f);
  for (int view = 0; view < 4; ++view) rtt.block(1, 2, view)[0] = rtt.block(1, 2, view)[1] = float(view);
  ShRgb light(3);  // one band more than the table
  light.c[0] = Rgb(2);
  light.c[5] = Rgb(100);
  EXPECT_EQ(rtt.exitRadiance(1, 2, 3, light), Rgb(6, 12, 0));
  EXPECT_NEAR(rtt.exitRadiance(1, 2, Vec3(0, 0, 1), light).x, 3, 1e-5);  // the mean of all four
  EXPECT_EQ(rtt.array().shape, (std::vector<std::int64_t>{4, 4, 2, 2, 4, 3}));
  const Image image = previewImage(rtt, Vec3(0, 0, 1), light, 2);
  EXPECT_NEAR(image.rgb(2, 2).x, 3, 1e-5);  // texel v = 2 of 4 is the second row from the top
  EXPECT_EQ(image.width, 8);
}

}  // namespace
}  // namespace prt
