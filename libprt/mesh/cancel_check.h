#pragma once
// Cancellation in tight loops.

#include "libprt/core/job.h"

#include <cstdint>

namespace prt {

/// Looks at a job once in many calls; throws Cancelled then.
class CancelCheck {
 public:
  explicit CancelCheck(Job& job) : job_(job) {}
  void operator()() {
    if (++calls_ % 32768 == 0) job_.checkCancelled();
  }

 private:
  Job& job_;
  std::uint32_t calls_ = 0;
};

}  // namespace prt
