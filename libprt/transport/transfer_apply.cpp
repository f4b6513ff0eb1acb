// Applying stored transfer to light.

#include "libprt/basis/sh_product.h"
#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/cluster_transfer.h"
#include "libprt/transport/matrix_kernel.h"
#include "libprt/transport/matrix_store.h"
#include "libprt/transport/transfer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace prt {
namespace {

using Float8 = float __attribute__((vector_size(32), aligned(4), may_alias));

/// Which samples are asked for: all, or a list.
struct Selection {
  std::optional<std::span<const std::uint32_t>> list;
  std::size_t all;

  std::size_t size() const { return list ? list->size() : all; }
  std::size_t at(std::size_t i) const { return list ? (*list)[i] : i; }
};

void check(const Transfer& transfer, const Selection& selection) {
  if (!selection.list) return;
  for (const std::uint32_t s : *selection.list)
    if (s >= transfer.samples)
      throw ValueError("sample " + std::to_string(s) + " of " + std::to_string(transfer.samples), "transfer",
                       "ask for samples that were baked");
}

/// The light at the transfer's number of bands.
std::vector<Rgb> fitted(const ShRgb& light, int bands) {
  std::vector<Rgb> c = light.c;
  c.resize(std::size_t(shCount(bands)), Rgb(0));
  return c;
}

inline Float8 load8(const float* p) {
  return *reinterpret_cast<const Float8*>(p);
}

// ---- Matrix ----

/// Runs of consecutive samples [first, first + count) that are wanted at `result`; matrices at the end of the
/// array are copied first, since the kernels read a little beyond what they use.
template <class T>
void multiplyRun(const MatrixLayout& layout, const T* matrices, std::size_t first, std::size_t count,
                 const std::vector<Rgb>& light, Rgb* result) {
  const auto run = [&](const T* from, std::size_t samples, Rgb* to) {
    const MatrixProduct product{samples, layout.channels, layout.functions, &light[0].x, &to[0].x};
    wideKernelRuns() ? multiplyMatricesWide(from, product) : multiplyMatrices(from, product);
  };
  const std::size_t size = layout.sampleSize(), last = (kKernelOverread + size - 1) / size;
  const std::size_t end = layout.samples - std::min(layout.samples, last);  // what may be read in place
  const std::size_t inPlace = std::min(count, end - std::min(end, first)), copied = count - inPlace;
  if (inPlace > 0) run(matrices + first * size, inPlace, result);
  if (copied == 0) return;
  std::vector<T> padded(copied * size + kKernelOverread);
  std::copy_n(matrices + (first + inPlace) * size, copied * size, padded.begin());
  run(padded.data(), copied, result + inPlace * layout.functions);
}

template <class T>
void applyMatrix(const Transfer& transfer, const std::vector<Rgb>& light, const Selection& selection,
                 Rgb* result) {
  const MatrixLayout layout{transfer.samples, std::size_t(transfer.channels),
                            std::size_t(transfer.functions())};
  const T* matrices = transfer.values.as<T>().data();
  Job job;
  parallelFor(job, 0, selection.size(), 256, [&](std::size_t begin, std::size_t end) {
    if (!selection.list)
      return multiplyRun(layout, matrices, begin, end - begin, light, result + begin * layout.functions);
    for (std::size_t i = begin, count = 0; i < end; i += count) {
      for (count = 1; i + count < end && selection.at(i + count) == selection.at(i) + count;) ++count;
      multiplyRun(layout, matrices, selection.at(i), count, light, result + i * layout.functions);
    }
  });
}

// ---- Visibility ----

/// The light as a matrix on visibility coefficients: (T L)_i = sum over k of v_k B_ki with
/// B_ki = sum over j of G_ijk L_j. Rows k are padded to a multiple of 8 floats.
struct VisibilityLight {
  std::size_t wide, stride;
  std::vector<float> rows;

  VisibilityLight(int bands, const std::vector<Rgb>& light)
      : wide(std::size_t(shCount(2 * bands - 1))),
        stride((std::size_t(shCount(bands)) * 3 + 7) / 8 * 8),
        rows(wide * stride, 0.0f) {
    for (const GauntTensor::Entry& g : gauntTensor(bands, bands, 2 * bands - 1).entries())
      for (int c = 0; c < 3; ++c)
        rows[g.k * stride + std::size_t(g.i) * 3 + std::size_t(c)] += float(g.value) * light[g.j][c];
  }
};

/// Rows of floats, `stride` apart, a multiple of 8.
struct FloatRows {
  const float* first;
  std::size_t count, stride;
};

template <int Vectors>
void multiplyRows(const float* v, const FloatRows& rows, std::size_t at, float* sum) {
  Float8 acc[Vectors] = {};
  for (std::size_t k = 0; k < rows.count; ++k) {
    const float* row = rows.first + k * rows.stride + at;
    for (int i = 0; i < Vectors; ++i) acc[i] += v[k] * load8(row + 8 * i);
  }
  for (int i = 0; i < Vectors; ++i) *reinterpret_cast<Float8*>(sum + at + std::size_t(8 * i)) = acc[i];
}

/// sum[stride] = v times the rows, ten vectors of columns at a time.
void multiplyRows(const float* v, const FloatRows& rows, float* sum) {
  std::size_t at = 0;
  for (; at + 80 <= rows.stride; at += 80) multiplyRows<10>(v, rows, at, sum);
  for (; at < rows.stride; at += 8) multiplyRows<1>(v, rows, at, sum);
}

/// Row `sample` of a [S, width] array, as f32; `buffer` serves when it is stored as f16.
const float* rowOf(const Array& array, std::size_t width, std::size_t sample, std::vector<float>& buffer) {
  if (array.dtype == DType::f32) return array.as<float>().data() + sample * width;
  buffer.resize(width);
  fromHalf(array.as<std::uint16_t>().subspan(sample * width, width), buffer);
  return buffer.data();
}

void applyVisibility(const Transfer& transfer, const std::vector<Rgb>& light, const Selection& selection,
                     Rgb* result) {
  const VisibilityLight matrix(transfer.bands, light);
  const auto functions = std::size_t(transfer.functions());
  Job job;
  parallelFor(job, 0, selection.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<float> buffer, sum(matrix.stride);
    for (std::size_t i = begin; i < end; ++i) {
      multiplyRows(rowOf(transfer.values, matrix.wide, selection.at(i), buffer),
                   {matrix.rows.data(), matrix.wide, matrix.stride}, sum.data());
      std::copy_n(sum.data(), functions * 3, &result[i * functions].x);
    }
  });
}

// ---- Matrix, clustered ----

void applyClusters(const Transfer& transfer, const std::vector<Rgb>& light, const Selection& selection,
                   Rgb* result) {
  const LitClusters lit(transfer, light);
  const auto functions = std::size_t(transfer.functions()), terms = lit.rows - 1;
  const auto cluster = transfer.cluster.as<std::uint32_t>();
  const auto weights = transfer.values.as<std::uint16_t>();
  Job job;
  parallelFor(job, 0, selection.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<float> v(lit.rows, 1.0f), sum(lit.stride);  // the mean once
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t s = selection.at(i);
      fromHalf(weights.subspan(s * terms, terms), std::span(v).subspan(1));
      multiplyRows(v.data(), {lit.values.data() + cluster[s] * lit.rows * lit.stride, lit.rows, lit.stride},
                   sum.data());
      std::copy_n(sum.data(), functions * 3, &result[i * functions].x);
    }
  });
}

// ---- All forms ----

void apply(const Transfer& transfer, const ShRgb& light, const Selection& selection, Rgb* result) {
  check(transfer, selection);
  const std::vector<Rgb> c = fitted(light, transfer.bands);
  switch (transfer.form) {
    case TransferForm::None:
      for (std::size_t i = 0; i < selection.size(); ++i) std::copy(c.begin(), c.end(), result + i * c.size());
      return;
    case TransferForm::Visibility:
      return applyVisibility(transfer, c, selection, result);
    case TransferForm::Matrix:
      if (transfer.clustered()) return applyClusters(transfer, c, selection, result);
      return transfer.values.dtype == DType::f16 ? applyMatrix<std::uint16_t>(transfer, c, selection, result)
                                                 : applyMatrix<float>(transfer, c, selection, result);
    case TransferForm::Diffuse:
      break;
  }
  throw ValueError("diffuse vectors hold no transferred radiance", "transfer",
                   "bake the visibility or matrix form");
}

/// Irradiance coefficients of light that nothing blocks: E(n) = sum of A_l L_lm Y_lm(n).
std::vector<Rgb> convolvedWithCosine(std::vector<Rgb> c, int bands) {
  double factorial = 1;  // (l choose l/2) / 2^l for even l
  for (int l = 0; l < bands; ++l) {
    double a = 0;
    if (l == 1) a = 2 * kPi / 3;
    if (l % 2 == 0) {
      if (l > 0) factorial *= (l - 1.0) / l;
      const double sign = l == 0 ? -1 : l % 4 == 2 ? 1 : -1;  // of (-1)^(l/2-1), and (l+2)(l-1) < 0 at l = 0
      a = 2 * kPi * sign / ((l + 2.0) * (l - 1.0)) * factorial;
    }
    for (int m = -l; m <= l; ++m) c[std::size_t(shIndex(l, m))] *= float(a);
  }
  return c;
}

std::vector<Rgb> unblockedIrradiance(const Transfer& transfer, const std::vector<Rgb>& light,
                                     std::span<const Vec3> normals, const Selection& selection) {
  const std::vector<Rgb> e = convolvedWithCosine(light, transfer.bands);
  std::vector<Rgb> result(selection.size());
  Job job;
  parallelFor(job, 0, result.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<float> y(e.size());
    for (std::size_t i = begin; i < end; ++i) {
      shEvaluate(transfer.bands, normals[selection.at(i)], y);
      Rgb sum(0);
      for (std::size_t k = 0; k < e.size(); ++k) sum += y[k] * e[k];
      result[i] = sum;
    }
  });
  return result;
}

/// Dot products of [S, n^2] or [S, n^2, 3] vectors with the light.
std::vector<Rgb> dotProducts(const Array& vectors, int channels, const std::vector<Rgb>& light,
                             const Selection& selection) {
  const std::size_t width = light.size() * std::size_t(channels);
  std::vector<Rgb> result(selection.size());
  Job job;
  parallelFor(job, 0, result.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<float> buffer;
    for (std::size_t i = begin; i < end; ++i) {
      const float* e = rowOf(vectors, width, selection.at(i), buffer);
      Rgb sum(0);
      if (channels == 1)
        for (std::size_t k = 0; k < light.size(); ++k) sum += e[k] * light[k];
      else
        for (std::size_t k = 0; k < light.size(); ++k)
          sum += Rgb(e[3 * k], e[3 * k + 1], e[3 * k + 2]) * light[k];
      result[i] = sum;
    }
  });
  return result;
}

std::vector<Rgb> irradianceOf(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals,
                              const Selection& selection) {
  check(transfer, selection);
  const std::vector<Rgb> c = fitted(light, transfer.bands);
  if (transfer.form == TransferForm::None) {
    if (normals.size() != transfer.samples)
      throw ValueError("unshadowed irradiance needs a normal per sample", "transfer",
                       "give [S] shading normals");
    return unblockedIrradiance(transfer, c, normals, selection);
  }
  return dotProducts(transfer.form == TransferForm::Diffuse ? transfer.values : transfer.diffuse,
                     transfer.channels, c, selection);
}

}  // namespace

std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals) {
  return irradianceOf(transfer, light, normals, {std::nullopt, transfer.samples});
}

std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals,
                            std::span<const std::uint32_t> samples) {
  return irradianceOf(transfer, light, normals, {samples, transfer.samples});
}

std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light) {
  std::vector<Rgb> result(transfer.samples * std::size_t(transfer.functions()));
  apply(transfer, light, {std::nullopt, transfer.samples}, result.data());
  return result;
}

void transferredRadiance(const Transfer& transfer, const ShRgb& light, std::span<Rgb> result) {
  if (result.size() != transfer.samples * std::size_t(transfer.functions()))
    throw ValueError("result has room for " + std::to_string(result.size()) + " coefficients", "transfer",
                     "give samples x bands^2");
  apply(transfer, light, {std::nullopt, transfer.samples}, result.data());
}

std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light,
                                     std::span<const std::uint32_t> samples) {
  std::vector<Rgb> result(samples.size() * std::size_t(transfer.functions()));
  apply(transfer, light, {samples, transfer.samples}, result.data());
  return result;
}

}  // namespace prt
