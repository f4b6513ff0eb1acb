#include "libprt/light/light_sampler.h"
#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"
#include "tests/light/light_test_support.h"
#include "tests/support/chi_square.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using M = EnvironmentMapping;
using test::oneOfEach;
using test::randomMap;

Vec2 randomPoint(std::uint64_t i) {
  return {hashUniform(7, i, 0), hashUniform(7, i, 1)};
}

std::shared_ptr<const EnvironmentMap> share(EnvironmentMap map) {
  return std::make_shared<const EnvironmentMap>(std::move(map));
}

/// A map, a disc inside another, and a glow from everywhere.
LightRig everything(const MapGeometry& g) {
  LightRig rig;
  rig.environment = share(randomMap(g, 21, 30));
  rig.rotation = 0.7f;
  rig.intensity = 0.5f;
  rig.circles = {{normalize(Vec3(1, 1, 0)), 0.8f, Rgb(2, 1, 1)},
                 {normalize(Vec3(1, 0.9f, 0.1f)), 0.3f, Rgb(5)}};
  rig.constant = Rgb(0.3f, 0.2f, 0.1f);
  return rig;
}

TEST(LightSampler, TexelsAreChosenByTheirPower) {
  constexpr int kSamples = 200'000;
  for (const MapGeometry& g : oneOfEach(8)) {
    LightRig rig;
    rig.environment = share(randomMap(g, 20, 100));
    rig.rotation = 1.1f;
    const LightSampler sampler(rig);
    const Mat3 toMap = transpose(environmentRotation(rig.rotation));
    std::vector<double> probability(std::size_t(g.width() * g.height()), 0.0);
    double total = 0;
    rig.environment->forEachTexel([&](int x, int y, const DVec3&, double solidAngle, const Rgb& c) {
      total += probability[std::size_t(y * g.width() + x)] = solidAngle * luminance(c);
    });
    for (double& p : probability) p /= total;
    std::vector<int> counts(probability.size(), 0);
    int lost = 0;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      const LightSample sample = sampler.sample(randomPoint(i));
      if (sample.pdf == 0) {
        ++lost;
        continue;
      }
      const Vec2 p = g.toImage(toMap * sample.direction);
      ++counts[std::size_t(int(p.y) * g.width() + int(p.x))];
    }
    EXPECT_LT(lost, 5) << toString(g.mapping()) << ": only rounding at a rim may lose a sample";
    EXPECT_LT(test::chiSquareDeviation(counts, probability), 4) << toString(g.mapping());
  }
}

TEST(LightSampler, SamplesFollowTheDensity) {
  constexpr int kRows = 16, kColumns = 32, kSub = 40, kSamples = 300'000;
  for (const MapGeometry& g : oneOfEach(4)) {
    const LightSampler sampler(everything(g));
    std::vector<double> probability(kRows * kColumns, 0.0);
    double total = 0;
    for (int r = 0; r < kRows * kSub; ++r)
      for (int c = 0; c < kColumns * kSub; ++c) {
        const double z = -1 + 2 * (r + 0.5) / (kRows * kSub), a = 2 * kPi * (c + 0.5) / (kColumns * kSub);
        const double s = std::sqrt(1 - z * z);
        const Vec3 d(float(s * std::cos(a)), float(s * std::sin(a)), float(z));
        const double p = sampler.pdf(d) * 4 * kPi / (double(kRows) * kColumns * kSub * kSub);
        probability[std::size_t(r / kSub * kColumns + c / kSub)] += p;
        total += p;
      }
    EXPECT_NEAR(total, 1, 2e-3) << toString(g.mapping());
    std::vector<int> counts(probability.size(), 0);
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      const LightSample sample = sampler.sample(randomPoint(i));
      if (sample.pdf == 0) continue;
      const int row = std::min(kRows - 1, int((sample.direction.z + 1) / 2 * kRows));
      const int column =
          std::min(kColumns - 1, int(turnsOf(sample.direction.x, sample.direction.y) * kColumns));
      ++counts[std::size_t(row * kColumns + column)];
    }
    EXPECT_LT(test::chiSquareDeviation(counts, probability), 4) << toString(g.mapping());
  }
}

TEST(LightSampler, SampleDensityAndRadianceAreTheSameFunctions) {
  for (const MapGeometry& g : oneOfEach(6)) {
    const LightRig rig = everything(g);
    const LightSampler sampler(rig);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      const LightSample sample = sampler.sample(randomPoint(i));
      if (sample.pdf == 0) continue;
      ASSERT_NEAR(length(sample.direction), 1, 1e-6);
      EXPECT_EQ(sample.pdf, sampler.pdf(sample.direction));
      EXPECT_EQ(sample.radiance, radiance(rig, sample.direction));
      EXPECT_EQ(sample.radiance, sampler.radiance(sample.direction));
    }
  }
}

TEST(LightSampler, MeanOfRadianceOverDensityIsTheLightsEnergy) {
  for (const MapGeometry& g : oneOfEach(6)) {
    const LightRig rig = everything(g);
    DVec3 exact = double(rig.intensity) * test::energy(*rig.environment) + 4 * kPi * DVec3(rig.constant);
    for (const CircleLight& light : rig.circles) exact += solidAngle(light) * DVec3(light.radiance);
    const LightSampler sampler(rig);
    DVec3 sum(0);
    constexpr int n = 1 << 16;
    for (std::uint32_t i = 0; i < n; ++i) {
      const LightSample sample = sampler.sample(sobol2(i, 0, 5));
      if (sample.pdf > 0) sum += DVec3(sample.radiance) / double(sample.pdf) / double(n);
    }
    EXPECT_LT(length(sum / exact - DVec3(1)), 3e-3) << toString(g.mapping());
  }
}

TEST(LightSampler, IsPerfectForGreyDiscs) {
  // The density is the radiance over the total: every sample has the same weight, overlaps included.
  LightRig rig;
  rig.circles = {{Vec3(0, 1, 0), 0.5f, Rgb(3)}, {normalize(Vec3(0.2f, 1, 0)), 0.6f, Rgb(1)}};
  rig.constant = Rgb(0.25f);
  const LightSampler sampler(rig);
  const double total = solidAngle(rig.circles[0]) * 3 + solidAngle(rig.circles[1]) + kPi;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const LightSample sample = sampler.sample(randomPoint(i));
    EXPECT_NEAR(sample.radiance.x / sample.pdf / total, 1, 1e-5);
  }
}

TEST(LightSampler, TheSunsDiscIsSampledExactly) {
  LightRig rig;
  rig.circles = {{normalize(Vec3(1, 2, -0.5f)), float(radians(0.2665)), Rgb(1)}};
  EXPECT_NEAR(solidAngle(rig.circles[0]) / 6.7967e-5, 1, 1e-4);
  const LightSampler sampler(rig);
  int missed = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const LightSample sample = sampler.sample(randomPoint(i));
    if (sample.pdf == 0)
      ++missed;
    else
      EXPECT_NEAR(sample.pdf * solidAngle(rig.circles[0]), 1, 1e-5);
  }
  EXPECT_LT(missed, 20) << "only rounding at the disc's edge may miss it";
}

TEST(LightSampler, EvenTheDimmestTexelCanBeChosenBesideASun) {
  const MapGeometry g(M::LatLong, 64, 32);
  LightRig rig;
  rig.environment = share(test::mapOf(g, [&](const DVec3& d) { return Rgb(d.y > 0.99 ? 1e9f : 1e-3f); }));
  const LightSampler sampler(rig);
  rig.environment->forEachTexel(
      [&](int, int, const DVec3& d, double, const Rgb&) { EXPECT_GT(sampler.pdf(Vec3(d)), 0); });
}

TEST(LightSampler, EdgesOfTheUnitSquareGiveDirectionsToo) {
  const LightSampler sampler(everything(MapGeometry(M::LatLong, 8, 4)));
  const float last = std::nextafter(1.0f, 0.0f);
  for (const float u : {0.0f, 0.5f, last})
    for (const float v : {0.0f, last}) {
      const LightSample sample = sampler.sample({u, v});
      EXPECT_TRUE(isFinite(sample.direction));
      EXPECT_TRUE(std::isfinite(sample.pdf));
    }
}

TEST(LightSampler, WithoutLightThereAreNoSamples) {
  LightRig dark;
  dark.environment = share(test::mapOf(MapGeometry(M::LatLong, 4, 2), [](const DVec3&) { return Rgb(0); }));
  dark.directionals = {{Vec3(0, 1, 0), Rgb(1)}};
  const LightSampler sampler(dark);
  EXPECT_FALSE(sampler.shines());
  EXPECT_EQ(sampler.sample({0.5f, 0.5f}).pdf, 0);
  EXPECT_EQ(sampler.pdf({0, 1, 0}), 0);
  EXPECT_EQ(sampler.directionals().size(), 1u);
}

}  // namespace
}  // namespace prt
