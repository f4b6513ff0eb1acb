#include "libprt/transport/matrix_blocks.h"

#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/job.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/memory_limit.h"

#include <algorithm>
#include <cmath>

namespace prt {

MatrixPacker::MatrixPacker(const MatrixLayout& layout, DType storage) : layout_(layout) {
  if (storage != DType::f16 && storage != DType::f32)
    throw ValueError("cannot store transfer as " + toString(storage), "transfer.storage", "use f16 or f32");
  const std::size_t bytes = layout.size() * sizeOf(storage);
  requireMemory(bytes, "transfer matrices", "use fewer bands, a simpler mesh, f16 storage or no bounces");
  array_ = {storage, layout.shape(), std::vector<std::byte>(bytes)};
  squares_.resize(layout.blocks());
  errors_.resize(layout.blocks());
}

void MatrixPacker::pack(std::size_t block, std::span<const float* const> matrices) {
  const std::size_t n2 = layout_.functions * layout_.functions;
  std::vector<float> lanes(layout_.blockSize(), 0.0f);
  for (std::size_t i = 0; i < matrices.size(); ++i)
    for (std::size_t c = 0; c < layout_.channels; ++c)
      for (std::size_t e = 0; e < n2; ++e)
        lanes[(c * n2 + e) * kMatrixLanes + i] = std::clamp(matrices[i][e * layout_.channels + c], -kLargestHalf, kLargestHalf);
  double square = 0, error = 0;
  for (const float x : lanes) square += double(x) * x;
  std::byte* to = array_.bytes.data() + block * layout_.blockSize() * sizeOf(array_.dtype);
  if (array_.dtype == DType::f32) {
    std::copy(lanes.begin(), lanes.end(), reinterpret_cast<float*>(to));
  } else {
    const std::span<std::uint16_t> half(reinterpret_cast<std::uint16_t*>(to), lanes.size());
    toHalf(lanes, half);
    std::vector<float> back(lanes.size());
    fromHalf(half, back);
    for (std::size_t i = 0; i < lanes.size(); ++i) error += (double(back[i]) - lanes[i]) * (double(back[i]) - lanes[i]);
  }
  squares_[block] = square, errors_[block] = error;
}

/// Mean of other samples' matrices, as they are stored.
void MatrixPacker::fillLane(std::uint32_t target, std::span<const std::uint32_t> sources) {
  const auto at = [&](std::uint32_t sample, std::size_t element) {
    return sample / kMatrixLanes * layout_.blockSize() + element * kMatrixLanes + sample % kMatrixLanes;
  };
  for (std::size_t e = 0; e < layout_.blockSize() / kMatrixLanes; ++e) {
    float sum = 0;
    for (const std::uint32_t s : sources) sum += array_.dtype == DType::f32 ? floats()[at(s, e)] : fromHalf(halves()[at(s, e)]);
    sum /= float(sources.size());
    if (array_.dtype == DType::f32) floats()[at(target, e)] = sum;
    else halves()[at(target, e)] = toHalf(sum);
  }
}

Array MatrixPacker::take(const BuriedFill& fill, double& storageError) {
  for (std::size_t i = 0; i < fill.size(); ++i) fillLane(fill.target(i), fill.sources(i));
  double square = 0, error = 0;
  for (std::size_t b = 0; b < squares_.size(); ++b) square += squares_[b], error += errors_[b];
  storageError = square > 0 ? std::sqrt(error / square) : 0;
  return std::move(array_);
}

Array matrixBlocks(std::span<const float> matrices, std::size_t samples, int channels, int bands, DType storage) {
  const MatrixLayout layout{samples, std::size_t(channels), std::size_t(shCount(bands))};
  const std::size_t one = layout.functions * layout.functions * layout.channels;
  if (matrices.size() != samples * one)
    throw ValueError("matrices hold " + std::to_string(matrices.size()) + " numbers, not " + std::to_string(samples * one),
                     "transfer", "give [S, n^2, n^2] or [S, n^2, n^2, 3]");
  MatrixPacker packer(layout, storage);
  for (std::size_t b = 0; b < layout.blocks(); ++b) {
    std::vector<const float*> lanes;
    for (std::size_t s = b * kMatrixLanes; s < std::min(samples, (b + 1) * kMatrixLanes); ++s) lanes.push_back(matrices.data() + s * one);
    packer.pack(b, lanes);
  }
  double ignored;
  return packer.take({}, ignored);
}

}  // namespace prt
