#include "libprt/core/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <immintrin.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace prt {
namespace {

constexpr int kBackgroundNice = 10;
constexpr int kLeavesOneFree = 4;  // threads from which on background work leaves one free

thread_local bool inBackground = false;

/// What threads hand to each other through oneTBB, for ThreadSanitizer: the library itself is not built with
/// it, so that it does not see that tiles begin after the loop and end before it returns.
class Handover {
 public:
#ifdef __SANITIZE_THREAD__
  void give() {
    __tsan_release(this);
  }
  void take() {
    __tsan_acquire(this);
  }
#else
  void give() {}
  void take() {}
#endif
};

/// The loop: takes what its tiles made, also when one of them throws.
class TakenAtEnd {
 public:
  explicit TakenAtEnd(Handover& handover) : handover_(handover) {}
  ~TakenAtEnd() { handover_.take(); }
  TakenAtEnd(const TakenAtEnd&) = delete;
  TakenAtEnd& operator=(const TakenAtEnd&) = delete;

 private:
  Handover& handover_;
};

/// One tile: takes what the loop gives, gives what it made, however it ends.
class HandoverScope {
 public:
  explicit HandoverScope(Handover& handover) : handover_(handover) { handover_.take(); }
  ~HandoverScope() { handover_.give(); }
  HandoverScope(const HandoverScope&) = delete;
  HandoverScope& operator=(const HandoverScope&) = delete;

 private:
  Handover& handover_;
};

/// Says for its life whether this thread does background work.
class Standing {
 public:
  explicit Standing(bool background) : before_(std::exchange(inBackground, background)) {}
  ~Standing() { inBackground = before_; }
  Standing(const Standing&) = delete;
  Standing& operator=(const Standing&) = delete;

 private:
  bool before_;
};

/// On Linux every thread has a nice value of its own. Raising it is always allowed, lowering it is not, so
/// a worker that once did background work stays there.
void lowerOsPriority() {
  const auto thread = id_t(::gettid());
  if (::getpriority(PRIO_PROCESS, thread) < kBackgroundNice)
    ::setpriority(PRIO_PROCESS, thread, kBackgroundNice);
}

class LowerWorkers : public tbb::task_scheduler_observer {
 public:
  explicit LowerWorkers(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) { observe(true); }
  ~LowerWorkers() override { observe(false); }
  void on_scheduler_entry(bool isWorker) override {
    if (isWorker) lowerOsPriority();
  }
};

struct Arena {
  tbb::task_arena arena;
  std::unique_ptr<LowerWorkers> lowerWorkers;  // goes before the arena

  Arena(int threads, bool background)
      : arena(threads, 1, background ? tbb::task_arena::priority::low : tbb::task_arena::priority::normal) {
    if (!background) return;
    arena.initialize();
    lowerWorkers = std::make_unique<LowerWorkers>(arena);
  }
};

struct Pool {
  std::mutex mutex;
  int count = 0;
  std::array<std::shared_ptr<Arena>, 2> arenas;  // foreground, background
  std::unique_ptr<tbb::global_control> limit;    // lets an arena hold more threads than there are cores
};

Pool& pool() {
  static Pool instance;
  return instance;
}

int resolved(int count) {
  return count > 0 ? count : int(std::max(1u, std::thread::hardware_concurrency()));
}

std::shared_ptr<Arena> arenaFor(bool background) {
  Pool& p = pool();
  const std::lock_guard lock(p.mutex);
  std::shared_ptr<Arena>& arena = p.arenas[background];
  if (!arena) {
    const int threads = resolved(p.count);
    p.limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    std::size_t(std::max(threads, resolved(0))));
    arena =
        std::make_shared<Arena>(background && threads >= kLeavesOneFree ? threads - 1 : threads, background);
  }
  return arena;
}

}  // namespace

void setThreadCount(int count) {
  const std::lock_guard lock(pool().mutex);
  pool().count = std::max(0, count);
  for (auto& arena : pool().arenas) arena.reset();
}

int threadCount() {
  const std::lock_guard lock(pool().mutex);
  return resolved(pool().count);
}

void parallelFor(Job& job, std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  if (begin >= end) return;
  grain = std::max<std::size_t>(1, grain);
  const std::size_t tiles = (end - begin + grain - 1) / grain;
  const bool background = inBackground;
  Handover handover;
  const auto runTile = [&](std::size_t tile) {
    const HandoverScope scope(handover);
    job.checkCancelled();
    const FlushDenormals flush;
    const Standing standing(background);  // loops inside this one stay where it is
    const std::size_t first = begin + tile * grain;
    body(first, std::min(first + grain, end));
  };
  const auto used = arenaFor(background);  // kept alive should the thread count change meanwhile
  handover.give();
  const TakenAtEnd taken(handover);
  used->arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, tiles, std::size_t{1}, runTile, tbb::simple_partitioner()); });
}

BackgroundWork::BackgroundWork() : before_(std::exchange(inBackground, true)) {
  lowerOsPriority();
}
BackgroundWork::~BackgroundWork() {
  inBackground = before_;
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  _mm_setcsr(saved_ | 0x8040);
}
FlushDenormals::~FlushDenormals() {
  _mm_setcsr(saved_);
}

}  // namespace prt
