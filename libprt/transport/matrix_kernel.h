#pragma once
// The kernels that apply stored matrices to light. Bound by memory: matrices are read once, in order, and
// halves are converted on the fly. Internal to transport.

#include <cstddef>
#include <cstdint>

namespace prt {

/// result[(s * n + row) * 3 + c] = sum over columns of matrix_s[channel c, column, row] * light[column * 3 +
/// c] for `samples` matrices stored as [samples, channels, n columns, n rows]; with one channel all colours
/// use it. Reads up to kKernelOverread elements beyond the last matrix: that memory must exist, its contents
/// do not matter.
struct MatrixProduct {
  std::size_t samples;   ///< at least 1
  std::size_t channels;  ///< 1 or 3
  std::size_t n;         ///< at most kKernelMaxFunctions
  const float* light;    ///< [n, 3]
  float* result;         ///< [samples, n, 3]
};

inline constexpr std::size_t kKernelOverread = 32;
inline constexpr std::size_t kKernelMaxFunctions = 100;

/// For whatever the library is built for.
void multiplyMatrices(const std::uint16_t* halves, const MatrixProduct& product);
void multiplyMatrices(const float* floats, const MatrixProduct& product);

/// The same for AVX-512. Call only where wideKernelRuns().
void multiplyMatricesWide(const std::uint16_t* halves, const MatrixProduct& product);
void multiplyMatricesWide(const float* floats, const MatrixProduct& product);
bool wideKernelRuns();

}  // namespace prt
