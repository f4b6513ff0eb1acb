#include "libprt/meso/rtt_compress.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/rtt_storage.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace prt {
namespace {

using namespace test;

const Rtt& table() {
  static const Rtt rtt = [] {
    Patch patch = heightField(bumps(32, 0.2f), Rgb(0.8f, 0.5f, 0.3f));
    return baked(std::move(patch), small(16, 4, 256, 1));
  }();
  return rtt;
}

TEST(RttCompress, TheErrorCurveIsThatOfTheTable) {
  Job job;
  const RttFactors factors = compressRtt(table(), 24, job);
  ASSERT_EQ(factors.errors.size(), 25u);
  EXPECT_DOUBLE_EQ(factors.errors[0], 1);
  for (const int terms : {1, 4, 12, 24}) {
    EXPECT_NEAR(relativeDifference(expandRtt(factors, terms), table()), factors.errors[std::size_t(terms)],
                2e-2 * factors.errors[std::size_t(terms)] + 1e-5)
        << terms;
    EXPECT_LT(factors.errors[std::size_t(terms)], factors.errors[std::size_t(terms - 1)]);
  }
}

TEST(RttCompress, NoOtherTermsDoBetter) {
  Job job;
  const RttFactors factors = compressRtt(table(), 12, job);
  using Rows = Eigen::Matrix<float, -1, -1, Eigen::RowMajor>;
  const Eigen::Index rowCount = 256, width = Eigen::Index(table().values.size()) / rowCount;
  const Eigen::MatrixXd a = Eigen::Map<const Rows>(table().values.data(), rowCount, width).cast<double>();
  const Eigen::VectorXd exact = Eigen::BDCSVD<Eigen::MatrixXd>(a).singularValues();
  const double all = exact.squaredNorm();
  double rest = all;
  for (int t = 0; t < 12; ++t) {
    rest -= exact[t] * exact[t];
    EXPECT_NEAR(factors.errors[std::size_t(t + 1)], std::sqrt(rest / all),
                1e-3 * std::sqrt(rest / all) + 2e-6)
        << t;
  }
}

TEST(RttCompress, IsTheSameForAnyNumberOfThreads) {
  Job job;
  const int before = threadCount();
  setThreadCount(1);
  const RttFactors one = compressRtt(table(), 8, job);
  setThreadCount(4);
  const RttFactors four = compressRtt(table(), 8, job);
  setThreadCount(before);
  EXPECT_EQ(one.coefficients, four.coefficients);
  EXPECT_EQ(one.responses, four.responses);
}

TEST(RttCompress, SmallTablesHaveFewTerms) {
  Job job;
  const Rtt flat = baked(flatPatch(Rgb(0.5f)), small(4, 1));
  const RttFactors factors = compressRtt(flat, 200, job);
  EXPECT_LE(factors.terms, 16);
  EXPECT_LT(factors.errors[1], 1e-3);  // one response serves all texels
  EXPECT_LT(relativeDifference(expandRtt(factors), flat), 1e-5);
  EXPECT_THROW(compressRtt(flat, 0, job), ValueError);
  EXPECT_THROW(compressRtt(flat, 257, job), ValueError);
}

TEST(RttStorage, HalvesAndBytesTellTheirError) {
  for (const auto& [type, most] :
       {std::pair(DType::f32, 0.0), std::pair(DType::f16, 5e-4), std::pair(DType::u8, 0.01)}) {
    const StoredRtt stored = storeRtt(table(), type);
    Rtt back = table();
    back.values.assign(back.values.size(), -1.0f);
    restoreRtt(stored, back);
    Rtt plain = table();
    plain.colour = back.colour = Rgb(1);
    EXPECT_NEAR(relativeDifference(back, plain), stored.error, 1e-4 * stored.error + 1e-9);
    EXPECT_LE(stored.error, most);
    EXPECT_EQ(stored.values.bytes.size(), table().values.size() * sizeOf(type));
  }
  EXPECT_THROW(storeRtt(table(), DType::f64), ValueError);
  Rtt other(4, 2, 5, 3);
  EXPECT_THROW(restoreRtt(storeRtt(table(), DType::f16), other), FileError);
}

}  // namespace
}  // namespace prt
