#pragma once
// The blocked layout of dense transfer matrices: where an element is, and packing. Internal to transport.

#include "libprt/core/array.h"
#include "libprt/transport/buried.h"
#include "libprt/transport/transfer.h"

#include <cstddef>
#include <span>

namespace prt {

/// Sizes of a blocked matrix array.
struct MatrixLayout {
  std::size_t samples, channels, functions;

  std::size_t blocks() const { return (samples + kMatrixLanes - 1) / kMatrixLanes; }
  std::size_t channelSize() const { return functions * functions * kMatrixLanes; }
  std::size_t blockSize() const { return channels * channelSize(); }
  std::size_t size() const { return blocks() * blockSize(); }
  std::vector<std::int64_t> shape() const {
    return {std::int64_t(blocks()), std::int64_t(channels), std::int64_t(functions), std::int64_t(functions), std::int64_t(kMatrixLanes)};
  }
};

/// Packs blocks of a matrix array, several threads at once on different blocks, and adds up what rounding
/// changes.
class MatrixPacker {
 public:
  /// Throws ResourceError when the array would not fit in memory, ValueError unless storage is f16 or f32.
  MatrixPacker(const MatrixLayout& layout, DType storage);

  /// One block: lane i is element [row, column] of channel c at matrices[i][(row * functions + column) *
  /// channels + c]. Missing lanes (fewer than kMatrixLanes) become zero.
  void pack(std::size_t block, std::span<const float* const> matrices);
  /// The array, with buried samples filled in, and the relative Frobenius norm of what rounding changed.
  /// Call once.
  Array take(const BuriedFill& fill, double& storageError);

 private:
  void fillLane(std::uint32_t target, std::span<const std::uint32_t> sources);
  float* floats() { return reinterpret_cast<float*>(array_.bytes.data()); }
  std::uint16_t* halves() { return reinterpret_cast<std::uint16_t*>(array_.bytes.data()); }

  MatrixLayout layout_;
  Array array_;
  std::vector<double> squares_, errors_;  // [blocks]
};

}  // namespace prt
