#include "libprt/core/sampling.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace prt {
namespace {

// Sobol numbers are kept with their digits reversed (least significant bit = first binary digit after the
// point): the scramble is a function that carries from low to high bits only.

constexpr std::uint32_t reverseBits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// A primitive polynomial over GF(2), degree and inner coefficients, with its first direction numbers.
struct Polynomial {
  int degree;
  std::uint32_t inner;
  std::array<std::uint32_t, 5> first;
};

// Dimensions 1..7 of Joe and Kuo's set; dimension 0 is van der Corput's radical inverse.
constexpr std::array<Polynomial, kSobolDimensions - 1> kPolynomials{{{1, 0, {1}},
                                                                     {2, 1, {1, 3}},
                                                                     {3, 1, {1, 3, 1}},
                                                                     {3, 2, {1, 1, 1}},
                                                                     {4, 1, {1, 1, 3, 3}},
                                                                     {4, 4, {1, 3, 5, 13}},
                                                                     {5, 2, {1, 1, 5, 5, 17}}}};

/// What each binary digit of the index contributes; the first digit after the point is the top bit.
constexpr std::array<std::uint32_t, 32> directionNumbers(int dimension) {
  std::array<std::uint32_t, 32> v{};
  if (dimension == 0) {
    for (int k = 0; k < 32; ++k) v[k] = 1u << (31 - k);
    return v;
  }
  const Polynomial& p = kPolynomials[dimension - 1];
  for (int k = 0; k < p.degree; ++k) v[k] = p.first[k] << (31 - k);
  for (int k = p.degree; k < 32; ++k) {
    v[k] = v[k - p.degree] ^ (v[k - p.degree] >> p.degree);
    for (int i = 1; i < p.degree; ++i)
      if ((p.inner >> (p.degree - 1 - i)) & 1) v[k] ^= v[k - i];
  }
  return v;
}

/// ofByte[b][v]: what value v of byte b of the index contributes, digits reversed.
struct Dimension {
  std::array<std::array<std::uint32_t, 256>, 4> ofByte{};
};

struct Tables {
  std::array<Dimension, kSobolDimensions> dimension{};

  constexpr Tables() {
    for (int d = 0; d < kSobolDimensions; ++d) {
      const std::array<std::uint32_t, 32> v = directionNumbers(d);
      for (int byte = 0; byte < 4; ++byte)
        for (int value = 1; value < 256; ++value) {
          const int lowest = std::countr_zero(unsigned(value));
          auto& table = dimension[d].ofByte[byte];
          table[value] = table[value & (value - 1)] ^ reverseBits(v[8 * byte + lowest]);
        }
    }
  }
};

constexpr Tables kTables;

/// Contribution of all but the lowest byte of the index.
std::uint32_t reversedHighPart(std::uint32_t index, const Dimension& d) {
  return d.ofByte[1][(index >> 8) & 255] ^ d.ofByte[2][(index >> 16) & 255] ^ d.ofByte[3][index >> 24];
}

/// Each step changes a bit by a function of the lower ones and the seed only; the constants were chosen
/// for flips that are independent between digits of different prefixes.
constexpr std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x7a36f646u;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x59481916u;
  x ^= x * 0x5daafe0au;
  return x;
}

std::uint32_t seedOf(std::uint64_t seed, int dimension) {
  return std::uint32_t(hashBits(seed, 0x50b01, dimension));
}

}  // namespace

std::uint32_t owenScramble(std::uint32_t digits, std::uint32_t seed) {
  return reverseBits(scrambleReversed(reverseBits(digits), seed));
}

float sobol(std::uint32_t index, int dimension, std::uint64_t seed) {
  const int set = dimension / kSobolDimensions;
  const Dimension& d = kTables.dimension[dimension % kSobolDimensions];
  if (set > 0) index = owenScramble(index, seedOf(~seed, set));
  const std::uint32_t x = d.ofByte[0][index & 255] ^ reversedHighPart(index, d);
  return unitFloat(reverseBits(scrambleReversed(x, seedOf(seed, dimension))));
}

Vec2 sobol2(std::uint32_t index, int dimension, std::uint64_t seed) {
  return {sobol(index, dimension, seed), sobol(index, dimension + 1, seed)};
}

void sobolFill(std::uint32_t first, int dimension, std::uint64_t seed, std::span<float> out) {
  if (dimension < 0 || dimension >= kSobolDimensions)
    throw ValueError("no dimension " + std::to_string(dimension), "Sobol points", "use 0 to 7");
  const std::uint32_t scramble = seedOf(seed, dimension);
  const Dimension& d = kTables.dimension[dimension];
  constexpr std::uint32_t kBlock = 256;
  for (std::size_t done = 0; done < out.size();) {
    const std::uint32_t index = first + std::uint32_t(done), start = index & (kBlock - 1);
    const std::uint32_t high = reversedHighPart(index, d);
    const std::size_t count = std::min<std::size_t>(kBlock - start, out.size() - done);
    const std::uint32_t* low = d.ofByte[0].data() + start;
    float* to = out.data() + done;
    for (std::size_t i = 0; i < count; ++i)
      to[i] = unitFloat(reverseBits(scrambleReversed(low[i] ^ high, scramble)));
    done += count;
  }
}

}  // namespace prt
