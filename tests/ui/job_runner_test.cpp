#include "ui/model/job_runner.h"

#include "libprt/core/error.h"
#include "tests/ui/wait.h"

#include <gtest/gtest.h>

#include <QThread>

#include <atomic>

namespace prt::ui {
namespace {

using test::waitFor;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

// Runs until it is cancelled.
void forever(Job& job) {
  for (;;) {
    job.checkCancelled();
    QThread::msleep(1);
  }
}

TEST(JobRunner, DeliversProgressAndTheEndOnItsOwnThread) {
  JobRunner runner;
  std::vector<double> seen;
  bool ended = false;
  QObject::connect(&runner, &JobRunner::changed, [&](quint64 id) {
    EXPECT_EQ(QThread::currentThread(), runner.thread());
    seen.push_back(runner.find(id)->progress.done);
  });
  runner.start(
      s("count"), s("Counting"),
      [](Job& job) {
        job.begin("counting", 10, "things");
        for (int i = 0; i < 10; ++i) job.advance(1);
      },
      [&](const JobInfo& info) {
        EXPECT_EQ(info.state, JobState::Done);
        EXPECT_EQ(info.progress.phase, "counting");
        EXPECT_EQ(info.progress.done, 10);
        ended = true;
      });
  EXPECT_TRUE(waitFor([&] { return ended; }));
  EXPECT_TRUE(runner.idle());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

TEST(JobRunner, ANewerRequestReplacesTheOlderOnesOfItsKind) {
  JobRunner runner;
  std::atomic<int> ran{0};
  std::atomic<bool> asked{false};  // the first holds its place until the others have been asked for
  std::vector<JobState> states;
  const auto note = [&](const JobInfo& info) { states.push_back(info.state); };
  const auto holding = [&](Job& job) {
    while (!asked) QThread::msleep(1);
    forever(job);
  };
  const quint64 first = runner.start(s("bake"), s("1"), holding, note);
  ASSERT_TRUE(waitFor([&] { return runner.find(first)->state == JobState::Running; }));
  runner.start(
      s("bake"), s("2"), [&](Job&) { ++ran; }, note);
  runner.start(
      s("bake"), s("3"), [&](Job&) { ran += 10; }, note);
  asked = true;
  ASSERT_TRUE(waitFor([&] { return states.size() == 3; }));
  EXPECT_EQ(ran, 10) << "the one in the middle never ran";
  EXPECT_EQ(std::count(states.begin(), states.end(), JobState::Cancelled), 2);
}

TEST(JobRunner, OtherKindsRunBesideIt) {
  JobRunner runner;
  const quint64 bake = runner.start(s("bake"), s("bake"), forever);
  bool loaded = false;
  runner.start(
      s("load"), s("load"), [](Job&) {}, [&](const JobInfo&) { loaded = true; });
  EXPECT_TRUE(waitFor([&] { return loaded; }));
  EXPECT_FALSE(runner.find(bake)->over());
}

TEST(JobRunner, CancelAnswersAtOnce) {
  JobRunner runner;
  const quint64 id = runner.start(s("bake"), s("bake"), forever);
  ASSERT_TRUE(waitFor([&] { return runner.find(id)->state == JobState::Running; }));
  runner.cancel(id);
  EXPECT_TRUE(waitFor([&] { return runner.find(id)->state == JobState::Cancelled; }));
}

TEST(JobRunner, PauseHoldsAndResumeGoesOn) {
  JobRunner runner;
  std::atomic<int> count{0};
  const quint64 id = runner.start(s("bake"), s("bake"), [&](Job& job) {
    for (;;) {
      job.checkCancelled();
      ++count;
      QThread::msleep(1);
    }
  });
  ASSERT_TRUE(waitFor([&] { return count > 3; }));
  runner.pause(id);
  QThread::msleep(20);  // the step under way ends
  const int held = count;
  waitFor([] { return false; }, 60);
  EXPECT_EQ(count, held);
  EXPECT_EQ(runner.find(id)->state, JobState::Paused);
  runner.resume(id);
  EXPECT_TRUE(waitFor([&] { return count > held; }));
  runner.pause(id);
  runner.cancel(id);
  EXPECT_TRUE(waitFor([&] { return runner.find(id)->state == JobState::Cancelled; }))
      << "a paused job can be cancelled";
}

TEST(JobRunner, FailureCarriesTheMessage) {
  JobRunner runner;
  QString error;
  runner.start(
      s("load"), s("load"), [](Job&) { throw FileError("no such file", "a.obj", "check the name"); },
      [&](const JobInfo& info) { error = info.error; });
  ASSERT_TRUE(waitFor([&] { return !error.isEmpty(); }));
  EXPECT_EQ(error, s("a.obj: no such file (check the name)"));
}

TEST(JobRunner, MemoryOfOldJobsIsBounded) {
  JobRunner runner;
  for (int i = 0; i < 50; ++i) {
    bool ended = false;
    runner.start(
        s("x"), s("x"), [](Job&) {}, [&](const JobInfo&) { ended = true; });
    ASSERT_TRUE(waitFor([&] { return ended; }));
  }
  EXPECT_LE(runner.jobs().size(), 25u);
}

TEST(JobRunner, DestructionCancelsAndWaits) {
  std::atomic<bool> running{false}, left{false};
  {
    JobRunner runner;
    runner.start(s("bake"), s("bake"), [&](Job& job) {
      running = true;
      try {
        forever(job);
      } catch (...) {
        left = true;
        throw;
      }
    });
    ASSERT_TRUE(waitFor([&] { return running.load(); }));
  }
  EXPECT_TRUE(left);
}

}  // namespace
}  // namespace prt::ui
