#pragma once
// Ctrl-C (and SIGTERM): the first asks the job to stop, the second stops the program at once.

#include "libprt/core/job.h"

#include <csignal>
#include <thread>

namespace prt::cli {

class Interrupt {
 public:
  /// Blocks the signals in this thread and those it starts; make it before any other thread.
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// From now on a signal cancels the job, which must outlive this object.
  void watch(Job& job);

 private:
  sigset_t signals_;
  std::thread waiter_;
  std::atomic<bool> ending_{false};
};

}  // namespace prt::cli
