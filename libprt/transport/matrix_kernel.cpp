#include "libprt/transport/matrix_kernel.h"

#ifdef __F16C__
#include <immintrin.h>
#else
#include "libprt/core/half.h"
#endif

namespace prt {
namespace {

using Floats = float __attribute__((vector_size(32), aligned(4), may_alias));

template <int Width>
inline Floats load(const float* p) {
  return *reinterpret_cast<const Floats*>(p);
}

template <int Width>
inline Floats load(const std::uint16_t* p) {
#ifdef __F16C__
  return Floats(_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))));
#else
  Floats out;
  for (int i = 0; i < 8; ++i) out[i] = fromHalf(p[i]);
  return out;
#endif
}

}  // namespace
}  // namespace prt

#include "libprt/transport/matrix_kernel_body.h"

namespace prt {

void multiplyMatrices(const std::uint16_t* halves, const MatrixProduct& product) {
  multiplyForChannels<8>(halves, product);
}
void multiplyMatrices(const float* floats, const MatrixProduct& product) {
  multiplyForChannels<8>(floats, product);
}

bool wideKernelRuns() {
  static const bool runs = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                           __builtin_cpu_supports("avx512cd");
  return runs;
}

}  // namespace prt
