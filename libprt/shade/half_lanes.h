#pragma once
// Eight 16-bit floats at once. Internal to renderers.

#include "libprt/basis/sh_kernel.h"
#include "libprt/core/half.h"

#include <cstdint>

#ifdef __F16C__
#include <immintrin.h>
#endif

namespace prt {

inline sh_kernel::Lanes loadHalfs(const std::uint16_t* from) {
  using sh_kernel::Lanes;
#ifdef __F16C__
  return Lanes(_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
#else
  Lanes v;
  for (int i = 0; i < sh_kernel::kLanes; ++i) v[i] = fromHalf(from[i]);
  return v;
#endif
}

}  // namespace prt
