#pragma once
// Which rays a bake sends, in which order, and what is known about their directions. Internal to transport.
//
// Every sample has a local frame (z = the axis that its rays spread around) and takes one of kScrambles
// Owen-scrambled Sobol sets of local directions, turned about z by an angle of its own. So neighbours
// share no pattern, yet the values of the basis functions along the rays come from few shared tables and
// sums over rays are small matrix products. Frame, set and angle follow from the sample's origin and the
// seed alone: vertices split at a texture seam keep the same value, and any ray can be traced again.
//
// Sums run over rays in the order of their numbers, one addition after the other, so they are the same
// bits however the rays are cut into chunks; only tracing follows another, coherent order.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/transport/sample_set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// How rays spread over the hemisphere.
enum class RaySpread {
  Uniform,  ///< around the geometric normal, density 1/2pi
  Cosine    ///< around the shading normal, density cos/pi; those below the geometric horizon count as blocked
};

inline constexpr int kScrambles = 8;
/// Samples of one parallel tile, and the most rays per sample traced in one go.
inline constexpr std::size_t kBakeTile = 128;
inline constexpr int kChunkRays = 1024;

/// Which part of the bake ends where: level i is complete with levelEnds[i] rays per sample. The first
/// level is quick, later ones double.
std::vector<int> bakeLevels(int rays);

/// Local frame of a sample: z = spread axis, turned by the sample's own angle.
Frame bakeFrame(const SampleSet& samples, std::size_t sample, RaySpread spread, std::uint64_t seed);
/// Direction set of a sample, 0 .. kScrambles-1.
int bakeScramble(const SampleSet& samples, std::size_t sample, std::uint64_t seed);

/// Local directions and basis functions of rays [begin, end) of every scramble.
class RayTable {
 public:
  /// Functions are tabulated for `bands` bands. end - begin <= kChunkRays.
  RayTable(RaySpread spread, int bands, int begin, int end, std::uint64_t seed, Job& job);

  int begin() const { return begin_; }
  int size() const { return size_; }
  /// Directions in tracing order: 16 neighbours share a cell of the hemisphere.
  std::span<const float> x(int scramble) const { return part(x_, scramble); }
  std::span<const float> y(int scramble) const { return part(y_, scramble); }
  std::span<const float> z(int scramble) const { return part(z_, scramble); }
  /// Number, from begin(), of the ray at each place of the tracing order.
  std::span<const std::uint16_t> order(int scramble) const {
    return {order_.data() + std::size_t(scramble) * size_, std::size_t(size_)};
  }
  /// Functions in column blocks of kColumns: element ((block * size() + ray) * kColumns + column) is
  /// Y_(block * kColumns + column) of ray begin() + ray; columns beyond the last function are zero.
  const float* functions(int scramble) const { return functions_.data() + std::size_t(scramble) * stride_; }
  int blocks() const { return blocks_; }

  static constexpr int kColumns = 16;

 private:
  std::span<const float> part(const std::vector<float>& all, int scramble) const {
    return {all.data() + std::size_t(scramble) * size_, std::size_t(size_)};
  }
  void fill(RaySpread spread, int bands, int scramble, std::uint64_t seed);

  int begin_, size_, blocks_;
  std::size_t stride_;  // of functions_, per scramble
  std::vector<float> x_, y_, z_, functions_;
  std::vector<std::uint16_t> order_;
};

/// Floats to keep for sums of `functions` functions: whole column blocks.
constexpr int sumStride(int functions) {
  return (functions + RayTable::kColumns - 1) / RayTable::kColumns * RayTable::kColumns;
}

/// sums[i][c] += sum over rays r, in order, of weights[i][r] * columns[r][c], for all rows i. `columns` is
/// laid out as RayTable::functions with `blocks` blocks; `sums[i]` takes blocks * kColumns numbers.
void accumulateProducts(const float* columns, int rays, int blocks, int rows, const float* const* weights,
                        float* const* sums);

/// World directions of a sample's rays in tracing order.
struct WorldRays {
  std::vector<float> x, y, z;
  /// Grows to the table's size and fills.
  void turn(const RayTable& table, int scramble, const Frame& frame);
};

}  // namespace prt
