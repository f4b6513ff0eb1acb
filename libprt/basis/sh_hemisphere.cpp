#include "libprt/basis/sh_hemisphere.h"

#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"

#include <Eigen/Eigenvalues>

#include <stdexcept>
#include <string>

namespace prt {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kMostBands = 20;

void requireBands(int bands) {
  if (bands >= 1 && bands <= kMostBands) return;
  throw ValueError("cannot use " + std::to_string(bands) + " bands", "hemispherical harmonics",
                   "use 1 to " + std::to_string(kMostBands));
}

Matrix gram(int bands) {
  const SphereRule rule = hemisphereRule(2 * bands - 2);
  Matrix samples(rule.weights.size(), shCount(bands));
  for (Eigen::Index s = 0; s < samples.rows(); ++s)
    shEvaluate(bands, rule.directions[s], std::span(samples.row(s).data(), std::size_t(samples.cols())));
  const Eigen::Map<const Eigen::VectorXd> weights(rule.weights.data(), samples.rows());
  return samples.transpose() * weights.asDiagonal() * samples;
}

}  // namespace

std::vector<double> hemisphereGram(int bands) {
  requireBands(bands);
  const Matrix h = gram(bands);
  return {h.data(), h.data() + h.size()};
}

HemisphereFit::HemisphereFit(int bands, double leastEigenvalue) : bands_(bands) {
  requireBands(bands);
  if (!(leastEigenvalue >= 0 && leastEigenvalue < 1))
    throw ValueError("the least eigenvalue must be at least 0 and below 1", "hemispherical fit", "use 0.01");
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(gram(bands));
  const Eigen::VectorXd values = solver.eigenvalues();
  eigenvalues_.assign(values.begin(), values.end());
  Eigen::VectorXd inverted = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (values[i] > 0 && values[i] >= leastEigenvalue) inverted[i] = 1 / values[i];
  const Matrix inverse = solver.eigenvectors() * inverted.asDiagonal() * solver.eigenvectors().transpose();
  inverse_.assign(inverse.data(), inverse.data() + inverse.size());
}

void HemisphereFit::apply(std::span<const double> b, std::span<double> c) const {
  const std::size_t n = shCount(bands_);
  if (b.size() < n || c.size() < n)
    throw std::length_error("hemispherical fit: a coefficient span is too short");
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += inverse_[i * n + j] * b[j];
    c[i] = sum;
  }
}

}  // namespace prt
