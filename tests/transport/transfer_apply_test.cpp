#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/sampling.h"
#include "libprt/transport/matrix_kernel.h"
#include "libprt/transport/transfer.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

std::vector<float> randomNumbers(std::size_t count, std::uint64_t seed) {
  std::vector<float> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = 2 * hashUniform(seed, i) - 1;
  return numbers;
}

ShRgb randomLight(int bands) {
  ShRgb light(bands);
  const std::vector<float> numbers = randomNumbers(light.c.size() * 3, 7);
  for (std::size_t k = 0; k < light.c.size(); ++k)
    light.c[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
  return light;
}

Transfer matrixTransfer(std::size_t samples, int channels, int bands, DType storage,
                        std::vector<float>& dense) {
  const auto n = std::size_t(shCount(bands));
  dense = randomNumbers(samples * n * n * std::size_t(channels), 3);
  Transfer transfer;
  transfer.form = TransferForm::Matrix;
  transfer.bands = bands, transfer.channels = channels, transfer.samples = samples;
  transfer.values = packedMatrices(dense, samples, channels, bands, storage);
  return transfer;
}

/// The definition, in double.
std::vector<DVec3> plainProduct(std::span<const float> dense, std::size_t samples, std::size_t channels,
                                std::size_t n, const ShRgb& light) {
  std::vector<DVec3> result(samples * n, DVec3(0));
  for (std::size_t s = 0; s < samples; ++s)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < std::min(n, light.c.size()); ++j)
        for (std::size_t c = 0; c < 3; ++c)
          result[s * n + i][int(c)] +=
              double(dense[((s * n + i) * n + j) * channels + (channels == 3 ? c : 0)]) * light.c[j][int(c)];
  return result;
}

double worst(std::span<const Rgb> a, std::span<const DVec3> b) {
  double most = a.size() == b.size() ? 0 : 1e30;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(DVec3(a[i]) - b[i]));
  return most;
}

TEST(TransferApply, MatricesMultiplyAsTheyShould) {
  for (const int channels : {1, 3})
    for (const int bands : {1, 2, 5, 6})
      for (const std::size_t samples : {std::size_t{1}, std::size_t{16}, std::size_t{37}, std::size_t{700}}) {
        const auto n = std::size_t(shCount(bands));
        std::vector<float> dense;
        const ShRgb light = randomLight(bands);
        const Transfer transfer = matrixTransfer(samples, channels, bands, DType::f32, dense);
        const std::vector<DVec3> expected = plainProduct(dense, samples, std::size_t(channels), n, light);
        EXPECT_LT(worst(transferredRadiance(transfer, light), expected), 1e-5)
            << channels << bands << samples;
        std::vector<Rgb> into(samples * n, Rgb(99));
        transferredRadiance(transfer, light, into);
        EXPECT_LT(worst(into, expected), 1e-5);
        // In half precision the same, of the rounded matrices.
        const Transfer half = matrixTransfer(samples, channels, bands, DType::f16, dense);
        for (float& x : dense) x = fromHalf(toHalf(x));
        EXPECT_LT(worst(transferredRadiance(half, light),
                        plainProduct(dense, samples, std::size_t(channels), n, light)),
                  1e-5);
      }
}

/// Both kernels on the same numbers, whatever this machine would choose.
TEST(TransferApply, WideAndNarrowKernelsAgree) {
  if (!wideKernelRuns()) GTEST_SKIP() << "needs AVX-512";
  for (const std::size_t channels : {1, 3})
    for (const std::size_t n : {1, 4, 9, 16, 25, 36, 49, 64, 81, 100}) {
      constexpr std::size_t kSamples = 7;
      const std::vector<float> floats = randomNumbers(kSamples * channels * n * n + kKernelOverread, 11),
                               light = randomNumbers(n * 3, 12);
      std::vector<std::uint16_t> halves(floats.size());
      toHalf(floats, halves);
      const auto result = [&](const auto& run) {
        std::vector<float> out(kSamples * n * 3 + 1, 77.0f);
        run(MatrixProduct{kSamples, channels, n, light.data(), out.data()});
        EXPECT_EQ(out.back(), 77.0f);  // nothing is written beyond
        return out;
      };
      const auto wide = result([&](const MatrixProduct&p) { multiplyMatricesWide(floats.data(), p); }),
                 narrow = result([&](const MatrixProduct&p) { multiplyMatrices(floats.data(), p); }),
                 wideHalf = result([&](const MatrixProduct&p) { multiplyMatricesWide(halves.data(), p); }),
                 narrowHalf = result([&](const MatrixProduct&p) { multiplyMatrices(halves.data(), p); });
      for (std::size_t i = 0; i < wide.size(); ++i) {
        EXPECT_NEAR(wide[i], narrow[i], 1e-5f);
        EXPECT_NEAR(wideHalf[i], narrowHalf[i], 1e-5f);
        EXPECT_NEAR(wideHalf[i], wide[i], 2e-3f * std::sqrt(float(n)));
      }
    }
}

TEST(TransferApply, ExpandingUndoesThePacking) {
  for (const int channels : {1, 3}) {
    std::vector<float> dense;
    const Transfer transfer = matrixTransfer(37, channels, 3, DType::f32, dense);
    const Array expanded = expandedMatrices(transfer);
    EXPECT_TRUE(std::ranges::equal(expanded.as<float>(), dense));
    EXPECT_EQ(expanded.shape.size(), channels == 3 ? 4u : 3u);
    EXPECT_EQ(transfer.values.shape, (std::vector<std::int64_t>{37, channels, 9, 9}));
  }
}

TEST(TransferApply, VisibilityActsAsItsExpandedMatrix) {
  for (const int bands : {1, 3, 5, 6}) {
    const auto n = std::size_t(shCount(bands)), wide = std::size_t(shCount(2 * bands - 1));
    Transfer transfer;
    transfer.form = TransferForm::Visibility;
    transfer.bands = bands, transfer.samples = 300;
    transfer.values =
        Array::from(std::span<const float>(randomNumbers(300 * wide, 5)), {300, std::int64_t(wide)});
    const ShRgb light = randomLight(bands);
    const Array expanded = expandedMatrices(transfer);
    EXPECT_LT(
        worst(transferredRadiance(transfer, light), plainProduct(expanded.as<float>(), 300, 1, n, light)),
        2e-5)
        << bands;
  }
}

TEST(TransferApply, WithoutTransferLightArrivesUnchanged) {
  Transfer none;
  none.bands = 4, none.samples = 3;
  const ShRgb light = randomLight(4);
  const std::vector<Rgb> result = transferredRadiance(none, light);
  for (std::size_t i = 0; i < result.size(); ++i) EXPECT_EQ(result[i], light.c[i % 16]);
  EXPECT_LT(worst(result, plainProduct(expandedMatrices(none).as<float>(), 3, 1, 16, light)), 1e-7);
}

/// Unshadowed irradiance: what an open body bakes.
TEST(TransferApply, UnshadowedIrradianceIsThatOfAnOpenBody) {
  const test::BakeInput input(test::deformed(test::sphere(8, 16), [](const Vec3& p) { return p; }));
  for (const int bands : {1, 2, 5, 9}) {
    TransferSettings baked, open;
    baked.bands = open.bands = bands;
    baked.rays = 64, baked.bounces = 0, open.shadows = false;
    const ShRgb light = randomLight(bands);
    const std::vector<Rgb> a = irradiance(input.transfer(baked), light, input.samples->shadingNormal);
    const std::vector<Rgb> b = irradiance(input.transfer(open), light, input.samples->shadingNormal);
    EXPECT_LT(worst(a, std::vector<DVec3>(b.begin(), b.end())), 3e-4) << bands;
  }
  Transfer none;
  none.samples = 4;
  EXPECT_THROW(irradiance(none, randomLight(5), std::vector<Vec3>(3)), ValueError);
}

TEST(TransferApply, VectorsMultiplyAsTheyShould) {
  for (const int channels : {1, 3}) {
    const std::vector<float> e = randomNumbers(50 * 25 * std::size_t(channels), 4);
    const ShRgb light = randomLight(5);
    Transfer transfer;
    transfer.form = TransferForm::Diffuse;
    transfer.channels = channels, transfer.samples = 50;
    transfer.values =
        Array::from(std::span<const float>(e),
                    channels == 3 ? std::vector<std::int64_t>{50, 25, 3} : std::vector<std::int64_t>{50, 25});
    std::vector<DVec3> expected(50, DVec3(0));
    for (std::size_t i = 0; i < 50 * 25; ++i)
      for (int c = 0; c < 3; ++c)
        expected[i / 25][c] +=
            double(e[i * std::size_t(channels) + (channels == 3 ? std::size_t(c) : 0)]) * light.c[i % 25][c];
    EXPECT_LT(worst(irradiance(transfer, light, {}), expected), 1e-5);
    transfer.form = TransferForm::Matrix;  // whose vectors lie beside
    transfer.diffuse = transfer.values;
    EXPECT_LT(worst(irradiance(transfer, light, {}), expected), 1e-5);
    EXPECT_TRUE(std::ranges::equal(diffuseVectors(transfer).as<float>(), e));
    transfer.form = TransferForm::Diffuse;
    EXPECT_THROW(transferredRadiance(transfer, light), ValueError);
    EXPECT_THROW(expandedMatrices(transfer), ValueError);
  }
}

TEST(TransferApply, SomeSamplesOnlyAreTheSameNumbers) {
  const test::BakeInput input(test::rock(20));
  const std::vector<std::uint32_t> some{5, 77, 3, 3, 100, 18, 17, 16};
  const ShRgb light = randomLight(5);
  for (const TransferForm form :
       {TransferForm::None, TransferForm::Diffuse, TransferForm::Visibility, TransferForm::Matrix}) {
    TransferSettings s;
    s.form = form, s.rays = 64, s.bounces = form == TransferForm::Matrix ? 1 : 0,
    s.shadows = form != TransferForm::None;
    const Transfer transfer = input.transfer(s);
    const std::vector<Rgb> all = irradiance(transfer, light, input.samples->shadingNormal),
                           few = irradiance(transfer, light, input.samples->shadingNormal, some);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(few[i], all[some[i]]);
    EXPECT_THROW(irradiance(transfer, light, input.samples->shadingNormal, std::vector<std::uint32_t>{99999}),
                 ValueError);
    if (form == TransferForm::Diffuse) continue;
    const std::vector<Rgb> allRadiance = transferredRadiance(transfer, light),
                           fewRadiance = transferredRadiance(transfer, light, some);
    for (std::size_t i = 0; i < fewRadiance.size(); ++i)
      EXPECT_EQ(fewRadiance[i], allRadiance[some[i / 25] * 25 + i % 25]);
  }
}

TEST(TransferApply, LightsOfOtherBandsAreCutOrFilledWithZeros) {
  std::vector<float> dense;
  const Transfer transfer = matrixTransfer(20, 1, 4, DType::f32, dense);
  for (const int bands : {2, 7}) {
    const ShRgb light = randomLight(bands);
    EXPECT_LT(worst(transferredRadiance(transfer, light), plainProduct(dense, 20, 1, 16, light)), 1e-5);
  }
}

TEST(TransferApply, ResultsOfTheWrongSizeAreRefused) {
  std::vector<float> dense;
  const Transfer transfer = matrixTransfer(20, 1, 2, DType::f32, dense);
  std::vector<Rgb> small(79);
  EXPECT_THROW(transferredRadiance(transfer, randomLight(2), small), ValueError);
  EXPECT_THROW(packedMatrices(dense, 19, 1, 2, DType::f32), ValueError);
  EXPECT_THROW(packedMatrices(dense, 20, 1, 2, DType::u8), ValueError);
}

}  // namespace
}  // namespace prt
