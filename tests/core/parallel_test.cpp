#include "libprt/core/parallel.h"
#include "libprt/core/error.h"
#include "libprt/core/job.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace prt {
namespace {

class Parallel : public testing::Test {
 protected:
  void TearDown() override { setThreadCount(0); }
};

int niceOfThisThread() {
  return ::getpriority(PRIO_PROCESS, id_t(::gettid()));
}

/// Runs `work` on a thread of its own, as background work lowers its thread for good.
void onOwnThread(const std::function<void()>& work) {
  std::thread(work).join();
}

TEST_F(Parallel, TilesDoNotDependOnTheThreadCount) {
  const auto tiles = [](int threads) {
    setThreadCount(threads);
    std::vector<int> firstOfTile(103, -1);
    Job job;
    parallelFor(job, 0, 103, 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) firstOfTile[i] = int(begin);
    });
    return firstOfTile;
  };
  EXPECT_EQ(tiles(1), tiles(4));
  EXPECT_EQ(tiles(1)[102], 100);
}

TEST_F(Parallel, ExceptionsOfABodyComeBack) {
  Job job;
  EXPECT_THROW(
      parallelFor(job, 0, 10, 1, [](std::size_t, std::size_t) { throw ValueError("bad", "here", ""); }),
      ValueError);
}

/// Most tiles that run at one time.
int widthOf(int tiles) {
  std::atomic<int> running{0}, most{0};
  Job job;
  parallelFor(job, 0, std::size_t(tiles), 1, [&](std::size_t, std::size_t) {
    const int now = ++running;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    --running;
  });
  return most;
}

TEST_F(Parallel, UsesAsManyThreadsAsItIsTold) {
  for (int threads : {1, 3}) {
    setThreadCount(threads);
    EXPECT_EQ(threadCount(), threads);
    EXPECT_LE(widthOf(40), threads);
  }
  EXPECT_GE(threadCount(), 1);
}

TEST_F(Parallel, BackgroundWorkLeavesAThreadFreeWhereThereAreFour) {
  onOwnThread([] {
    const BackgroundWork background;
    setThreadCount(4);
    EXPECT_LE(widthOf(60), 3);
    setThreadCount(2);
    int width = 0;  // a busy machine may not run the second thread at once
    for (int attempt = 0; attempt < 20 && width < 2; ++attempt) width = std::max(width, widthOf(60));
    EXPECT_EQ(width, 2);
  });
}

TEST_F(Parallel, BackgroundThreadsAreNicedAlsoInLoopsInsideLoops) {
  setThreadCount(3);
  const int before = niceOfThisThread();
  onOwnThread([] {
    const BackgroundWork background;
    Job job;
    std::mutex mutex;
    std::set<int> nices;
    parallelFor(job, 0, 30, 1, [&](std::size_t, std::size_t) {
      parallelFor(job, 0, 3, 1, [&](std::size_t, std::size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard lock(mutex);
        nices.insert(niceOfThisThread());
      });
    });
    EXPECT_EQ(nices.size(), 1u);
    EXPECT_GE(*nices.begin(), 10);
  });
  EXPECT_EQ(niceOfThisThread(), before);
}

TEST_F(Parallel, OtherLoopsGoOnWhileBackgroundWorkIsStuck) {
  setThreadCount(2);
  std::atomic<bool> release{false};
  std::atomic<int> stuck{0};
  std::thread bake([&] {
    const BackgroundWork background;
    Job job;
    parallelFor(job, 0, 2, 1, [&](std::size_t, std::size_t) {
      ++stuck;
      while (!release) std::this_thread::yield();
    });
  });
  while (stuck == 0) std::this_thread::yield();
  std::atomic<int> done{0};
  Job job;
  parallelFor(job, 0, 100, 1, [&](std::size_t, std::size_t) { ++done; });
  EXPECT_EQ(done, 100);
  release = true;
  bake.join();
}

TEST_F(Parallel, DenormalsAreFlushedInside) {
  Job job;
  volatile float tiny = 1e-38f;
  float inside = 1;
  parallelFor(job, 0, 1, 1, [&](std::size_t, std::size_t) { inside = tiny * 0.01f; });
  EXPECT_EQ(inside, 0);
  EXPECT_GT(tiny * 0.01f, 0) << "and not outside";
}

}  // namespace
}  // namespace prt
