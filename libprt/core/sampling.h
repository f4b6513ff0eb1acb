#pragma once
// Sample numbers in [0, 1). All are pure functions of (seed, index, dimension): nothing is drawn from a
// stream, so results do not depend on threads or order, and any part can be computed again.
// - hash numbers: independent random numbers;
// - Owen-scrambled Sobol points: every prefix of 2^k points is stratified in every elementary interval,
//   every prefix is usable, and different seeds give independent unbiased scrambles. Error falls like
//   N^-3/2 for smooth functions, against N^-1/2 for random numbers.
// Sources: Joe and Kuo 2008 (direction numbers); Laine and Karras 2011, Burley 2020, "Practical
// Hash-based Owen Scrambling" (scrambling and padding by shuffled indices).
// Warps from the unit square to directions and shapes are in warp.h.

#include "libprt/core/math.h"

#include <cstdint>
#include <span>

namespace prt {

/// 64 well mixed bits for a 64-bit key: equal keys give equal bits, any other key unrelated ones.
constexpr std::uint64_t mixBits(std::uint64_t key) {
  key ^= key >> 32;
  key *= 0xd6e8feb86659fd93u;
  key ^= key >> 32;
  key *= 0xd6e8feb86659fd93u;
  key ^= key >> 32;
  return key;
}

/// 64 random bits of (seed, index, dimension).
constexpr std::uint64_t hashBits(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension = 0) {
  return mixBits(mixBits(seed + 0x9e3779b97f4a7c15u) + mixBits(index ^ 0xbf58476d1ce4e5b9u) * 3 +
                 dimension * 0x94d049bb133111ebu);
}

/// The upper 24 of 32 bits as a number in [0, 1); never rounds up to 1.
constexpr float unitFloat(std::uint32_t bits) {
  return float(bits >> 8) * 0x1p-24f;
}

/// A uniform random number in [0, 1).
constexpr float hashUniform(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension = 0) {
  return unitFloat(std::uint32_t(hashBits(seed, index, dimension) >> 32));
}

/// Dimensions whose points are stratified together. Dimension 8 and up start a new set of eight whose
/// points come in an order of their own: each set is stratified in itself, and unrelated to the others.
inline constexpr int kSobolDimensions = 8;

/// Coordinate `dimension` (0 and up) of Owen-scrambled Sobol point `index`, in [0, 1).
float sobol(std::uint32_t index, int dimension, std::uint64_t seed);
/// Coordinates `dimension` and `dimension + 1`: best with an even dimension.
Vec2 sobol2(std::uint32_t index, int dimension, std::uint64_t seed);

/// out[i] = sobol(first + i, dimension, seed), much faster (SIMD inside) for dimensions below
/// kSobolDimensions, which it requires (ValueError).
void sobolFill(std::uint32_t first, int dimension, std::uint64_t seed, std::span<float> out);

/// Owen's nested uniform scramble of 32 binary digits, the most significant first; a permutation that
/// keeps every aligned block of 2^k numbers an aligned block. Used on indices it makes a shuffled order
/// in which every prefix of 2^k is still a block.
std::uint32_t owenScramble(std::uint32_t digits, std::uint32_t seed);

/// One sample's coordinates taken one after the other: for code, such as a path tracer, that does not
/// know beforehand how many it needs.
class SobolStream {
 public:
  SobolStream(std::uint64_t seed, std::uint32_t index) : seed_(seed), index_(index) {}
  float next() { return sobol(index_, dimension_++, seed_); }
  /// Starts at an even dimension, so that both coordinates belong to one well stratified pair.
  Vec2 next2() {
    dimension_ += dimension_ & 1;
    const Vec2 u = sobol2(index_, dimension_, seed_);
    dimension_ += 2;
    return u;
  }

 private:
  std::uint64_t seed_;
  std::uint32_t index_;
  int dimension_ = 0;
};

}  // namespace prt
