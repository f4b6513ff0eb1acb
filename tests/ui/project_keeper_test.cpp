#include "ui/model/project_keeper.h"

#include "libprt/core/image_io.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/project/backups.h"
#include "libprt/project/products.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/model/session.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

namespace prt::ui {
namespace {

using test::smallScene;
using test::waitFor;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

// A bake that goes on for as long as a test looks.
Recipe slowScene() {
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;
  return recipe;
}

class ProjectKeeperTest : public testing::Test {
 protected:
  struct Studio : Session {
    explicit Studio(const QString& root) {
      project().setRecoveryRoot(root.toStdString());
      project().setQuestion([this](const Unsaved& unsaved) {
        asked.push_back(unsaved);
        return answer;
      });
      QObject::connect(this, &Session::message,
                       [this](Severity, const QString& text, Place) { messages << text; });
    }
    std::vector<Unsaved> asked;
    LeaveAnswer answer;
    QStringList messages;
  };

  std::unique_ptr<Studio> start() const { return std::make_unique<Studio>(path("recovery")); }
  QString path(const char* name) const { return folder.filePath(QLatin1String(name)); }
  QString write(const Recipe& recipe, const char* name = "scene.json") const {
    QFile file(path(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    return file.fileName();
  }
  static bool settle(Studio& studio) {
    return waitFor([&] { return studio.settled() && studio.bakes().fresh(); });
  }
  static bool saved(Studio& studio) {
    return waitFor([&] { return !studio.project().saving(); });
  }
  int places() const {
    return int(QDir(path("recovery")).entryList(QDir::Dirs | QDir::NoDotAndDotDot).size());
  }
  std::vector<std::byte> transferIn(const char* name) const {
    const auto project = ProjectFile::open(path(name).toStdString());
    for (const ProductInfo& info : project->contents())
      if (info.stage == "transfer" && info.level == info.levels)
        return project->find(info.stage, info.key)->data.arrays.at("values").bytes;
    return {};
  }

  QTemporaryDir folder;
};

TEST_F(ProjectKeeperTest, SavingDuringABakeNeitherStopsNorChangesIt) {
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.detail = 0.5f;
  recipe.transfer.rays = 8192;
  {
    const auto whole = start();
    whole->open(write(recipe));
    ASSERT_TRUE(settle(*whole));
    whole->save(path("whole.prt"));
    ASSERT_TRUE(saved(*whole));
  }
  const auto studio = start();
  studio->open(write(recipe));
  ASSERT_TRUE(waitFor([&] { return studio->relighter().transfer() != nullptr; })) << "a first preview";
  const quint64 bake = studio->bakes().job();
  int rays = 0;
  bool restarted = false;
  QObject::connect(studio.get(), &Session::statusChanged, [&] {
    const int now = studio->status().rays;
    restarted = restarted || now < rays;
    rays = now;
  });
  for (const char* name : {"a.prt", "a.prt", "b.prt"}) {
    studio->save(path(name));
    ASSERT_TRUE(saved(*studio));
    EXPECT_EQ(studio->document().title(), QLatin1String(name));
    EXPECT_FALSE(studio->document().modified());
    EXPECT_TRUE(!studio->bakes().baking() || studio->bakes().job() == bake) << "the same bake goes on";
  }
  ASSERT_TRUE(settle(*studio));
  EXPECT_FALSE(restarted);
  studio->save(path("b.prt"));
  ASSERT_TRUE(saved(*studio));
  EXPECT_EQ(transferIn("b.prt"), transferIn("whole.prt")) << "the same bits";
  EXPECT_FALSE(transferIn("whole.prt").empty());
  EXPECT_TRUE(studio->messages.isEmpty()) << studio->messages.join(u'\n').toStdString();
}

TEST_F(ProjectKeeperTest, AsksExactlyWhenSomethingWouldBeLost) {
  const auto studio = start();
  studio->open(write(smallScene()));
  ASSERT_TRUE(settle(*studio));
  studio->open(path("scene.json"));
  ASSERT_TRUE(settle(*studio));
  EXPECT_TRUE(studio->asked.empty()) << "nothing was edited";

  studio->setEnvironmentAngle(40);
  studio->document().undo();
  studio->open(path("scene.json"));
  ASSERT_TRUE(settle(*studio));
  EXPECT_TRUE(studio->asked.empty()) << "the edit was taken back";

  studio->setEnvironmentAngle(40);
  studio->open(path("scene.json"));
  ASSERT_EQ(studio->asked.size(), 1u);
  EXPECT_EQ(studio->asked[0].edits, QStringList{s("Turn environment")});
  EXPECT_FALSE(studio->opening()) << "cancelled";
  EXPECT_NEAR(studio->environmentAngle(), 40, 1e-4);

  studio->answer = {Leave::Discard, {}};
  studio->open(path("scene.json"));
  ASSERT_TRUE(settle(*studio));
  EXPECT_EQ(studio->environmentAngle(), 0);
  studio->open(s("probe.hdr"));
  EXPECT_EQ(studio->asked.size(), 2u) << "a light replaces no document";
}

TEST_F(ProjectKeeperTest, SaveInTheQuestionSavesAndThenGoesOn) {
  const auto studio = start();
  studio->open(write(smallScene()));
  ASSERT_TRUE(settle(*studio));
  studio->setEnvironmentAngle(40);
  studio->answer = {Leave::Save, path("kept.prt")};
  studio->open(write(slowScene(), "other.json"));
  ASSERT_TRUE(waitFor([&] {
    return studio->document().title() != QLatin1String("kept.prt") && !studio->opening() &&
           studio->document().recipe().transfer.rays == 1 << 20;
  }));
  EXPECT_NEAR(double(ProjectFile::open(path("kept.prt").toStdString())->recipe().lights[0].rotation), 40,
              1e-4);

  studio->setEnvironmentAngle(10);
  studio->answer = {Leave::Save, path("no/such/folder/x.prt")};
  bool left = false;
  studio->project().leaveThen([&] { left = true; });
  ASSERT_TRUE(saved(*studio));
  EXPECT_FALSE(left) << "it could not be saved";
  EXPECT_EQ(studio->messages.size(), 1);
}

TEST_F(ProjectKeeperTest, ClosingDuringABakeKeepsItsWorkForTheNextTime) {
  {
    const auto studio = start();
    studio->open(write(slowScene()));
    ASSERT_TRUE(waitFor([&] { return studio->relighter().transfer() != nullptr; }));
    studio->save(path("a.prt"));
    ASSERT_TRUE(saved(*studio));
    EXPECT_TRUE(studio->bakes().baking());
    const Unsaved unsaved = studio->project().unsaved();
    EXPECT_FALSE(unsaved.any()) << "nothing is lost";
    EXPECT_TRUE(unsaved.bakeGoesOn);
    const int before = studio->status().rays;
    ASSERT_TRUE(waitFor([&] { return studio->status().rays > before; }));
  }
  EXPECT_TRUE(QFile::exists(path("a.prt.work")));
  EXPECT_EQ(places(), 0) << "the studio ended as it should";
  const auto again = start();
  again->open(path("a.prt"));
  ASSERT_TRUE(waitFor([&] { return again->relighter().transfer() != nullptr; }));
  EXPECT_GT(again->status().rays, 64) << "it did not begin anew";
}

TEST_F(ProjectKeeperTest, UndoAfterSavingStillFindsWhatWasBaked) {
  const auto studio = start();
  studio->open(write(smallScene()));
  ASSERT_TRUE(settle(*studio));
  studio->document().set(s("transfer.bands"), s("3"));
  ASSERT_TRUE(settle(*studio));
  studio->save(path("a.prt"));
  ASSERT_TRUE(saved(*studio));
  int previews = 0;
  QObject::connect(&studio->bakes(), &BakeController::productArrived,
                   [&](const QString&, const ProductState& state) { previews += !state.final(); });
  studio->document().undo();
  ASSERT_TRUE(settle(*studio));
  EXPECT_EQ(studio->relighter().bands(), 5);
  studio->document().redo();
  ASSERT_TRUE(settle(*studio));
  EXPECT_EQ(previews, 0) << "all of it was there";
  int transfers = 0;
  for (const ProductInfo& info : ProjectFile::open(path("a.prt").toStdString())->contents())
    transfers += info.stage == "transfer";
  EXPECT_EQ(transfers, 1) << "the saved project holds what serves its recipe";
}

TEST_F(ProjectKeeperTest, AnEditDuringASaveIsNotLost) {
  const auto studio = start();
  studio->open(write(smallScene()));
  ASSERT_TRUE(settle(*studio));
  studio->setEnvironmentAngle(10);
  studio->save(path("a.prt"));
  studio->setEnvironmentAngle(20);
  ASSERT_TRUE(saved(*studio));
  EXPECT_TRUE(studio->document().modified());
  EXPECT_NEAR(studio->environmentAngle(), 20, 1e-4);
  EXPECT_NEAR(double(ProjectFile::open(path("a.prt").toStdString())->recipe().lights[0].rotation), 10, 1e-4);
  EXPECT_EQ(studio->document().undoName(), s("Turn environment"));
}

TEST_F(ProjectKeeperTest, PathsAreRelativeToTheProjectAndUndoKeepsThem) {
  const auto studio = start();
  Recipe recipe = smallScene();
  studio->open(write(recipe));
  ASSERT_TRUE(settle(*studio));
  writeImage(path("probe.hdr").toStdString(), softboxStudio(64, 32).pixels());
  studio->open(path("probe.hdr"));
  ASSERT_TRUE(waitFor([&] { return studio->document().canUndo(); }));
  QDir(folder.path()).mkdir(s("projects"));
  studio->save(path("projects/a.prt"));
  ASSERT_TRUE(saved(*studio));
  EXPECT_EQ(studio->document().recipe().lights[0].path, "../probe.hdr");
  EXPECT_EQ(studio->project().unsaved().any(), false);
  studio->document().undo();
  studio->document().redo();
  EXPECT_EQ(studio->document().recipe().lights[0].path, "../probe.hdr");
  EXPECT_EQ(studio->project().recent().files().value(0), path("projects/a.prt"));
}

TEST_F(ProjectKeeperTest, SavesKeepBackups) {
  ProjectKeeper::setBackups(2);
  const auto studio = start();
  studio->open(write(smallScene()));
  ASSERT_TRUE(settle(*studio));
  for (int i = 1; i <= 4; ++i) {
    studio->setEnvironmentAngle(i);
    studio->save(path("a.prt"));
    ASSERT_TRUE(saved(*studio));
  }
  const auto backups = backupsOf(path("a.prt").toStdString());
  ASSERT_EQ(backups.size(), 2u);
  EXPECT_NEAR(double(ProjectFile::open(backups[0])->recipe().lights[0].rotation), 3, 1e-4);
  EXPECT_NEAR(double(ProjectFile::open(backups[1])->recipe().lights[0].rotation), 2, 1e-4);
}

TEST_F(ProjectKeeperTest, TwoStudiosDoNotWorkOnOneProject) {
  const auto first = start();
  first->open(write(smallScene()));
  ASSERT_TRUE(settle(*first));
  first->save(path("a.prt"));
  ASSERT_TRUE(saved(*first));
  const auto second = start();
  second->open(path("a.prt"));
  ASSERT_TRUE(waitFor([&] { return !second->messages.isEmpty(); }));
  EXPECT_TRUE(second->messages[0].contains(s("in use"))) << second->messages[0].toStdString();
  first->setEnvironmentAngle(5);
  first->answer = {Leave::Discard, {}};
  first->open(path("a.prt"));  // again, as it was saved
  ASSERT_TRUE(settle(*first));
  EXPECT_TRUE(first->messages.isEmpty()) << first->messages.join(u'\n').toStdString();
  EXPECT_EQ(first->environmentAngle(), 0);
}

TEST_F(ProjectKeeperTest, CollectingCopiesFilesBesideTheProject) {
  const auto studio = start();
  QDir(folder.path()).mkdir(s("far"));
  writeImage(path("far/probe.hdr").toStdString(), softboxStudio(64, 32).pixels());
  Recipe recipe = smallScene();
  recipe.lights[0].path = "far/probe.hdr";
  studio->open(write(recipe));
  ASSERT_TRUE(settle(*studio));
  studio->save(path("a.prt"));
  ASSERT_TRUE(saved(*studio));
  studio->project().collect();
  ASSERT_TRUE(waitFor([&] { return studio->document().recipe().lights[0].path == "a_files/probe.hdr"; }));
  ASSERT_TRUE(saved(*studio));
  EXPECT_TRUE(QFile::exists(path("a_files/probe.hdr")));
  EXPECT_FALSE(studio->document().modified());
}

}  // namespace
}  // namespace prt::ui
