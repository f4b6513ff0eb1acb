#include "libprt/transport/cluster_transfer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "tests/transport/bake_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::BakeInput;
using test::lobeLight;
using test::rock;

/// A rock's matrices with a bounce.
const Transfer& dense() {
  static const Transfer transfer = [] {
    TransferSettings s;
    s.rays = 1024, s.bounces = 1, s.form = TransferForm::Matrix, s.storage = DType::f16;
    return BakeInput(rock(90), Rgb(0.7f, 0.6f, 0.5f)).transfer(s);
  }();
  return transfer;
}

Transfer clustered(double budget, int clusters = 0) {
  Job job;
  auto made = clusteredTransfer(dense(), {.budget = budget, .clusters = clusters}, job);
  EXPECT_TRUE(made);
  return made.value_or(Transfer{});
}

double distanceOf(const Transfer& a, const Transfer& b) {
  const Array x = expandedMatrices(a), y = expandedMatrices(b);
  EXPECT_EQ(x.shape, y.shape);
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = double(x.as<float>()[i]) - double(y.as<float>()[i]);
    difference += d * d, norm += double(y.as<float>()[i]) * double(y.as<float>()[i]);
  }
  return std::sqrt(difference / norm);
}

TEST(ClusteredTransfer, KeepsItsBudgetAndSaysWhatItMissed) {
  std::size_t before = 0;
  for (const double budget : {0.04, 0.07, 0.15}) {
    const Transfer few = clustered(budget);
    EXPECT_TRUE(few.clustered());
    const double error = distanceOf(few, dense());
    EXPECT_LT(error, 1.02 * budget);  // and the halfs of the weights
    EXPECT_NEAR(std::hypot(error, dense().storageError), few.storageError, 0.02 * few.storageError);
    EXPECT_LT(2 * few.bytes(), dense().bytes());
    if (before > 0) {
      EXPECT_LE(few.bytes(), before) << "the more may be missed the less is kept";
    }
    before = few.bytes();
    EXPECT_EQ(few.diffuse.bytes, dense().diffuse.bytes);
    EXPECT_EQ(few.surface.bytes, dense().surface.bytes);
  }
}

TEST(ClusteredTransfer, IsAppliedAsTheMatricesThatItStandsFor) {
  const Transfer few = clustered(0.05, 7);
  const ShRgb light = lobeLight({0.3f, 0.8f, 0.5f});
  const std::vector<Rgb> fast = transferredRadiance(few, light);
  const auto n = std::size_t(few.functions());
  std::vector<float> matrix(3 * n * n);
  for (std::size_t s = 0; s < few.samples; s += 5) {
    matrixOf(few, s, matrix);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k)
          sum += double(matrix[(c * n + k) * n + i]) * double(light.c[k][int(c)]);
        ASSERT_NEAR(double(fast[s * n + i][int(c)]), sum, 2e-5) << s;
      }
  }
  const std::vector<std::uint32_t> some{3, 4, 5, 17, std::uint32_t(few.samples - 1)};
  const std::vector<Rgb> selected = transferredRadiance(few, light, some);
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t k = 0; k < n; ++k) ASSERT_EQ(selected[i * n + k], fast[some[i] * n + k]);
  // Dense matrices are handed out by the same function.
  matrixOf(dense(), 11, matrix);
  const Array all = expandedMatrices(dense());
  EXPECT_EQ(matrix[(2 * n + 4) * n + 9], all.as<float>()[((11 * n + 9) * n + 4) * 3 + 2]);
}

TEST(ClusteredTransfer, LightIsOffByAboutTheError) {
  const Transfer few = clustered(0.04);
  double worst = 0;
  for (const Vec3& d : {Vec3(1, 0.2f, 0), Vec3(0, 1, 0), Vec3(-0.4f, 0.3f, 0.8f)}) {
    const std::vector<Rgb> a = transferredRadiance(few, lobeLight(d)),
                           b = transferredRadiance(dense(), lobeLight(d));
    double difference = 0, norm = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      difference += double(dot(a[i] - b[i], a[i] - b[i])), norm += double(dot(b[i], b[i]));
    worst = std::max(worst, std::sqrt(difference / norm));
  }
  EXPECT_LT(worst, 0.08);
}

TEST(ClusteredTransfer, IsTheSameForAnyNumberOfThreads) {
  const int before = threadCount();
  std::vector<Transfer> made;
  for (const int threads : {1, 2, 3}) {
    setThreadCount(threads);
    made.push_back(clustered(0.05));
  }
  setThreadCount(before);
  for (const Transfer& each : made) {
    EXPECT_EQ(each.values.bytes, made[0].values.bytes);
    EXPECT_EQ(each.basis.bytes, made[0].basis.bytes);
    EXPECT_EQ(each.cluster.bytes, made[0].cluster.bytes);
  }
}

TEST(ClusteredTransfer, LeavesWhatItCannotKeepTo) {
  Job job;
  EXPECT_FALSE(clusteredTransfer(dense(), {.budget = 1e-6}, job)) << "32 terms are not enough";
  EXPECT_FALSE(clusteredTransfer(dense(), {.budget = 0.05, .clusters = 1000}, job))
      << "nothing would be saved";
  EXPECT_FALSE(clusteredTransfer(clustered(0.1), {.budget = 0.1}, job)) << "it is clustered";
  Transfer none;
  EXPECT_FALSE(clusteredTransfer(none, {.budget = 0.1}, job));
  EXPECT_THROW(clusteredTransfer(dense(), {.budget = 0}, job), ValueError);
  job.cancel();
  EXPECT_THROW(clusteredTransfer(dense(), {.budget = 0.1}, job), Cancelled);
}

}  // namespace
}  // namespace prt
