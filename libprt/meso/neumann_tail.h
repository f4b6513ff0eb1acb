#pragma once
// What a Neumann series of bounces comes to when only its beginning was added up: vector extrapolation by
// reduced rank (Eddy 1979, Mesina 1977; equivalent to GMRES on the last terms). From the last terms u_0 ..
// u_m weights g, adding up to 1, are found that make sum g_i u_i as small as can be; the same weights of the
// partial sums are the result. Internal to meso.

#include "libprt/transport/bounce_gather.h"

#include <deque>
#include <span>

namespace prt {

class NeumannTail {
 public:
  /// Keeps the last `window` terms. Rows hold channels interleaved.
  explicit NeumannTail(int channels, int window = 20) : channels_(channels), window_(std::size_t(window)) {}

  void add(const SampleRows& term);

  /// total += the rest of the series. Term k of the series is the k-th added times albedo[c]^k; `total` holds
  /// the sum of the terms so far, with as many channels as there are albedos.
  void extrapolate(std::span<const float> albedo, SampleRows& total, Job& job) const;

 private:
  double product(std::size_t i, std::size_t j, std::size_t channel) const;

  int channels_;
  std::size_t window_;
  std::size_t added_ = 0;
  std::deque<SampleRows> terms_;
};

}  // namespace prt
