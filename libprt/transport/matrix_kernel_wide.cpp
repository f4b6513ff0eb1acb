// Compiled for x86-64-v4 (see CMakeLists.txt): include nothing here that defines functions used elsewhere.
#include "libprt/transport/matrix_kernel.h"

#include <immintrin.h>

namespace prt {
namespace {

using Floats = float __attribute__((vector_size(64), aligned(4), may_alias));

template <int Width>
inline Floats load(const float* p) {
  return *reinterpret_cast<const Floats*>(p);
}

template <int Width>
inline Floats load(const std::uint16_t* p) {
  // The unmasked intrinsic makes GCC 12 warn of an uninitialised value inside of it.
  return Floats(_mm512_maskz_cvtph_ps(0xffff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))));
}

}  // namespace
}  // namespace prt

#include "libprt/transport/matrix_kernel_body.h"

namespace prt {

void multiplyMatricesWide(const std::uint16_t* halves, const MatrixProduct& product) {
  multiplyForChannels<16>(halves, product);
}
void multiplyMatricesWide(const float* floats, const MatrixProduct& product) {
  multiplyForChannels<16>(floats, product);
}

}  // namespace prt
