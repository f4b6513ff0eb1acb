#include "libprt/core/cpu.h"

namespace prt {

const char* cpuProblem() noexcept {
  __builtin_cpu_init();
#ifdef PRT_NEEDS_V3
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return "this CPU lacks AVX2 and FMA instructions, which this build needs (take a CPU from 2013 or later, "
           "or build "
           "with -DPRT_ARCH=baseline)";
  if (!__builtin_cpu_supports("x86-64-v3"))
    return "this CPU lacks some of the instructions BMI, BMI2, F16C, LZCNT and MOVBE, which this build needs "
           "(build with "
           "-DPRT_ARCH=baseline)";
#endif
#ifdef PRT_NEEDS_V4
  if (!__builtin_cpu_supports("x86-64-v4"))
    return "this CPU lacks AVX-512 instructions, which this build needs (build with -DPRT_ARCH=x86-64-v3)";
#endif
  return nullptr;
}

}  // namespace prt
