#pragma once
// A radiance transfer texture as a product of few terms: B(texel, view, k) = sum_t c_t(texel) E_t(view, k).
// Exit radiance is linear in c, so coefficient textures can be filtered like any other (ALGORITHMS 6.5). By
// singular value decomposition, rows weighted alike and views by the root of their solid angle (all cells of
// the square have the same): the best that so many terms can do in the mean over texels, views and functions.

#include "libprt/core/job.h"
#include "libprt/meso/rtt.h"

#include <vector>

namespace prt {

struct RttFactors {
  int terms = 0;
  int texels = 0, views = 0, bands = 0, channels = 1, layers = 1;
  Rgb colour{1};
  std::vector<float> coefficients;  ///< [layer, v, u, term]
  std::vector<float> responses;     ///< [term, view_y, view_x, k (, channel)]
  /// [terms + 1] relative Frobenius error left by 0, 1, .. terms terms.
  std::vector<double> errors;

  std::size_t bytes() const { return (coefficients.size() + responses.size()) * sizeof(float); }
};

/// The first `terms` terms, or as many as the table has rows; by block power iteration, whose error against
/// the exact decomposition is far below that of leaving the rest out. Same bits for any number of threads.
/// Throws ValueError unless 1 <= terms <= 256.
RttFactors compressRtt(const Rtt& rtt, int terms, Job& job);

/// The table again, from the first `terms` terms (0 = all there are).
Rtt expandRtt(const RttFactors& factors, int terms = 0);

}  // namespace prt
