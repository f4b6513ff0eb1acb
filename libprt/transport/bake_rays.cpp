#include "libprt/transport/bake_rays.h"

#include "libprt/basis/sh.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace prt {
namespace {

constexpr int kColumns = RayTable::kColumns;
constexpr int kFirstLevel = 16;  // so that a picture comes at once

std::uint64_t originKey(const SampleSet& samples, std::size_t sample, std::uint64_t seed) {
  const Vec3 p = samples.origin[sample] + 0.0f;  // -0 and 0 are one place
  const std::uint64_t xy =
      std::uint64_t(std::bit_cast<std::uint32_t>(p.x)) << 32 | std::bit_cast<std::uint32_t>(p.y);
  return hashBits(seed, xy, std::bit_cast<std::uint32_t>(p.z));
}

/// Places of directions in an order in which 16 neighbours share a cell: cells of equal solid angle, four
/// times as many around as up, row by row, there and back.
std::vector<std::uint16_t> tracingOrder(std::span<const Vec3> directions, std::span<const float> height) {
  const int cells = std::max<int>(1, int(directions.size()) / 16);
  const int rows = std::max(1, int(std::lround(std::sqrt(cells / 4.0)))), columns = std::max(1, cells / rows);
  std::vector<std::uint32_t> key(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const int row = std::min(rows - 1, int(height[i] * float(rows)));
    const int column = std::min(columns - 1, int(turnsOf(directions[i].x, directions[i].y) * float(columns)));
    key[i] = std::uint32_t(row * columns + (row % 2 ? columns - 1 - column : column));
  }
  std::vector<std::uint16_t> order(directions.size());
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint16_t a, std::uint16_t b) { return key[a] < key[b]; });
  return order;
}

// One 8-float vector; the compiler splits it where the machine has none.
using Float8 = float __attribute__((vector_size(32), aligned(4), may_alias));

/// `Rows` rows of weights times one block of columns.
template <int Rows>
void accumulateBlock(const float* columns, int rays, const float* const* weights, float* const* sums,
                     int column) {
  constexpr int kVectors = kColumns / 8;
  Float8 sum[Rows][kVectors];
  for (int s = 0; s < Rows; ++s)
    for (int v = 0; v < kVectors; ++v) sum[s][v] = *reinterpret_cast<const Float8*>(sums[s] + column + 8 * v);
  for (int r = 0; r < rays; ++r, columns += kColumns) {
    const auto* y = reinterpret_cast<const Float8*>(columns);
    for (int s = 0; s < Rows; ++s) {
      const float weight = weights[s][r];
      for (int v = 0; v < kVectors; ++v) sum[s][v] += weight * y[v];
    }
  }
  for (int s = 0; s < Rows; ++s)
    for (int v = 0; v < kVectors; ++v) *reinterpret_cast<Float8*>(sums[s] + column + 8 * v) = sum[s][v];
}

}  // namespace

std::vector<int> bakeLevels(int rays) {
  std::vector<int> ends;
  for (int end = kFirstLevel; end < rays; end *= end < kChunkRays ? 4 : 2) ends.push_back(end);
  ends.push_back(rays);
  return ends;
}

Frame bakeFrame(const SampleSet& samples, std::size_t sample, RaySpread spread, std::uint64_t seed) {
  const Frame frame = frameFromNormal(spread == RaySpread::Uniform ? samples.geometricNormal[sample]
                                                                   : samples.shadingNormal[sample]);
  float sine, cosine;
  sinCosTurns(unitFloat(std::uint32_t(originKey(samples, sample, seed))), sine, cosine);
  return {cosine * frame.tangent + sine * frame.bitangent, cosine * frame.bitangent - sine * frame.tangent,
          frame.normal};
}

int bakeScramble(const SampleSet& samples, std::size_t sample, std::uint64_t seed) {
  return int(originKey(samples, sample, seed) >> 32) & (kScrambles - 1);
}

RayTable::RayTable(RaySpread spread, int bands, int begin, int end, std::uint64_t seed, Job& job)
    : begin_(begin), size_(end - begin), blocks_(sumStride(shCount(bands)) / kColumns) {
  const std::size_t all = std::size_t(size_) * kScrambles;
  stride_ = std::size_t(size_) * blocks_ * kColumns;
  x_.resize(all), y_.resize(all), z_.resize(all), order_.resize(all);
  functions_.resize(stride_ * kScrambles);
  parallelFor(job, 0, kScrambles, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) fill(spread, bands, int(s), hashBits(seed, s, 1));
  });
}

void RayTable::fill(RaySpread spread, int bands, int scramble, std::uint64_t seed) {
  const auto count = std::size_t(size_);
  std::vector<float> u(count), v(count), height(count), values(count * shCount(bands));
  sobolFill(std::uint32_t(begin_), 0, seed, u);
  sobolFill(std::uint32_t(begin_), 1, seed, v);
  std::vector<Vec3> d(count);
  for (std::size_t r = 0; r < count; ++r) {
    d[r] = spread == RaySpread::Uniform ? sampleUniformHemisphere({u[r], v[r]})
                                        : sampleCosineHemisphere({u[r], v[r]});
    height[r] = spread == RaySpread::Uniform ? d[r].z : d[r].z * d[r].z;  // uniform in [0, 1)
    shEvaluate(bands, d[r], std::span(values).subspan(r * shCount(bands), shCount(bands)));
  }
  const std::vector<std::uint16_t> order = tracingOrder(d, height);
  const std::size_t at = std::size_t(scramble) * count;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& direction = d[order[i]];
    x_[at + i] = direction.x, y_[at + i] = direction.y, z_[at + i] = direction.z;
    order_[at + i] = order[i];
  }
  float* out = functions_.data() + std::size_t(scramble) * stride_;
  for (int b = 0; b < blocks_; ++b)
    for (std::size_t r = 0; r < count; ++r)
      for (int c = 0; c < kColumns; ++c, ++out)
        *out = b * kColumns + c < shCount(bands) ? values[r * shCount(bands) + b * kColumns + c] : 0.0f;
}

void accumulateProducts(const float* columns, int rays, int blocks, int rows, const float* const* weights,
                        float* const* sums) {
  // A block of columns stays in the cache while all rows pass over it.
  for (int b = 0; b < blocks; ++b, columns += std::size_t(rays) * kColumns) {
    int row = 0;
    for (; row + 4 <= rows; row += 4)
      accumulateBlock<4>(columns, rays, weights + row, sums + row, b * kColumns);
    if (rows - row == 3) accumulateBlock<3>(columns, rays, weights + row, sums + row, b * kColumns);
    if (rows - row == 2) accumulateBlock<2>(columns, rays, weights + row, sums + row, b * kColumns);
    if (rows - row == 1) accumulateBlock<1>(columns, rays, weights + row, sums + row, b * kColumns);
  }
}

void WorldRays::turn(const RayTable& table, int scramble, const Frame& frame) {
  const auto count = std::size_t(table.size());
  x.resize(count), y.resize(count), z.resize(count);
  const float *lx = table.x(scramble).data(), *ly = table.y(scramble).data(), *lz = table.z(scramble).data();
  const Vec3 t = frame.tangent, b = frame.bitangent, n = frame.normal;
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = t.x * lx[i] + b.x * ly[i] + n.x * lz[i];
    y[i] = t.y * lx[i] + b.y * ly[i] + n.y * lz[i];
    z[i] = t.z * lx[i] + b.z * ly[i] + n.z * lz[i];
  }
}

}  // namespace prt
