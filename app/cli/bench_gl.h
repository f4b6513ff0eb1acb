#pragma once
// The bench of OpenGL pictures: the library's benches know no OpenGL.

#include "libprt/study/bench.h"

namespace prt::cli {

/// As benches() has them; "gl".
const BenchInfo& glBenchInfo();

/// Frames of bench "biscale" drawn with OpenGL against the same ones on the CPU, medians of `repetitions` (0:
/// 60). Throws ResourceError on machines without OpenGL 4.5, Cancelled.
BenchResult runGlBench(Job& job, int repetitions);

}  // namespace prt::cli
