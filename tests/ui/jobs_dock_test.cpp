#include "ui/docks/jobs_dock.h"

#include "libprt/core/error.h"
#include "tests/ui/studio_fixture.h"

#include <QAbstractButton>
#include <QLabel>

#include <atomic>

namespace prt::ui {
namespace {

using test::s;
using test::StudioTest;
using test::waitFor;

// The dock alone in a window, with jobs that do as they are told.
class JobsDockTest : public testing::Test {
 protected:
  JobsDockTest() {
    dock.resize(300, 500);
    dock.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&dock));
  }
  quint64 endless(const char* kind) {
    return runner.start(s(kind), s(kind), [](Job& job) {
      job.begin("working", 100, "steps", 0);
      for (int done = 0;; ++done) {
        job.checkCancelled();
        job.progress(done % 100, 100);
        QThread::msleep(2);
      }
    });
  }
  QAbstractButton* button(const char* name) {
    for (auto* each : dock.findChildren<QAbstractButton*>(s(name)))
      if (each->isVisible()) return each;
    return nullptr;
  }
  QStringList states() {
    QStringList all;
    for (auto* each : dock.findChildren<QLabel*>(s("jobState")))
      if (each->isVisible()) all << each->text();
    return all;
  }
  void click(const char* name) {
    ASSERT_TRUE(waitFor([&] { return button(name) != nullptr; })) << name;
    QTest::mouseClick(button(name), Qt::LeftButton);
  }
  JobState state(quint64 id) const { return runner.find(id)->state; }

  JobRunner runner;
  JobsDock dock{runner};
};

TEST_F(JobsDockTest, CancelIsAnsweredInTheSameMomentAndThenDone) {
  std::atomic<bool> let{false};
  const quint64 id = runner.start(s("deaf"), s("Deaf"), [&](Job& job) {
    while (!let) QThread::msleep(1);
    job.checkCancelled();
  });
  ASSERT_TRUE(waitFor([&] { return state(id) == JobState::Running; }));
  click("cancelJob");
  EXPECT_EQ(state(id), JobState::Cancelling);
  EXPECT_EQ(states(), QStringList{s("stopping\u2026")});
  EXPECT_EQ(button("cancelJob"), nullptr) << "once is enough";
  let = true;
  EXPECT_TRUE(waitFor([&] { return state(id) == JobState::Cancelled; }));
}

TEST_F(JobsDockTest, PauseAndResumeAJobThatRuns) {
  const quint64 id = endless("bake");
  ASSERT_TRUE(waitFor([&] { return runner.find(id)->progress.done > 3; }));
  click("pauseJob");
  EXPECT_EQ(state(id), JobState::Paused);
  EXPECT_TRUE(states()[0].startsWith(s("paused"))) << states()[0].toStdString();
  test::pass(60);  // what was on its way arrives
  const double done = runner.find(id)->progress.done;
  test::pass(120);
  EXPECT_EQ(runner.find(id)->progress.done, done);
  EXPECT_EQ(state(id), JobState::Paused);
  click("pauseJob");
  EXPECT_EQ(state(id), JobState::Running);
  EXPECT_TRUE(waitFor([&] { return runner.find(id)->progress.done != done; }));
  click("cancelJob");
  EXPECT_TRUE(waitFor([&] { return runner.idle(); }));
}

TEST_F(JobsDockTest, WhatWaitsCanBeHeldAndCancelled) {
  JobRunner narrow(1);
  JobsDock own(narrow);
  std::atomic<bool> let{false}, ran{false};
  narrow.start(s("first"), s("first"), [&](Job&) {
    while (!let) QThread::msleep(1);
  });
  const quint64 second = narrow.start(s("second"), s("second"), [&](Job&) { ran = true; });
  narrow.pause(second);
  EXPECT_EQ(narrow.find(second)->state, JobState::Paused);
  let = true;
  test::pass(100);
  EXPECT_FALSE(ran) << "held";
  narrow.resume(second);
  EXPECT_TRUE(waitFor([&] { return narrow.find(second)->state == JobState::Done; }));
  EXPECT_TRUE(ran);
}

TEST_F(JobsDockTest, AFailureSaysWhyAndCanBeTriedAgain) {
  std::atomic<int> tries{0};
  std::vector<JobState> ends;
  const quint64 id = runner.start(
      s("read"), s("Read"),
      [&](Job&) {
        if (++tries == 1) throw FileError("is a folder", "/x", "give a file");
      },
      [&](const JobInfo& job) { ends.push_back(job.state); });
  ASSERT_TRUE(waitFor([&] { return runner.find(id)->over(); }));
  EXPECT_EQ(states(), QStringList{s("/x: is a folder (give a file)")});
  EXPECT_TRUE(runner.canRetry(id));
  click("retryJob");
  ASSERT_TRUE(waitFor([&] { return ends.size() == 2; }));
  EXPECT_EQ(ends[1], JobState::Done);
  EXPECT_FALSE(runner.canRetry(id)) << "it was tried again";
  EXPECT_EQ(button("retryJob"), nullptr);
}

TEST_F(JobsDockTest, NothingIsTriedAgainThatANewerRequestReplaced) {
  const quint64 id = runner.start(s("read"), s("Read"), [](Job&) { throw FileError("no", "/x", ""); });
  ASSERT_TRUE(waitFor([&] { return runner.find(id)->over(); }));
  EXPECT_TRUE(runner.canRetry(id));
  runner.start(s("read"), s("Read"), [](Job&) {});
  EXPECT_FALSE(runner.canRetry(id));
  EXPECT_EQ(runner.retry(id), 0u);
}

TEST_F(JobsDockTest, PausingAtTheVeryEndDoesNotBringAJobBack) {
  for (int i = 0; i < 200; ++i) {
    const quint64 id = runner.start(s("short"), s("short"), [](Job&) {});
    QThread::usleep(quint64(20 * (i % 20)));
    runner.pause(id);
    runner.resume(id);
    ASSERT_TRUE(waitFor([&] { return runner.find(id)->over(); }, 5000)) << i;
    runner.pause(id);
    EXPECT_EQ(state(id), JobState::Done);
  }
}

TEST_F(StudioTest, AFailedBakeIsTriedAgainFromTheDock) {
  const QString mesh = folder.filePath(s("mesh.obj"));
  Recipe recipe = test::smallScene();
  openAndSettle(recipe);
  recipe = session.document().recipe();
  recipe.objects[0].mesh.path = mesh.mid(1).toStdString();
  session.document().edit(s("Another mesh"), recipe);
  ASSERT_TRUE(waitFor([this] { return !session.bakes().error().isEmpty(); })) << "there is no such file";
  QFile file(mesh);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  file.close();
  window.bringToFront(s("jobs"));
  test::pass(50);
  QAbstractButton* retry = nullptr;
  for (auto* each : window.findChildren<QAbstractButton*>(s("retryJob")))
    if (each->isVisible()) retry = each;
  ASSERT_NE(retry, nullptr);
  QTest::mouseClick(retry, Qt::LeftButton);
  EXPECT_TRUE(session.bakes().baking());
  EXPECT_TRUE(waitFor([this] { return session.bakes().fresh(); }));
  EXPECT_TRUE(session.bakes().error().isEmpty());
}

}  // namespace
}  // namespace prt::ui
