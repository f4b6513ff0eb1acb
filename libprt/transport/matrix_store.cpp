#include "libprt/transport/matrix_store.h"

#include "libprt/core/error.h"
#include "libprt/core/half.h"
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
  squares_.resize(layout.samples);
  errors_.resize(layout.samples);
}

void MatrixPacker::pack(std::size_t sample, const float* matrix) {
  const std::size_t n = layout_.functions, channels = layout_.channels;
  std::vector<float> columns(layout_.sampleSize());
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t column = 0; column < n; ++column)
      for (std::size_t row = 0; row < n; ++row)
        columns[(c * n + column) * n + row] =
            std::clamp(matrix[(row * n + column) * channels + c], -kLargestHalf, kLargestHalf);
  double square = 0, error = 0;
  for (const float x : columns) square += double(x) * x;
  const std::size_t at = sample * layout_.sampleSize();
  if (array_.dtype == DType::f32) {
    std::copy(columns.begin(), columns.end(), floats() + at);
  } else {
    const std::span<std::uint16_t> half(halves() + at, columns.size());
    toHalf(columns, half);
    std::vector<float> back(columns.size());
    fromHalf(half, back);
    for (std::size_t i = 0; i < back.size(); ++i)
      error += (double(back[i]) - columns[i]) * (double(back[i]) - columns[i]);
  }
  squares_[sample] = square, errors_[sample] = error;
}

/// Mean of other samples' matrices, as they are stored.
void MatrixPacker::fill(std::uint32_t target, std::span<const std::uint32_t> sources) {
  const std::size_t size = layout_.sampleSize();
  for (std::size_t e = 0; e < size; ++e) {
    float sum = 0;
    for (const std::uint32_t s : sources)
      sum += array_.dtype == DType::f32 ? floats()[s * size + e] : fromHalf(halves()[s * size + e]);
    sum /= float(sources.size());
    if (array_.dtype == DType::f32) {
      floats()[target * size + e] = sum;
    } else {
      halves()[target * size + e] = toHalf(sum);
    }
  }
}

Array MatrixPacker::take(const BuriedFill& buried, double& storageError) {
  for (std::size_t i = 0; i < buried.size(); ++i) fill(buried.target(i), buried.sources(i));
  double square = 0, error = 0;
  for (std::size_t s = 0; s < layout_.samples; ++s) square += squares_[s], error += errors_[s];
  storageError = square > 0 ? std::sqrt(error / square) : 0;
  return std::move(array_);
}

Array packedMatrices(std::span<const float> matrices, std::size_t samples, int channels, int bands,
                     DType storage) {
  const MatrixLayout layout{samples, std::size_t(channels), std::size_t(shCount(bands))};
  if (matrices.size() != layout.size())
    throw ValueError(
        "matrices hold " + std::to_string(matrices.size()) + " numbers, not " + std::to_string(layout.size()),
        "transfer", "give [S, n^2, n^2] or [S, n^2, n^2, 3]");
  MatrixPacker packer(layout, storage);
  for (std::size_t s = 0; s < samples; ++s) packer.pack(s, matrices.data() + s * layout.sampleSize());
  double ignored;
  return packer.take({}, ignored);
}

}  // namespace prt
