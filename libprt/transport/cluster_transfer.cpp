#include "libprt/transport/cluster_transfer.h"

#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::MatrixXf;

constexpr Eigen::Index kStep = 4, kMostTerms = 32, kSpare = 8;
constexpr Eigen::Index kSketch = 48;                     // numbers that clusters are found in
constexpr std::size_t kSketchRows = 3000, kBlock = 512;  // matrices that these are made from; rows at a time
constexpr int kSweeps = 2, kRounds = 12;

/// Stored matrices as rows of floats, a few at a time: all of them may not fit.
class MatrixRows {
 public:
  explicit MatrixRows(const Transfer& transfer)
      : count_(transfer.samples),
        width_(std::size_t(transfer.channels) * std::size_t(transfer.functions()) *
               std::size_t(transfer.functions())),
        values_(transfer.values) {}

  std::size_t count() const { return count_; }
  Eigen::Index width() const { return Eigen::Index(width_); }
  void read(std::size_t sample, float* to) const {
    if (values_.dtype == DType::f16)
      fromHalf(values_.as<std::uint16_t>().subspan(sample * width_, width_), std::span(to, width_));
    else
      std::copy_n(values_.as<float>().begin() + std::ptrdiff_t(sample * width_), width_, to);
  }
  Rows some(std::span<const std::uint32_t> samples) const {
    Rows out(Eigen::Index(samples.size()), width());
    for (std::size_t i = 0; i < samples.size(); ++i) read(samples[i], out.row(Eigen::Index(i)).data());
    return out;
  }

 private:
  std::size_t count_, width_;
  const Array& values_;
};

Columns orthonormal(const Columns& q) {
  return Eigen::HouseholderQR<Columns>(q).householderQ() * Columns::Identity(q.rows(), q.cols());
}

/// Orthonormal columns that span the first principal directions of rows, the first one first.
Columns principal(const Rows& rows, Eigen::Index wanted, std::uint64_t seed) {
  const Eigen::Index wide = std::min({wanted + kSpare, rows.rows(), rows.cols()});
  Columns q(rows.cols(), wide);
  for (Eigen::Index i = 0; i < q.size(); ++i) q.data()[i] = hashUniform(seed, std::uint64_t(i)) - 0.5f;
  for (int sweep = 0; sweep <= kSweeps; ++sweep) q = orthonormal(rows.transpose() * orthonormal(rows * q));
  const Columns inside = rows * q;
  const Eigen::SelfAdjointEigenSolver<Columns> solver(inside.transpose() * inside);  // ascending
  const Eigen::Index kept = std::min(wanted, wide);
  return q * solver.eigenvectors().rowwise().reverse().leftCols(kept);
}

/// All matrices in few numbers, [S, sketch]: distances between them are nearly those of the matrices.
Rows sketchOf(const MatrixRows& matrices, std::uint64_t seed, Job& job) {
  std::vector<std::uint32_t> some(std::min(matrices.count(), kSketchRows));
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = std::uint32_t(i * matrices.count() / some.size());
  const Columns basis = principal(matrices.some(some), kSketch, seed);
  Rows sketch(Eigen::Index(matrices.count()), basis.cols());
  parallelFor(job, 0, matrices.count(), kBlock, [&](std::size_t begin, std::size_t end) {
    Rows block(Eigen::Index(end - begin), matrices.width());
    for (std::size_t s = begin; s < end; ++s) matrices.read(s, block.row(Eigen::Index(s - begin)).data());
    sketch.middleRows(Eigen::Index(begin), block.rows()).noalias() = block * basis;
  });
  return sketch;
}

/// The nearest centre of every row.
void assign(const Rows& rows, const Rows& centres, std::vector<std::uint32_t>& cluster, Job& job) {
  const Eigen::VectorXf half = 0.5f * centres.rowwise().squaredNorm();
  parallelFor(job, 0, cluster.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    const Rows scores = rows.middleRows(Eigen::Index(begin), Eigen::Index(end - begin)) * centres.transpose();
    for (std::size_t s = begin; s < end; ++s) {
      Eigen::Index best = 0;
      (scores.row(Eigen::Index(s - begin)).transpose() - half).maxCoeff(&best);
      cluster[s] = std::uint32_t(best);
    }
  });
}

/// Lloyd's clusters, begun at rows all over; a centre that nobody is nearest to stays where it is.
std::vector<std::uint32_t> clustersOf(const Rows& rows, std::size_t count, std::uint64_t seed, Job& job) {
  Rows centres(Eigen::Index(count), rows.cols());
  for (std::size_t c = 0; c < count; ++c) {
    const auto jitter = double(hashUniform(seed, c));
    centres.row(Eigen::Index(c)) =
        rows.row(Eigen::Index((double(c) + jitter) / double(count) * double(rows.rows())));
  }
  std::vector<std::uint32_t> cluster(std::size_t(rows.rows()), 0);
  for (int round = 0; round < kRounds; ++round) {
    assign(rows, centres, cluster, job);
    Rows sums = Rows::Zero(centres.rows(), centres.cols());
    std::vector<float> sizes(count, 0);
    for (std::size_t s = 0; s < cluster.size(); ++s) {
      sums.row(cluster[s]) += rows.row(Eigen::Index(s));
      ++sizes[cluster[s]];
    }
    for (std::size_t c = 0; c < count; ++c)
      if (sizes[c] > 0) centres.row(Eigen::Index(c)) = sums.row(Eigen::Index(c)) / sizes[c];
    job.advance(1);
  }
  return cluster;
}

/// One cluster: its mean, its principal matrices and everybody's weights, with what is left after each number
/// of terms.
struct Cluster {
  std::vector<std::uint32_t> samples;
  Rows basis;                                                           // [terms + 1, width], the mean first
  Rows weights;                                                         // [samples, terms]
  std::vector<double> left = std::vector<double>(kMostTerms + 1, 0.0);  // squares
  double all = 0;

  void reduce(const MatrixRows& matrices, std::uint64_t seed) {
    basis = Rows::Zero(kMostTerms + 1, matrices.width());
    weights = Rows::Zero(Eigen::Index(samples.size()), kMostTerms);
    if (samples.empty()) return;
    Rows rows = matrices.some(samples);
    all = rows.cast<double>().squaredNorm();
    basis.row(0) = rows.colwise().mean();
    rows.rowwise() -= basis.row(0);
    const Columns directions = principal(rows, kMostTerms, seed);
    const Eigen::Index terms = directions.cols();
    basis.middleRows(1, terms) = directions.transpose();
    weights.leftCols(terms) = rows * directions;
    double rest = rows.cast<double>().squaredNorm();
    for (Eigen::Index t = 0; t <= kMostTerms; ++t) {
      left[std::size_t(t)] = std::max(0.0, rest);
      if (t < terms) rest -= weights.col(t).cast<double>().squaredNorm();
    }
  }
};

/// The least number of terms that keeps the budget; 0: none does.
Eigen::Index termsFor(const std::vector<Cluster>& clusters, double budget) {
  double all = 0;
  for (const Cluster& c : clusters) all += c.all;
  for (Eigen::Index terms = kStep; terms <= kMostTerms; terms += kStep) {
    double left = 0;
    for (const Cluster& c : clusters) left += c.left[std::size_t(terms)];
    if (left <= budget * budget * all) return terms;
  }
  return 0;
}

/// Rounds to halfs; the sum of the squares of what that changes.
double round(std::span<const float> values, std::uint16_t* to) {
  double changed = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    to[i] = toHalf(values[i]);
    const double d = double(values[i]) - double(fromHalf(to[i]));
    changed += d * d;
  }
  return changed;
}

Array halfArray(std::span<const std::uint16_t> halfs, std::vector<std::int64_t> shape) {
  Array array = Array::from(halfs, std::move(shape));
  array.dtype = DType::f16;
  return array;
}

Transfer packed(const Transfer& from, const std::vector<Cluster>& clusters, Eigen::Index terms) {
  const auto kept = std::size_t(terms);
  const auto width = std::size_t(clusters[0].basis.cols());
  std::vector<std::uint32_t> cluster(from.samples, 0);
  std::vector<std::uint16_t> weights(from.samples * kept, 0), basis(clusters.size() * (kept + 1) * width, 0);
  double left = 0, all = 0;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const Cluster& one = clusters[c];
    left += one.left[kept], all += one.all;
    for (std::size_t t = 0; t <= kept; ++t) {
      const std::span<const float> row(one.basis.row(Eigen::Index(t)).data(), width);
      const double changed = round(row, basis.data() + (c * (kept + 1) + t) * width);
      // Everybody has the mean once and the others by their weights.
      left += changed * (t == 0 ? double(one.samples.size())
                                : double(one.weights.col(Eigen::Index(t) - 1).squaredNorm()));
    }
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      cluster[one.samples[i]] = std::uint32_t(c);
      const std::span<const float> row(one.weights.row(Eigen::Index(i)).data(), kept);
      left += round(row, weights.data() + one.samples[i] * kept);  // directions are of length 1
    }
  }
  Transfer out;
  out.form = from.form, out.bands = from.bands, out.channels = from.channels, out.samples = from.samples;
  out.diffuse = from.diffuse, out.surface = from.surface;
  out.raysPerSample = from.raysPerSample, out.raysWanted = from.raysWanted, out.bounces = from.bounces;
  out.storageError = std::hypot(all > 0 ? std::sqrt(left / all) : 0.0, from.storageError);
  const std::int64_t samples = std::int64_t(from.samples), n = from.functions();
  out.values = halfArray(weights, {samples, terms});
  out.cluster = Array::from<std::uint32_t>(std::span<const std::uint32_t>(cluster), {samples});
  out.basis = halfArray(basis, {std::int64_t(clusters.size()), terms + 1, out.channels, n, n});
  return out;
}

}  // namespace

std::optional<Transfer> clusteredTransfer(const Transfer& transfer, const ClusterOptions& options, Job& job) {
  if (!(options.budget > 0))
    throw ValueError("is not positive", "transfer.compress", "use a relative error such as 0.01");
  if (transfer.form != TransferForm::Matrix || transfer.clustered() || transfer.samples == 0) return {};
  const MatrixRows matrices(transfer);
  const std::size_t count = options.clusters > 0 ? std::size_t(options.clusters)
                                                 : std::clamp<std::size_t>(matrices.count() / 250, 1, 1024);
  job.begin("clusters of transfer matrices", double(kRounds) + double(count), "steps");
  std::vector<Cluster> clusters(std::min(count, matrices.count()));
  const std::vector<std::uint32_t> of =
      clustersOf(sketchOf(matrices, options.seed, job), clusters.size(), options.seed, job);
  for (std::size_t s = 0; s < of.size(); ++s) clusters[of[s]].samples.push_back(std::uint32_t(s));
  parallelFor(job, 0, clusters.size(), 1, [&](std::size_t c, std::size_t) {
    clusters[c].reduce(matrices, options.seed + c);
    job.advance(1);
  });
  const Eigen::Index terms = termsFor(clusters, options.budget);
  if (terms == 0) return {};
  Transfer out = packed(transfer, clusters, terms);
  const std::size_t bytes = out.values.bytes.size() + out.cluster.bytes.size() + out.basis.bytes.size();
  if (2 * bytes > transfer.values.bytes.size()) return {};
  return out;
}

LitClusters::LitClusters(const Transfer& transfer, const std::vector<Rgb>& light)
    : rows(std::size_t(transfer.basis.shape[1])),
      stride((std::size_t(transfer.functions()) * 3 + 7) / 8 * 8),
      values(std::size_t(transfer.basis.shape[0]) * rows * stride, 0.0f) {
  const auto n = std::size_t(transfer.functions()), channels = std::size_t(transfer.channels);
  const std::span<const std::uint16_t> basis = transfer.basis.as<std::uint16_t>();
  Job job;
  parallelFor(job, 0, values.size() / stride, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> matrix(channels * n * n), sum(n);
    for (std::size_t m = begin; m < end; ++m) {
      fromHalf(basis.subspan(m * matrix.size(), matrix.size()), matrix);
      for (std::size_t c = 0; c < 3; ++c) {
        const float* column = matrix.data() + (channels == 3 ? c * n * n : 0);
        std::fill(sum.begin(), sum.end(), 0.0f);
        for (std::size_t k = 0; k < n; ++k, column += n) {
          const float l = light[k][int(c)];
          for (std::size_t i = 0; i < n; ++i) sum[i] += l * column[i];
        }
        for (std::size_t i = 0; i < n; ++i) values[m * stride + 3 * i + c] = sum[i];
      }
    }
  });
}

}  // namespace prt
