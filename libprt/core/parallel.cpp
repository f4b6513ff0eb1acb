#include "libprt/core/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <immintrin.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <thread>

namespace prt {
namespace {

struct Pool {
  std::mutex mutex;
  int count = 0;
  std::shared_ptr<tbb::task_arena> arena;
  std::unique_ptr<tbb::global_control> limit;  // lets an arena hold more threads than there are cores
};

Pool& pool() {
  static Pool instance;
  return instance;
}

int resolved(int count) {
  return count > 0 ? count : std::max(1u, std::thread::hardware_concurrency());
}

std::shared_ptr<tbb::task_arena> arena() {
  std::lock_guard lock(pool().mutex);
  Pool& p = pool();
  if (!p.arena) {
    const int threads = resolved(p.count);
    p.limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    std::size_t(std::max(threads, resolved(0))));
    p.arena = std::make_shared<tbb::task_arena>(threads);
  }
  return p.arena;
}

}  // namespace

void setThreadCount(int count) {
  std::lock_guard lock(pool().mutex);
  pool().count = std::max(0, count);
  pool().arena.reset();
}

int threadCount() {
  std::lock_guard lock(pool().mutex);
  return resolved(pool().count);
}

void parallelFor(Job& job, std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  if (begin >= end) return;
  grain = std::max<std::size_t>(1, grain);
  const std::size_t tiles = (end - begin + grain - 1) / grain;
  const auto runTile = [&](std::size_t tile) {
    job.checkCancelled();
    const FlushDenormals flush;
    const std::size_t first = begin + tile * grain;
    body(first, std::min(first + grain, end));
  };
  const auto used = arena();  // kept alive should the thread count change meanwhile
  used->execute([&] {
    tbb::parallel_for(std::size_t{0}, tiles, std::size_t{1}, runTile, tbb::simple_partitioner());
  });
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }

}  // namespace prt
