#pragma once
// Dense transfer matrices as they are stored: packing, rounding, filling in. Internal to transport.

#include "libprt/core/array.h"
#include "libprt/transport/buried.h"
#include "libprt/transport/transfer.h"

#include <cstddef>
#include <span>
#include <vector>

namespace prt {

/// Sizes of a stored matrix array: [samples, channels, columns, rows].
struct MatrixLayout {
  std::size_t samples, channels, functions;

  std::size_t matrixSize() const { return functions * functions; }
  std::size_t sampleSize() const { return channels * matrixSize(); }
  std::size_t size() const { return samples * sampleSize(); }
  std::vector<std::int64_t> shape() const {
    return {std::int64_t(samples), std::int64_t(channels), std::int64_t(functions), std::int64_t(functions)};
  }
};

/// Packs matrices, several threads at once on different samples, and adds up what rounding changes.
class MatrixPacker {
 public:
  /// Throws ResourceError when the array would not fit in memory, ValueError unless storage is f16 or f32.
  MatrixPacker(const MatrixLayout& layout, DType storage);

  /// One sample: element [row, column] of channel c is at matrix[(row * functions + column) * channels + c].
  void pack(std::size_t sample, const float* matrix);
  /// The array, with buried samples filled in, and the relative Frobenius norm of what rounding changed.
  /// Call once.
  Array take(const BuriedFill& fill, double& storageError);

 private:
  void fill(std::uint32_t target, std::span<const std::uint32_t> sources);
  float* floats() { return reinterpret_cast<float*>(array_.bytes.data()); }
  std::uint16_t* halves() { return reinterpret_cast<std::uint16_t*>(array_.bytes.data()); }

  MatrixLayout layout_;
  Array array_;
  std::vector<double> squares_, errors_;  // [samples]
};

}  // namespace prt
