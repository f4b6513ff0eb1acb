#include "libprt/material/glossy_response.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"
#include "libprt/material/bsdf.h"

#include <gtest/gtest.h>

#include <vector>

namespace prt {
namespace {

Material phong(float exponent, Rgb specular = Rgb(1), Rgb albedo = Rgb(0)) {
  return {.model = MaterialModel::Phong, .albedo = albedo, .specular = specular, .exponent = exponent};
}

Vec3 view(double angle) {
  return {float(std::sin(angle)), 0, float(std::cos(angle))};
}

/// The definition: a plain sum over a fine polar grid about the mirror direction, where the lobe is.
std::vector<double> plainResponse(double exponent, double angle, int bands) {
  const int rings = 1500, turns = 600;
  const DVec3 axis(-std::sin(angle), 0, std::cos(angle)), side(std::cos(angle), 0, std::sin(angle)),
      up(0, 1, 0);
  const double end = std::min(kPi / 2, 8 / std::sqrt(exponent));
  std::vector<double> sum(std::size_t(shCount(bands)), 0.0), y(sum.size());
  for (int r = 0; r < rings; ++r)
    for (int t = 0; t < turns; ++t) {
      const double off = end * (r + 0.5) / rings, turn = 2 * kPi * (t + 0.5) / turns;
      const DVec3 in = std::cos(off) * axis + std::sin(off) * (std::cos(turn) * side + std::sin(turn) * up);
      if (in.z <= 0) continue;
      shEvaluate(bands, in, y);
      const double f = (exponent + 2) / (2 * kPi) * std::pow(std::cos(off), exponent);
      const double area = std::sin(off) * (end / rings) * (2 * kPi / turns);
      for (std::size_t k = 0; k < y.size(); ++k) sum[k] += f * in.z * area * y[k];
    }
  return sum;
}

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(GlossyResponse, QuadratureMatchesAPlainSum) {
  for (const double s : {1.0, 3.5, 40.0, 10000.0})
    for (const double angle : {0.0, 0.4, 1.2, 1.5, kPi / 2}) {
      // the plain sum treats rings that the horizon cuts as all or nothing per cell
      EXPECT_LT(distance(phongResponse(s, angle, 6), plainResponse(s, angle, 6)), 2e-5)
          << s << " at " << angle;
    }
}

TEST(GlossyResponse, ANarrowLobeIsAMirrorOfTheCosine) {
  for (const double angle : {0.0, 0.5, 1.1}) {
    const std::vector<double> response = phongResponse(10000, angle, 5);
    std::vector<double> y(25);
    shEvaluate(5, DVec3(-std::sin(angle), 0, std::cos(angle)), y);
    for (double& value : y) value *= std::cos(angle);
    EXPECT_LT(distance(response, y), 2e-3);
  }
}

TEST(GlossyResponse, OnlyFunctionsEvenAboutTheViewingPlaneRespond) {
  const std::vector<double> response = phongResponse(20, 0.8, 5);
  for (int l = 0; l < 5; ++l)
    for (int m = 1; m <= l; ++m) EXPECT_EQ(response[std::size_t(shIndex(l, -m))], 0);
}

TEST(GlossyResponse, TheTableFollowsTheQuadrature) {
  for (const int bands : {1, 2, 5, 10})
    for (const float s : {1.0f, 20.0f, 300.0f, 10000.0f}) {
      const GlossyResponse table(s, bands);
      std::vector<float> values(std::size_t(shCount(bands)));
      for (int i = 0; i <= 300; ++i) {
        const double angle = kPi / 2 * i / 300;
        const std::vector<double> exact = phongResponse(s, angle, bands);
        table.evaluate({0, 0, 1}, view(angle), values);
        const std::vector<double> got(values.begin(), values.end());
        const std::vector<double> zero(exact.size(), 0.0);
        EXPECT_LT(distance(got, exact), (bands <= 5 ? 3e-4 : 8e-4) * distance(exact, zero))
            << bands << " bands, exponent " << s << ", angle " << angle;
      }
    }
}

TEST(GlossyResponse, InAnyFrameItIsTheIntegralOfTheBrdf) {
  const SphereRule rule = sphereRule(300);
  std::vector<float> response(25);
  std::vector<double> y(25);
  const Material m = phong(12);
  const GlossyResponse table(m.exponent, 5);
  for (std::uint32_t i = 0; i < 12; ++i) {
    const Vec3 normal = sampleUniformSphere(sobol2(i, 0, 1));
    const Frame frame = frameFromNormal(normal);
    const Vec3 out = frame.toWorld(sampleUniformHemisphere(sobol2(i, 2, 1)));
    std::vector<double> plain(25, 0.0);
    for (std::size_t k = 0; k < rule.directions.size(); ++k) {
      const Vec3 in(rule.directions[k]);
      const double f = evalBrdf(m, frame.toLocal(in), frame.toLocal(out)).x * std::max(0.0f, dot(in, normal));
      if (f == 0) continue;
      shEvaluate(5, rule.directions[k], y);
      for (std::size_t j = 0; j < 25; ++j) plain[j] += rule.weights[k] * f * y[j];
    }
    table.evaluate(normal, out, response);
    EXPECT_LT(distance(std::vector<double>(response.begin(), response.end()), plain), 3e-4) << i;
  }
}

TEST(GlossyResponse, LambertHasItsGoldenNumbers) {
  std::vector<float> response(25);
  lambertResponse(5, {0, 0, 1}, response);
  const std::vector<double> golden{0.282095, 0.325735, 0.157696, 0, -0.035262};
  for (int l = 0; l < 5; ++l)
    for (int k = -l; k <= l; ++k)
      EXPECT_NEAR(response[std::size_t(shIndex(l, k))], k == 0 ? golden[std::size_t(l)] : 0, 1e-6);
}

TEST(GlossyResponse, UnderAConstantSkyExitRadianceIsTheAlbedo) {
  const Material m = phong(25, {0.4f, 0.3f, 0.2f}, {0.5f, 0.4f, 0.3f});
  const GlossyResponse glossy(m.exponent, 5);
  std::vector<Rgb> sky(25, Rgb(0));
  sky[0] = Rgb(float(std::sqrt(4 * kPi)));
  const Vec3 normal = normalize(Vec3(0.3f, -0.7f, 0.5f));
  for (const double angle : {0.0, 0.8, 1.5}) {
    const Vec3 out = frameFromNormal(normal).toWorld(view(angle));
    EXPECT_LT(length(exitRadiance(m, &glossy, normal, out, sky) - directionalAlbedo(m, view(angle))), 1e-4f);
  }
}

TEST(GlossyResponse, AMatteMaterialNeedsNoTable) {
  const Material matte{.albedo = Rgb(0.6f)};
  std::vector<Rgb> sky(9, Rgb(0));
  sky[0] = Rgb(float(std::sqrt(4 * kPi)));
  EXPECT_NEAR(exitRadiance(matte, nullptr, {0, 1, 0}, {0, 1, 0}, sky).x, 0.6, 1e-6);
}

TEST(GlossyResponse, ViewsBelowTheHorizonCountAsOnIt) {
  const GlossyResponse table(50, 5);
  std::vector<float> on(25), below(25), straight(25);
  table.evaluate({0, 0, 1}, view(kPi / 2), on);
  table.evaluate({0, 0, 1}, view(2.2), below);
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(below[k], on[k], 1e-6);
  table.evaluate({0, 0, 1}, {0, 0, -1}, straight);
  for (const float value : straight) EXPECT_TRUE(std::isfinite(value));
}

TEST(GlossyResponse, RefusesWhatItCannotDo) {
  EXPECT_THROW(GlossyResponse(0.5f, 5), ValueError);
  EXPECT_THROW(GlossyResponse(20000, 5), ValueError);
  EXPECT_THROW(GlossyResponse(std::numeric_limits<float>::quiet_NaN(), 5), ValueError);
  EXPECT_THROW(GlossyResponse(10, 17), ValueError);
}

TEST(GlossyResponse, IsTheSameForAnyNumberOfThreads) {
  std::vector<float> one(25), three(25);
  setThreadCount(1);
  GlossyResponse(40, 5).evaluate({0, 0, 1}, view(0.7), one);
  setThreadCount(3);
  GlossyResponse(40, 5).evaluate({0, 0, 1}, view(0.7), three);
  setThreadCount(0);
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace prt
