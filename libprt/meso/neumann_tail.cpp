#include "libprt/meso/neumann_tail.h"

#include <Eigen/Dense>

#include <cmath>

namespace prt {

void NeumannTail::add(const SampleRows& term) {
  terms_.push_back(term);
  if (terms_.size() > window_) terms_.pop_front();
  ++added_;
}

double NeumannTail::product(std::size_t i, std::size_t j, std::size_t channel) const {
  const SampleRows &a = terms_[i], &b = terms_[j];
  double sum = 0;
  for (std::size_t s = 0; s < a.count(); ++s)
    for (std::size_t k = channel; k < a.width; k += std::size_t(channels_))
      sum += double(a.row(s)[k]) * double(b.row(s)[k]);
  return sum;
}

void NeumannTail::extrapolate(std::span<const float> albedo, SampleRows& total, Job& job) const {
  const std::size_t n = terms_.size(), channels = albedo.size();
  if (n < 2) return;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t from = c % std::size_t(channels_);
    std::vector<double> power(n);  // of each term, against the last
    for (std::size_t i = 0; i < n; ++i) power[i] = std::pow(double(albedo[c]), double(i) - double(n - 1));
    if (!(albedo[c] > 0)) continue;
    Eigen::MatrixXd gram(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      job.checkCancelled();
      for (std::size_t j = 0; j <= i; ++j)
        gram(Eigen::Index(i), Eigen::Index(j)) = gram(Eigen::Index(j), Eigen::Index(i)) =
            power[i] * power[j] * product(i, j, from);
    }
    const double trace = gram.trace();
    if (!(trace > 0)) continue;
    gram.diagonal().array() += 1e-11 * trace;  // rounding of the terms
    Eigen::VectorXd weights = gram.ldlt().solve(Eigen::VectorXd::Ones(Eigen::Index(n)));
    weights /= weights.sum();
    // sum g_i S_i = S_n - sum u_j (g_0 + ... + g_(j-1)), S_i the partial sum with term i.
    const double scale = std::pow(double(albedo[c]), double(added_));
    double before = 0;
    for (std::size_t j = 1; j < n; ++j) {
      before += weights[Eigen::Index(j - 1)];
      const auto factor = float(-before * power[j] * scale);
      for (std::size_t s = 0; s < total.count(); ++s)
        for (std::size_t k = 0; k * channels + c < total.width; ++k)
          total.row(s)[k * channels + c] += factor * terms_[j].row(s)[k * std::size_t(channels_) + from];
    }
  }
}

}  // namespace prt
