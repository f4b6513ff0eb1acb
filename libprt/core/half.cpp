#include "libprt/core/half.h"

#include <bit>
#include <stdexcept>

#ifdef __F16C__
#include <immintrin.h>
#endif

namespace prt {
namespace {

void requireSameSize(std::size_t a, std::size_t b) {
  if (a != b) throw std::length_error("half conversion: arrays of different size");
}

}  // namespace

std::uint16_t toHalf(float value) {
  return std::bit_cast<std::uint16_t>(static_cast<_Float16>(value));
}
float fromHalf(std::uint16_t bits) {
  return float(std::bit_cast<_Float16>(bits));
}

void toHalf(std::span<const float> values, std::span<std::uint16_t> bits) {
  requireSameSize(values.size(), bits.size());
  std::size_t i = 0;
#ifdef __F16C__
  for (; i + 8 <= values.size(); i += 8) {
    const __m128i packed = _mm256_cvtps_ph(_mm256_loadu_ps(values.data() + i), _MM_FROUND_TO_NEAREST_INT);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(bits.data() + i), packed);
  }
#endif
  for (; i < values.size(); ++i) bits[i] = toHalf(values[i]);
}

void fromHalf(std::span<const std::uint16_t> bits, std::span<float> values) {
  requireSameSize(values.size(), bits.size());
  std::size_t i = 0;
#ifdef __F16C__
  for (; i + 8 <= values.size(); i += 8) {
    const __m128i packed = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bits.data() + i));
    _mm256_storeu_ps(values.data() + i, _mm256_cvtph_ps(packed));
  }
#endif
  for (; i < values.size(); ++i) values[i] = fromHalf(bits[i]);
}

}  // namespace prt
