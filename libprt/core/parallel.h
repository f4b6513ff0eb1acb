#pragma once
// Parallel loops on oneTBB. Results never depend on the number of threads: the range is cut into
// fixed tiles of `grain` items whatever the thread count, and a body must write only what belongs to
// its own tile. Sums over tiles are made afterwards, in tile order, by the caller.

#include "libprt/core/job.h"

#include <cstddef>
#include <functional>

namespace prt {

/// Threads that parallel loops may use, the calling one included; 0 = all of this machine's.
/// Call it before the first loop or between tasks.
void setThreadCount(int count);
int threadCount();

/// Runs body(begin, end) on every tile [begin + i*grain, min(begin + (i+1)*grain, end)). Checks the
/// job for cancellation before each tile; Cancelled and other exceptions of a body are rethrown here
/// once every running tile has ended. Denormals are flushed to zero inside (kernels rely on it).
void parallelFor(Job& job, std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// While it lives, parallel loops that this thread starts, and those inside of them, are background work,
/// such as a bake behind an interface: they run in an arena of their own at lower priority than other loops
/// (threads go to those first) and their threads at lower OS priority (nice 10). With 4 threads or more one
/// is left free; with fewer that would cost too much, and the OS priority alone keeps an interface
/// responsive. This thread keeps the lower OS priority afterwards: use it on a thread made for such work.
class BackgroundWork {
 public:
  BackgroundWork();
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

 private:
  bool before_;
};

/// Sets flush-to-zero and denormals-are-zero on this thread for the life of the object.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace prt
