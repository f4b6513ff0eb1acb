#pragma once
// Products of functions in spherical harmonics, through the triple-product (Gaunt) coefficients
// G_ijk = integral of Y_i Y_j Y_k over the sphere: fully symmetric, mostly zero (1158 of 15625 are not for
// 5 bands). Computed once by quadrature that is exact, in double, and kept.

#include "libprt/basis/sh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// The non-zero G_ijk with i, j, k below their own band limits.
class GauntTensor {
 public:
  struct Entry {
    std::uint16_t i, j, k;
    double value;
  };

  /// Prefer gauntTensor(), which keeps what it made. Band limits 1..kMaxGauntBands (ValueError).
  GauntTensor(int bandsI, int bandsJ, int bandsK);

  int bandsI() const { return bandsI_; }
  int bandsJ() const { return bandsJ_; }
  int bandsK() const { return bandsK_; }
  /// In order of i, then j, then k.
  std::span<const Entry> entries() const { return entries_; }

  /// Matrix of "multiply by f": matrix[i * shCount(bandsJ) + j] = sum over k of G_ijk f[k]. It takes the
  /// coefficients (j) of a function to those (i) of its product with f, and is exact where f's bands reach
  /// bandsI + bandsJ - 1.
  void contract(std::span<const float> f, std::span<float> matrix) const;
  void contract(std::span<const double> f, std::span<double> matrix) const;

 private:
  int bandsI_, bandsJ_, bandsK_;
  std::vector<Entry> entries_;
};

inline constexpr int kMaxGauntBands = 40;

/// The tensor for these band limits; made at the first call, shared by all threads, never freed.
const GauntTensor& gauntTensor(int bandsI, int bandsJ, int bandsK);

/// Direct transfer from visibility: T_ij = integral of V Y_i Y_j, exactly, from the (2*bands-1)^2
/// coefficients of V; `matrix` is shCount(bands)^2, symmetric. Thread-safe, about a microsecond for 5 bands.
void expandVisibility(int bands, std::span<const float> visibility, std::span<float> matrix);

/// Coefficients (bandsOut) of the product of two functions. Complete when bandsOut = bandsA + bandsB - 1.
std::vector<float> shProduct(int bandsA, std::span<const float> a, int bandsB, std::span<const float> b,
                             int bandsOut);

}  // namespace prt
