// Stored transfer as plain arrays, for export and for whoever wants to look inside.

#include "libprt/basis/sh_product.h"
#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/transport/matrix_store.h"
#include "libprt/transport/memory_limit.h"
#include "libprt/transport/transfer.h"

#include <algorithm>

namespace prt {
namespace {

std::vector<float> asFloats(const Array& array) {
  std::vector<float> values(array.size());
  if (array.dtype == DType::f32)
    std::ranges::copy(array.as<float>(), values.begin());
  else
    fromHalf(array.as<std::uint16_t>(), values);
  return values;
}

/// Rows first, channels innermost, from columns first, channels outermost.
void expandColumns(const Transfer& transfer, const MatrixLayout& layout, std::span<float> out) {
  const std::size_t n = layout.functions, channels = layout.channels;
  std::vector<float> matrix(layout.sampleSize());
  for (std::size_t s = 0; s < layout.samples; ++s) {
    matrixOf(transfer, s, matrix);
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t column = 0; column < n; ++column)
        for (std::size_t row = 0; row < n; ++row)
          out[((s * n + row) * n + column) * channels + c] = matrix[(c * n + column) * n + row];
  }
}

/// `count` numbers from the at-th on.
void readFloats(const Array& array, std::size_t at, std::span<float> out) {
  if (array.dtype == DType::f16)
    fromHalf(array.as<std::uint16_t>().subspan(at, out.size()), out);
  else
    std::copy_n(array.as<float>().begin() + std::ptrdiff_t(at), out.size(), out.begin());
}

}  // namespace

void matrixOf(const Transfer& transfer, std::size_t sample, std::span<float> out) {
  if (!transfer.clustered()) return readFloats(transfer.values, sample * out.size(), out);
  const auto terms = std::size_t(transfer.values.shape[1]);
  const std::size_t first = transfer.cluster.as<std::uint32_t>()[sample] * (terms + 1) * out.size();
  readFloats(transfer.basis, first, out);
  std::vector<float> weights(terms), term(out.size());
  readFloats(transfer.values, sample * terms, weights);
  for (std::size_t t = 0; t < terms; ++t) {
    readFloats(transfer.basis, first + (t + 1) * out.size(), term);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weights[t] * term[i];
  }
}

Array expandedMatrices(const Transfer& transfer) {
  if (transfer.form == TransferForm::Diffuse)
    throw ValueError("diffuse vectors are not matrices", "transfer", "bake the visibility or matrix form");
  const MatrixLayout layout{transfer.samples, std::size_t(transfer.channels),
                            std::size_t(transfer.functions())};
  const std::size_t one = layout.functions * layout.functions * layout.channels;
  requireMemory(layout.samples * one * sizeof(float), "expanded transfer matrices",
                "export fewer samples or bands");
  const auto n = std::int64_t(layout.functions);
  Array array{DType::f32,
              {std::int64_t(layout.samples), n, n},
              std::vector<std::byte>(layout.samples * one * sizeof(float))};
  if (layout.channels == 3) array.shape.push_back(3);
  const std::span<float> out(reinterpret_cast<float*>(array.bytes.data()), layout.samples * one);
  if (transfer.form == TransferForm::Matrix) expandColumns(transfer, layout, out);
  if (transfer.form == TransferForm::None)
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = i % one / layout.functions == i % layout.functions ? 1.0f : 0.0f;
  if (transfer.form == TransferForm::Visibility) {
    const std::vector<float> v = asFloats(transfer.values);
    const auto wide = std::size_t(shCount(2 * transfer.bands - 1));
    for (std::size_t s = 0; s < layout.samples; ++s)
      expandVisibility(transfer.bands, std::span(v).subspan(s * wide, wide), out.subspan(s * one, one));
  }
  return array;
}

Array diffuseVectors(const Transfer& transfer) {
  if (transfer.form == TransferForm::None)
    throw ValueError("unshadowed transfer stores no vectors", "transfer",
                     "use irradiance() with the normals");
  const Array& from = transfer.form == TransferForm::Diffuse ? transfer.values : transfer.diffuse;
  const std::vector<float> values = asFloats(from);
  return Array::from(std::span<const float>(values), from.shape);
}

}  // namespace prt
