// kill -9 at any moment of editing, autosaving, baking and saving: the project opens as it was saved last,
// what was kept since is offered, and both look as they did.

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/edit_until_killed.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/model/session.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <thread>

namespace prt::test {

namespace {

// N is at most 36000: a turn.
double angleOf(int n) {
  return n / 100.0;
}

int numberOf(const Recipe& recipe) {
  return int(std::lround(recipe.lights[0].rotation * 100));
}

}  // namespace

int editUntilKilled(const QString& project, const QString& recoveryRoot) {
  std::FILE* log = std::fopen((recoveryRoot.toStdString() + ".log").c_str(), "w");
  const auto note = [log](const char* what, int n) {
    std::fprintf(log, "%s %d\n", what, n);
    std::fflush(log);
  };
  ui::Session studio;
  studio.project().setRecoveryRoot(recoveryRoot.toStdString());
  studio.project().autosave().setMilliseconds(4);
  studio.open(project);
  if (!waitFor([&] { return studio.settled(); })) return 1;
  int n = numberOf(studio.document().recipe());
  int keeping = n, saving = n;
  bool wait = false;
  QObject::connect(&studio.project().autosave(), &ui::Autosave::kept, [&] {
    note("kept", keeping);
    wait = false;
  });
  QObject::connect(&studio.project(), &ui::ProjectKeeper::saved, [&] { note("saved", saving); });
  for (int step = 0; n < 17000; ++step) {
    ++n;
    if (step % 5 == 4)  // bakes beside everything else
      studio.document().set(QStringLiteral("objects[0].material.albedo"),
                            QStringLiteral("0.%1").arg(n % 800 + 100));
    studio.setEnvironmentAngle(angleOf(n));
    keeping = n;
    wait = true;
    if (!waitFor([&] { return !wait; })) return 2;
    if (step % 3 != 2) continue;
    saving = n;
    studio.save(project);
    if (!waitFor([&] { return !studio.project().saving(); })) return 3;
  }
  return 0;
}

namespace {

namespace fs = std::filesystem;

class RecoveryKill : public testing::Test {
 protected:
  fs::path project() const { return folder / "a.prt"; }
  std::string root() const { return (folder / "recovery").string(); }

  void makeProject() {
    ui::Session studio;
    studio.project().setRecoveryRoot(root());
    Recipe recipe = smallScene();
    recipe.transfer.rays = 128;
    std::ofstream(folder / "scene.json") << recipeToJson(recipe).dump();
    studio.open(QString::fromStdString((folder / "scene.json").string()));
    ASSERT_TRUE(waitFor([&] { return studio.settled() && studio.bakes().fresh(); }));
    studio.save(QString::fromStdString(project().string()));
    ASSERT_TRUE(waitFor([&] { return !studio.project().saving(); }));
  }
  // Runs the editing process for a while from its first edit on, kills it; what it was sure of.
  std::pair<int, int> killAfter(double seconds) {
    const fs::path log = root() + ".log";
    fs::remove(log);
    Program child({"/proc/self/exe", "--edit-until-killed", project().string(), root()});
    std::error_code error;
    EXPECT_TRUE(waitFor([&] { return fs::exists(log, error) && fs::file_size(log, error) > 0; }));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    child.send(SIGKILL);
    const ProgramResult result = child.wait();
    EXPECT_EQ(result.status, 128 + SIGKILL) << result.err;
    int kept = 0, saved = 0;
    std::ifstream lines(log);
    std::string word;
    for (int n; lines >> word >> n;) (word == "kept" ? kept : saved) = n;
    return {kept, saved};
  }
  std::vector<Rgb> lit(ui::Session& studio) {
    EXPECT_TRUE(waitFor([&] { return studio.settled() && studio.bakes().fresh(); }));
    return studio.relighter().surface().irradiance;
  }

  TemporaryFolder folder;
};

TEST_F(RecoveryKill, LosesNothingThatWasSavedOrKept) {
  makeProject();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0, 0.6);
  int killed = 0, offered = 0, sure = 0;
  for (int kill = 0; kill < 30; ++kill, ++killed) {
    const auto [kept, saved] = killAfter(moment(random));
    Job job;
    ASSERT_NO_THROW(ProjectFile::verify(project(), job)) << "after kill " << kill;
    const Recipe onDisk = ProjectFile::open(project())->recipe();
    ASSERT_GE(numberOf(onDisk), saved) << "after kill " << kill;

    ui::Session studio;
    studio.project().setRecoveryRoot(root());
    const auto found = studio.project().recoveries();
    ASSERT_TRUE(kept <= numberOf(onDisk) || found.size() == 1u) << "after kill " << kill;
    studio.open(QString::fromStdString(project().string()));
    const auto savedLight = lit(studio);
    if (!found.empty()) {
      ++offered;
      const Recipe recovered = found[0]->read()->recipe;
      ASSERT_GE(numberOf(recovered), kept) << "after kill " << kill;
      studio.project().restore(found[0]);
      ASSERT_TRUE(waitFor([&] { return studio.document().recipe() == recovered; })) << "after kill " << kill;
      EXPECT_TRUE(studio.document().modified());
      EXPECT_FALSE(lit(studio).empty());
      studio.document().undo();
      EXPECT_EQ(lit(studio), savedLight) << "the same picture";
    }
    studio.project().giveUp();
    sure += kept > 0;
  }
  RecordProperty("offered", offered);
  EXPECT_GT(offered, 5) << "kills were in the midst of edits";
  EXPECT_GT(sure, 10) << "kills were not all before the first edit";
}

}  // namespace
}  // namespace prt::test
