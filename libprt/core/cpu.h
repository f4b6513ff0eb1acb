#pragma once
// Whether this machine's CPU has the instructions that the build uses (PRT_ARCH). This header and its
// sources are compiled for any x86-64 CPU, and call nothing that is not.

namespace prt {

/// One line that says what is missing, or null when nothing is.
const char* cpuProblem() noexcept;

// Programs link the target prt_cpu_guard: it checks before any other code of the program runs, says what is
// missing on stderr and ends with status 1.

}  // namespace prt
