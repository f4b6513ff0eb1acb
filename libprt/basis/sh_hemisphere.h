#pragma once
// Spherical harmonics on the upper hemisphere (z > 0), where they are no longer orthogonal. Used for outgoing
// radiance and other functions that exist above a surface only; not for incident transfer, where it gains
// next to nothing. Source: Sloan et al. 2003, "Clustered Principal Components", section on least squares.

#include "libprt/basis/sh.h"

#include <span>
#include <vector>

namespace prt {

/// H_ij = integral over the upper hemisphere of Y_i Y_j; row-major, shCount(bands) squared. It is also the
/// direct transfer of an infinite plane with normal +z.
std::vector<double> hemisphereGram(int bands);

/// Least-squares fit of a function known above the horizon only: coefficients c that minimise the integral
/// over the upper hemisphere of (f - sum c_i Y_i)^2, from b_i = integral over the upper hemisphere of f Y_i.
/// H is nearly singular (condition 1.5e5 at 5 bands), so directions in which functions almost vanish above
/// the horizon are left out: noise in b grows by at most 1 / leastEigenvalue.
class HemisphereFit {
 public:
  /// Throws ValueError unless bands is 1..20 and 0 <= leastEigenvalue < 1.
  explicit HemisphereFit(int bands, double leastEigenvalue = 0.01);

  int bands() const { return bands_; }
  /// Eigenvalues of H, ascending, those left out included. They pair up: x and 1 - x.
  std::span<const double> eigenvalues() const { return eigenvalues_; }
  /// c = pseudo-inverse of H times b; both shCount(bands()) long, not overlapping (std::length_error).
  void apply(std::span<const double> b, std::span<double> c) const;

 private:
  int bands_;
  std::vector<double> eigenvalues_;
  std::vector<double> inverse_;  // row-major
};

}  // namespace prt
