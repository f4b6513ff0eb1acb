#include "libprt/material/bsdf.h"
#include "libprt/basis/quadrature.h"
#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"
#include "tests/support/chi_square.h"

#include <gtest/gtest.h>

#include <vector>

namespace prt {
namespace {

Material lambert() {
  return {.name = "lambert", .albedo = Rgb(0.8f, 0.5f, 0.2f)};
}

Material phong(float exponent, Rgb specular = Rgb(1), Rgb albedo = Rgb(0)) {
  return {.name = "phong",
          .model = MaterialModel::Phong,
          .albedo = albedo,
          .specular = specular,
          .exponent = exponent};
}

Material mixture(float exponent) {
  return phong(exponent, Rgb(0.4f, 0.3f, 0.2f), Rgb(0.5f, 0.4f, 0.3f));
}

Vec3 view(double angle, double azimuth = 0.4) {
  return {float(std::sin(angle) * std::cos(azimuth)), float(std::sin(angle) * std::sin(azimuth)),
          float(std::cos(angle))};
}

/// Plain integral of a colour over the sphere: cells between circles of latitude about +z and meridians.
template <class F>
DVec3 overSphere(F&& f) {
  const int rows = 600, columns = 1200;
  DVec3 sum(0);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double polar = kPi * (r + 0.5) / rows, a = 2 * kPi * (c + 0.5) / columns, s = std::sin(polar);
      sum += s * DVec3(f(Vec3(float(s * std::cos(a)), float(s * std::sin(a)), float(std::cos(polar)))));
    }
  return sum * (2 * std::sin(0.5 * kPi / rows) * 2 * kPi / columns);
}

TEST(Bsdf, IsReciprocal) {
  for (const Material& m : {lambert(), phong(5), mixture(40), mixture(2000)})
    for (int i = 0; i < 2000; ++i) {
      const Vec3 in = sampleUniformHemisphere(sobol2(std::uint32_t(i), 0, 1)),
                 out = sampleUniformHemisphere(sobol2(std::uint32_t(i), 2, 1));
      const Rgb f = evalBrdf(m, in, out), g = evalBrdf(m, out, in);
      EXPECT_LE(length(f - g), 2e-6f * length(f) + 1e-7f) << m.exponent;
    }
}

TEST(Bsdf, HasTheTextbookValues) {
  const Vec3 out = view(0.6), straight = Vec3(-out.x, -out.y, out.z);
  EXPECT_NEAR(evalBrdf(lambert(), view(1.2, 2), out).x, 0.8 / kPi, 1e-7);
  EXPECT_NEAR(evalBrdf(phong(30), straight, out).x, 32 / (2 * kPi), 1e-5);
  // 0.1 radians beside the mirror direction
  EXPECT_NEAR(evalBrdf(phong(30), view(0.7, 0.4 + kPi), out).x, 32 / (2 * kPi) * std::pow(std::cos(0.1), 30),
              1e-4);
  EXPECT_NEAR(evalBrdf(phong(1e4f), view(0.61, 0.4 + kPi), out).x,
              10002 / (2 * kPi) * std::pow(std::cos(0.01), 1e4), 1.0);
}

TEST(Bsdf, IsBlackBelowTheSurface) {
  for (const Material& m : {lambert(), phong(8), mixture(8)}) {
    EXPECT_EQ(evalBrdf(m, view(2.0), view(0.3)), Rgb(0));
    EXPECT_EQ(evalBrdf(m, view(0.3), view(2.0)), Rgb(0));
    EXPECT_EQ(sampleBrdf(m, view(2.0), {0.3f, 0.4f}, 0.5f).pdf, 0);
    EXPECT_EQ(pdfBrdf(m, view(2.3), view(2.0)), 0);
    EXPECT_EQ(directionalAlbedo(m, view(2.0)), Rgb(0));
  }
}

TEST(Bsdf, TwoSidedMirrorsTheBackOntoTheFront) {
  Material m = mixture(20);
  m.twoSided = true;
  const auto down = [](const Vec3& v) { return Vec3(v.x, v.y, -v.z); };
  const Vec3 in = view(0.5, 3), out = view(0.8);
  EXPECT_EQ(evalBrdf(m, down(in), down(out)), evalBrdf(m, in, out));
  EXPECT_EQ(evalBrdf(m, in, down(out)), Rgb(0));
  EXPECT_EQ(pdfBrdf(m, down(in), down(out)), pdfBrdf(m, in, out));
  EXPECT_EQ(directionalAlbedo(m, down(out)), directionalAlbedo(m, out));
  const BrdfSample above = sampleBrdf(m, out, {0.2f, 0.7f}, 0.1f),
                   below = sampleBrdf(m, down(out), {0.2f, 0.7f}, 0.1f);
  EXPECT_EQ(below.in, down(above.in));
  EXPECT_EQ(below.weight, above.weight);
}

TEST(Bsdf, AlbedoMatchesAPlainIntegral) {
  for (const Material& m : {lambert(), phong(1), phong(10), mixture(60)})
    for (const double angle : {0.0, 0.5, 1.0, 1.4, 1.55}) {
      const Vec3 out = view(angle);
      const DVec3 plain =
          overSphere([&](const Vec3& in) { return evalBrdf(m, in, out) * std::max(0.0f, in.z); });
      const Rgb albedo = directionalAlbedo(m, out);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(albedo[c], plain[c], 5e-5) << m.exponent << " at " << angle;
    }
}

TEST(Bsdf, AlbedoIsSpecularAtNormalIncidenceAndNeverMore) {
  for (const float s : {1.0f, 2.5f, 8.0f, 50.0f, 700.0f, 10000.0f}) {
    EXPECT_NEAR(directionalAlbedo(phong(s), view(0)).x, 1, 2e-6) << s;
    float last = 2;
    for (int i = 0; i <= 60; ++i) {
      const float albedo = directionalAlbedo(phong(s), view(i * kPi / 120.0)).x;
      EXPECT_LE(albedo, 1 + 2e-6f) << s;
      EXPECT_LE(albedo, last + 2e-6f) << s << ": it darkens towards grazing";
      last = albedo;
    }
  }
  // values of ALGORITHMS section 4
  EXPECT_NEAR(directionalAlbedo(phong(8), view(kPi / 6)).x, 0.87, 0.005);
  EXPECT_NEAR(directionalAlbedo(phong(10000), view(kPi / 3)).x, 0.5, 0.001);
}

TEST(Bsdf, DensityIntegratesToOne) {
  for (const Material& m : {lambert(), phong(1), phong(20), mixture(50)})
    for (const double angle : {0.0, 0.7, 1.5}) {
      const DVec3 sum = overSphere([&](const Vec3& in) { return Vec3(pdfBrdf(m, in, view(angle))); });
      EXPECT_NEAR(sum.x, 1, 5e-5) << m.exponent << " at " << angle;
    }
}

TEST(Bsdf, SamplesFollowTheirDensity) {
  constexpr int kRows = 20, kColumns = 20, kSamples = 200'000, kSub = 24;
  for (const Material& m : {lambert(), phong(3), phong(60), mixture(25)})
    for (const double angle : {0.3, 1.3}) {
      const Vec3 out = view(angle);
      std::vector<double> probability(kRows * kColumns, 0.0);
      for (int r = 0; r < kRows * kSub; ++r)
        for (int c = 0; c < kColumns * kSub; ++c) {
          const double z = -1 + 2 * (r + 0.5) / (kRows * kSub), a = 2 * kPi * (c + 0.5) / (kColumns * kSub),
                       s = std::sqrt(1 - z * z);
          probability[std::size_t(r / kSub * kColumns + c / kSub)] +=
              double(pdfBrdf(m, Vec3(float(s * std::cos(a)), float(s * std::sin(a)), float(z)), out)) * 4 *
              kPi / (double(kRows) * kColumns * kSub * kSub);
        }
      std::vector<int> counts(probability.size(), 0);
      for (std::uint64_t i = 0; i < kSamples; ++i) {
        const BrdfSample sample =
            sampleBrdf(m, out, {hashUniform(1, i, 0), hashUniform(1, i, 1)}, hashUniform(1, i, 2));
        const int row = std::min(kRows - 1, int((sample.in.z + 1) / 2 * kRows));
        const int column = std::min(kColumns - 1, int(turnsOf(sample.in.x, sample.in.y) * kColumns));
        ++counts[std::size_t(row * kColumns + column)];
      }
      EXPECT_LT(test::chiSquareDeviation(counts, probability), 4) << m.exponent << " at " << angle;
    }
}

TEST(Bsdf, SampleWeightIsItsOwnEvaluation) {
  for (const Material& m : {lambert(), phong(1), mixture(30), mixture(10000)})
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const Vec3 out = sampleUniformHemisphere(sobol2(i, 0, 2));
      const BrdfSample sample = sampleBrdf(m, out, sobol2(i, 2, 2), sobol(i, 4, 2));
      ASSERT_NEAR(length(sample.in), 1, 1e-6);
      ASSERT_GT(sample.pdf, 0);
      EXPECT_EQ(sample.pdf, pdfBrdf(m, sample.in, out));
      if (sample.in.z > 0) {
        EXPECT_LT(length(sample.weight * sample.pdf - evalBrdf(m, sample.in, out) * sample.in.z),
                  1e-5f * sample.pdf);
      } else {
        EXPECT_EQ(sample.weight, Rgb(0));
      }
      EXPECT_LE(std::max(sample.weight.x, sample.weight.y), 2.1f) << "the density must follow f cos";
    }
}

TEST(Bsdf, MeanWeightIsTheAlbedo) {
  for (const Material& m : {lambert(), phong(1), phong(300), mixture(30), mixture(10000)})
    for (const double angle : {0.0, 0.9, 1.5}) {
      Rgb sum(0);
      constexpr int n = 1 << 14;
      for (std::uint32_t i = 0; i < n; ++i)
        sum += sampleBrdf(m, view(angle), sobol2(i, 0, 3), sobol(i, 2, 3)).weight / float(n);
      EXPECT_LT(length(sum - directionalAlbedo(m, view(angle))), 3e-3f) << m.exponent << " at " << angle;
    }
}

TEST(Bsdf, ABlackMaterialReflectsNothing) {
  const Material black{.model = MaterialModel::Phong, .albedo = Rgb(0), .specular = Rgb(0)};
  EXPECT_EQ(sampleBrdf(black, view(0.2), {0.5f, 0.5f}, 0.5f).pdf, 0);
  EXPECT_EQ(evalBrdf(black, view(0.2), view(0.2)), Rgb(0));
}

}  // namespace
}  // namespace prt
