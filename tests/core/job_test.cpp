#include "libprt/core/job.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace prt {
namespace {

TEST(Job, CountsWorkFromManyThreads) {
  Job job;
  job.begin("count", 1000, "items");
  parallelFor(job, 0, 1000, 7, [&](std::size_t begin, std::size_t end) { job.advance(double(end - begin)); });
  EXPECT_EQ(job.snapshot().done, 1000);
  EXPECT_EQ(job.snapshot().fraction(), 1.0);
}

TEST(Job, CancelEndsALoopWithCancelled) {
  Job job;
  EXPECT_THROW(parallelFor(job, 0, 1000, 1,
                           [&](std::size_t begin, std::size_t) {
                             if (begin == 10) job.cancel();
                           }),
               Cancelled);
}

TEST(Job, PauseHoldsWorkUntilResumed) {
  Job job;
  job.pause();
  std::atomic<bool> passed{false};
  std::thread worker([&] { job.checkCancelled(), passed = true; });
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(passed);
  job.resume();
  worker.join();
  EXPECT_TRUE(passed);
}

TEST(Job, CancelWakesPausedWork) {
  Job job;
  job.pause();
  std::thread worker([&] { EXPECT_THROW(job.checkCancelled(), Cancelled); });
  job.cancel();
  worker.join();
}

TEST(Job, ListenerHearsTheEnd) {
  double last = 0;
  Job job([&](const Progress& p) { last = p.fraction(); });
  job.begin("work", 100, "items");
  for (int i = 0; i < 100; ++i) job.advance(1);
  EXPECT_EQ(last, 1.0);
}

TEST(Error, MessageIsOneLineWithWhatWhereAndFix) {
  const FileError error("is not\na mesh", "a.obj", "check the path");
  EXPECT_STREQ(error.what(), "a.obj: is not a mesh (check the path)");
}

}  // namespace
}  // namespace prt
