#include "libprt/core/cpu.h"

#include <unistd.h>

#include <cstddef>

namespace {

void say(const char* text) {
  std::size_t length = 0;
  while (text[length] != 0) ++length;
  if (::write(2, text, length) < 0) return;  // nowhere to say it
}

/// Runs before the constructors of all other global objects, which may use any instruction.
[[gnu::constructor(101)]] void guardCpu() {
  const char* problem = prt::cpuProblem();
  if (!problem) return;
  say("prt: ");
  say(problem);
  say("\n");
  ::_exit(1);
}

}  // namespace
