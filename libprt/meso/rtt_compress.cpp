#include "libprt/meso/rtt_compress.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::MatrixXf;

constexpr int kSpare = 10, kSweeps = 3;
constexpr std::size_t kBlock = 256;  // rows of one piece of a product

/// A Q, in blocks of rows.
Columns times(const Eigen::Map<const Rows>& a, const Columns& q, Job& job) {
  Columns out(a.rows(), q.cols());
  parallelFor(job, 0, std::size_t(a.rows()), kBlock, [&](std::size_t begin, std::size_t end) {
    const auto first = Eigen::Index(begin), count = Eigen::Index(end - begin);
    out.middleRows(first, count).noalias() = a.middleRows(first, count) * q;
  });
  return out;
}

/// A' Q, in blocks of columns.
Columns transposedTimes(const Eigen::Map<const Rows>& a, const Columns& q, Job& job) {
  Columns out(a.cols(), q.cols());
  parallelFor(job, 0, std::size_t(a.cols()), kBlock, [&](std::size_t begin, std::size_t end) {
    const auto first = Eigen::Index(begin), count = Eigen::Index(end - begin);
    out.middleRows(first, count).noalias() = a.middleCols(first, count).transpose() * q;
  });
  return out;
}

Columns orthonormal(const Columns& q) {
  return Eigen::HouseholderQR<Columns>(q).householderQ() * Columns::Identity(q.rows(), q.cols());
}

}  // namespace

RttFactors compressRtt(const Rtt& rtt, int terms, Job& job) {
  if (terms < 1 || terms > 256)
    throw ValueError("cannot keep " + std::to_string(terms) + " terms", "terms", "use 1 to 256");
  const auto rowCount = Eigen::Index(rtt.texels) * rtt.texels * rtt.layers,
             width = Eigen::Index(rtt.values.size()) / rowCount;
  const Eigen::Map<const Rows> a(rtt.values.data(), rowCount, width);
  const Eigen::Index kept = std::min<Eigen::Index>(terms, std::min(rowCount, width)),
                     wide = std::min(kept + kSpare, std::min(rowCount, width));
  job.begin("terms of the radiance transfer texture", 2 * kSweeps + 2, "products");
  Columns q(width, wide);
  for (Eigen::Index i = 0; i < q.size(); ++i) q.data()[i] = hashUniform(1, std::uint64_t(i)) - 0.5f;
  for (int sweep = 0; sweep <= kSweeps; ++sweep) {
    const Columns left = orthonormal(times(a, orthonormal(q), job));
    job.advance(1);
    q = transposedTimes(a, left, job);
    job.advance(1);
  }
  // With Q spanning the row space, A = (A Q) Q': the small part's decomposition is that of A.
  const Columns basis = orthonormal(q), left = times(a, basis, job);
  const Eigen::MatrixXd gram = (left.transpose() * left).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);  // ascending
  RttFactors out;
  out.terms = int(kept), out.texels = rtt.texels, out.views = rtt.views, out.bands = rtt.bands;
  out.channels = rtt.channels, out.layers = rtt.layers, out.colour = rtt.colour;
  Columns turn(wide, kept);
  for (Eigen::Index t = 0; t < kept; ++t) turn.col(t) = solver.eigenvectors().col(wide - 1 - t).cast<float>();
  const Rows coefficients = left * turn, responses = (basis * turn).transpose();
  out.coefficients.assign(coefficients.data(), coefficients.data() + coefficients.size());
  out.responses.assign(responses.data(), responses.data() + responses.size());
  double all = 0, rest = 0;
  for (const float x : rtt.values) all += double(x) * double(x);
  rest = all;
  out.errors.push_back(all > 0 ? 1 : 0);
  for (Eigen::Index t = 0; t < kept; ++t) {
    rest -= solver.eigenvalues()[wide - 1 - t];
    out.errors.push_back(all > 0 ? std::sqrt(std::max(0.0, rest / all)) : 0);
  }
  return out;
}

Rtt expandRtt(const RttFactors& f, int terms) {
  const int used = terms > 0 ? std::min(terms, f.terms) : f.terms;
  Rtt rtt(f.texels, f.views, f.bands, f.channels);
  rtt.colour = f.colour, rtt.layers = f.layers;
  rtt.values.resize(rtt.values.size() * std::size_t(f.layers));
  const auto rowCount = Eigen::Index(f.texels) * f.texels * f.layers,
             width = Eigen::Index(rtt.values.size()) / rowCount;
  const Eigen::Map<const Rows> c(f.coefficients.data(), rowCount, f.terms),
      e(f.responses.data(), f.terms, width);
  Eigen::Map<Rows>(rtt.values.data(), rowCount, width) = c.leftCols(used) * e.topRows(used);
  return rtt;
}

}  // namespace prt
