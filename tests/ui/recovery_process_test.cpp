// The studio itself, killed during saves that keys from the X server asked for.

#include "libprt/project/project_file.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/studio_process.h"
#include "ui/model/recovery.h"

#include <QImage>
#include <QStandardPaths>

#include <random>

namespace prt::ui {
namespace {

using test::pass;
using test::StudioProcess;
using test::waitFor;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

TEST_F(StudioProcess, KilledDuringASaveItOpensAsItWasAndOffersTheRest) {
  if (QStandardPaths::findExecutable(s("xdotool")).isEmpty()) GTEST_SKIP() << "needs xdotool";
  // A project, as the command line bakes it.
  const QString project = folder.filePath(s("a.prt")), scene = writeScene(test::smallScene());
  QProcess prt;
  prt.start(QCoreApplication::applicationDirPath() + s("/prt"),
            {s("bake"), scene, s("-o"), project, s("-q")});
  ASSERT_TRUE(prt.waitForFinished(60000) && prt.exitCode() == 0);
  writeSettings(s("[documents]\nautosave=1\n"));
  const QString before = folder.filePath(s("before.png")), after = folder.filePath(s("after.png"));
  const auto screenshot = [&](const QString& file) {
    start({project, s("--screenshot"), file, s("--size"), s("900x600")});
    ASSERT_EQ(end(), 0) << output.toStdString();
  };

  std::mt19937 random(3);
  std::uniform_int_distribution<int> moment(0, 400);
  int offered = 0;
  for (int kill = 0; kill < 6; ++kill) {
    start({project, s("--reset-ui")});
    const QString window = findWindow();
    ASSERT_FALSE(window.isEmpty()) << "no window";
    pass(1500);
    turnEnvironment(window);
    ASSERT_TRUE(waitFor([&] { return xdotool({s("getwindowname"), window}).contains(s(" *")); }, 20000));
    if (kill % 2 == 0) pass(1500);  // the edit is kept
    xdotool({s("windowfocus"), s("--sync"), window, s("key"), s("ctrl+s")});
    pass(moment(random));
    studio.kill();
    ASSERT_TRUE(studio.waitForFinished());
    Job job;
    ASSERT_NO_THROW(ProjectFile::verify(project.toStdString(), job)) << "after kill " << kill;
    const float saved = ProjectFile::open(project.toStdString())->recipe().lights[0].rotation;
    for (const auto& place : RecoveryPlace::orphans(recoveryRoot())) {
      const auto entry = place->read();
      EXPECT_EQ(entry->path, project);
      offered += entry->recipe.lights[0].rotation != saved;
      place->dismiss();
    }
  }
  RecordProperty("offered", offered);
  screenshot(before);
  screenshot(after);
  EXPECT_EQ(QImage(before), QImage(after));
  EXPECT_FALSE(QImage(before).isNull());
}

}  // namespace
}  // namespace prt::ui
