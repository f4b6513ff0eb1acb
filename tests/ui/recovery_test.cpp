#include "ui/model/recovery.h"

#include "libprt/core/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/model/session.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QFile>

#include <fstream>

namespace prt::ui {
namespace {

namespace fs = std::filesystem;
using test::smallScene;
using test::waitFor;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

RecoveryEntry entry(float angle) {
  RecoveryEntry made;
  made.path = s("/projects/a.prt");
  made.title = s("a.prt");
  made.time = QDateTime::currentDateTime();
  made.edits = {s("Exponent of vase"), s("Turn environment")};
  made.saved = made.recipe = smallScene();
  made.recipe.lights[0].rotation = angle;
  return made;
}

// As after kill -9: the lock is gone, everything else is there.
void crash(std::unique_ptr<RecoveryPlace>& place) {
  place.reset();
}

TEST(RecoveryPlace, WhatACrashLeavesIsFoundWithEverythingInIt) {
  const test::TemporaryFolder root;
  auto place = RecoveryPlace::create(root.path());
  place->keep(entry(30), QByteArray("picture"));
  place->keep(entry(40), {});
  EXPECT_TRUE(RecoveryPlace::orphans(root.path()).empty()) << "its studio runs";
  crash(place);
  const auto found = RecoveryPlace::orphans(root.path());
  ASSERT_EQ(found.size(), 1u);
  const auto kept = found[0]->read();
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->recipe, entry(40).recipe);
  EXPECT_EQ(kept->saved, entry(40).saved);
  EXPECT_EQ(kept->edits, entry(40).edits);
  EXPECT_TRUE(QFile::exists(found[0]->thumbnail()));
  EXPECT_TRUE(RecoveryPlace::orphans(root.path()).empty()) << "the first to find it has it";
}

TEST(RecoveryPlace, NothingStaysOfWhatNobodyNeeds) {
  const test::TemporaryFolder root;
  {
    const auto dismissed = RecoveryPlace::create(root.path());
    dismissed->keep(entry(30), {});
    dismissed->dismiss();
  }
  auto empty = RecoveryPlace::create(root.path());
  auto saved = RecoveryPlace::create(root.path());
  saved->keep(entry(30), {});
  saved->forget();
  auto damaged = RecoveryPlace::create(root.path());
  std::ofstream(damaged->folder() / "recovery.json") << "{\"path\": 3";
  for (auto* place : {&empty, &saved, &damaged}) crash(*place);
  EXPECT_TRUE(RecoveryPlace::orphans(root.path()).empty());
  EXPECT_EQ(root.entries(), 0);
}

TEST(RecoveryPlace, AFolderThatCannotBeWrittenIsTold) {
  const test::TemporaryFolder root;
  std::ofstream(root / "file") << "not a folder";
  EXPECT_THROW(RecoveryPlace::create(root / "file"), FileError);
}

class Recovery : public testing::Test {
 protected:
  struct Studio : Session {
    explicit Studio(const fs::path& root) { project().setRecoveryRoot(root); }
  };
  std::unique_ptr<Studio> start() { return std::make_unique<Studio>(folder / "recovery"); }
  QString path(const char* name) { return QString::fromStdString((folder / name).string()); }
  QString write(const Recipe& recipe) {
    QFile file(path("scene.json"));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    return file.fileName();
  }
  static bool settle(Studio& studio) {
    return waitFor([&] { return studio.settled() && studio.bakes().fresh(); });
  }
  test::TemporaryFolder folder;
};

TEST_F(Recovery, EditsComeBackOverTheSavedProjectAndUndoLeadsToIt) {
  {
    const auto studio = start();
    studio->open(write(smallScene()));
    ASSERT_TRUE(settle(*studio));
    studio->save(path("a.prt"));
    ASSERT_TRUE(waitFor([&] { return !studio->project().saving(); }));
    studio->setEnvironmentAngle(77);
    // Ends without having been asked: as good as killed.
  }
  const auto studio = start();
  ASSERT_EQ(studio->project().recoveries().size(), 1u);
  const auto place = studio->project().recoveries()[0];
  EXPECT_EQ(place->read()->path, path("a.prt"));
  EXPECT_EQ(place->read()->edits, QStringList{s("Turn environment")});
  studio->project().restore(place);
  ASSERT_TRUE(settle(*studio));
  EXPECT_NEAR(studio->environmentAngle(), 77, 1e-4);
  EXPECT_TRUE(studio->document().modified());
  EXPECT_EQ(studio->document().title(), s("a.prt"));
  studio->document().undo();
  EXPECT_EQ(studio->environmentAngle(), 0);
  EXPECT_TRUE(studio->project().recoveries().empty());
}

TEST_F(Recovery, ADocumentThatWasNeverSavedComesBackWithItsBake) {
  Recipe recipe = smallScene();
  recipe.transfer.rays = 512;
  {
    const auto studio = start();
    studio->open(write(recipe));
    ASSERT_TRUE(settle(*studio));
    studio->setEnvironmentAngle(12);
  }
  QFile::remove(path("scene.json"));
  const auto studio = start();
  ASSERT_EQ(studio->project().recoveries().size(), 1u);
  int previews = 0;
  QObject::connect(&studio->bakes(), &BakeController::productArrived,
                   [&](const QString&, const ProductState& state) { previews += !state.final(); });
  studio->project().restore(studio->project().recoveries()[0]);
  ASSERT_TRUE(settle(*studio));
  EXPECT_EQ(previews, 0) << "the bake is there";
  EXPECT_NEAR(studio->environmentAngle(), 12, 1e-4);
  studio->save(path("b.prt"));
  ASSERT_TRUE(waitFor([&] { return !studio->project().saving(); }));
  EXPECT_FALSE(studio->project().unsaved().any());
}

TEST_F(Recovery, WhatWasSavedOrGivenUpIsNotOffered) {
  {
    const auto studio = start();
    studio->open(write(smallScene()));
    ASSERT_TRUE(settle(*studio));
    studio->setEnvironmentAngle(1);
    studio->project().autosave().flush();
    studio->save(path("a.prt"));
    ASSERT_TRUE(waitFor([&] { return !studio->project().saving(); }));
  }
  EXPECT_TRUE(start()->project().recoveries().empty());
  {
    const auto studio = start();
    studio->open(path("a.prt"));
    ASSERT_TRUE(settle(*studio));
    studio->setEnvironmentAngle(2);
    studio->project().autosave().flush();
    studio->project().giveUp();
  }
  EXPECT_TRUE(start()->project().recoveries().empty());
}

TEST_F(Recovery, EditsAreKeptByThemselvesAndDuringABake) {
  const auto studio = start();
  studio->project().autosave().setMilliseconds(30);
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;
  studio->open(write(recipe));
  ASSERT_TRUE(waitFor([&] { return studio->relighter().transfer() != nullptr; }));
  bool kept = false;
  QObject::connect(&studio->project().autosave(), &Autosave::kept, [&] { kept = true; });
  const quint64 bake = studio->bakes().job();
  studio->setEnvironmentAngle(50);
  EXPECT_TRUE(waitFor([&] { return kept; }));
  EXPECT_EQ(studio->bakes().job(), bake);
  EXPECT_TRUE(studio->bakes().baking());
  studio->document().undo();
  const auto folders = [&] {
    int entries = 0;
    for (const auto& each : fs::directory_iterator(folder / "recovery"))
      entries += fs::exists(each.path() / "recovery.json");
    return entries;
  };
  EXPECT_TRUE(waitFor([&] { return folders() == 0; })) << "nothing is left to recover";
}

TEST_F(Recovery, AProjectThatIsGoneStillComesBack) {
  {
    const auto studio = start();
    studio->open(write(smallScene()));
    ASSERT_TRUE(settle(*studio));
    studio->save(path("a.prt"));
    ASSERT_TRUE(waitFor([&] { return !studio->project().saving(); }));
    studio->setEnvironmentAngle(3);
  }
  QFile::remove(path("a.prt"));
  const auto studio = start();
  ASSERT_EQ(studio->project().recoveries().size(), 1u);
  studio->project().restore(studio->project().recoveries()[0]);
  ASSERT_TRUE(settle(*studio));
  EXPECT_TRUE(studio->document().path().isEmpty());
  EXPECT_NEAR(studio->environmentAngle(), 3, 1e-4);
}

}  // namespace
}  // namespace prt::ui
