#include "ui/model/session.h"

#include "libprt/core/image_io.h"
#include "libprt/light/built_in_skies.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace prt::ui {
namespace {

using test::smallScene;
using test::waitFor;

struct Message {
  Severity severity;
  QString text;
  Place place;
};

class SessionTest : public testing::Test {
 protected:
  SessionTest() {
    QObject::connect(&session, &Session::message,
                     [this](Severity severity, const QString& text, Place place) {
                       messages.push_back({severity, text, place});
                     });
  }
  QString path(const char* name) const { return folder.filePath(QLatin1String(name)); }
  QString write(const char* name, const QByteArray& contents) const {
    QFile file(path(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(contents);
    return file.fileName();
  }
  QString writeScene(const char* name = "scene.json") const {
    return write(name, QByteArray::fromStdString(recipeToJson(smallScene()).dump()));
  }
  bool openAndSettle(const QString& what) {
    session.open(what);
    return waitFor([this] { return session.settled() && session.bakes().fresh(); });
  }
  bool quiet() {
    return waitFor([this] { return !session.opening() && session.jobs().idle(); });
  }

  QTemporaryDir folder;
  Session session;
  std::vector<Message> messages;
};

TEST_F(SessionTest, OpeningBakesAndLightsAndFrames) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  EXPECT_TRUE(messages.empty());
  ASSERT_TRUE(session.relighter().transfer());
  EXPECT_TRUE(session.relighter().transfer()->final());
  EXPECT_TRUE(session.relighter().environment());
  const PictureStatus status = session.status();
  EXPECT_EQ(status.level, status.levels);
  EXPECT_EQ(status.rays, 256);
  EXPECT_EQ(status.bounces, 1);
  EXPECT_GT(length(session.view().camera().eye - session.bounds().center()),
            0.5f * session.bounds().diagonal());
  EXPECT_FALSE(session.document().modified());
}

TEST_F(SessionTest, ABadMeshIsToldAndTheOldDocumentStays) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  const Recipe before = session.document().recipe();
  const auto scene = session.relighter().scene();
  session.open(write("broken.obj", "v 0 0 0\nf 1 2 3\n"));
  ASSERT_TRUE(quiet());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].severity, Severity::Error);
  EXPECT_EQ(messages[0].place, Place::Viewport);
  EXPECT_TRUE(messages[0].text.contains(QLatin1String("broken.obj"))) << messages[0].text.toStdString();
  EXPECT_EQ(session.document().recipe(), before);
  EXPECT_EQ(session.relighter().scene(), scene);
  EXPECT_TRUE(session.bakes().fresh());
}

TEST_F(SessionTest, AMissingFileAndAnUnknownKindAreTold) {
  for (const char* what : {"nowhere.obj", "nowhere.prt", "scene:nowhere"})
    session.open(QLatin1String(what)), quiet();
  session.open(write("notes.txt", "hello"));
  ASSERT_TRUE(quiet());
  EXPECT_EQ(messages.size(), 4u);
  EXPECT_FALSE(session.relighter().scene());
}

TEST_F(SessionTest, ABadProbeIsToldAtTheLightAndTheOldOneStays) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  const auto map = session.relighter().environment();
  session.open(write("broken.hdr", "#?RADIANCE\nnothing more"));
  ASSERT_TRUE(quiet());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].place, Place::Light);
  EXPECT_EQ(session.relighter().environment(), map);
  EXPECT_FALSE(session.document().canUndo());
}

TEST_F(SessionTest, AMapInAnotherMappingIsUnrolledForTheBackground) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  Image probe(64, 64, 3);
  for (float& v : probe.data) v = 0.5f;
  writeImage(path("probe.exr").toStdString(), probe);
  session.open(path("probe.exr"));
  ASSERT_TRUE(quiet());
  const Relighter& lit = session.relighter();
  ASSERT_EQ(lit.environment()->report().mapping, EnvironmentMapping::AngularMap);
  for (const auto& backdrop : {lit.backdrop(), lit.blurredBackdrop()}) {
    ASSERT_TRUE(backdrop);
    EXPECT_EQ(backdrop->report().mapping, EnvironmentMapping::LatLong);
    EXPECT_NEAR(backdrop->radiance(Vec3(0, 0, 1)).x, 0.5f, 0.02f);
  }
}

TEST_F(SessionTest, AProbeIsAnEditThatUndoTakesBack) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  const auto before = session.relighter().environment();
  writeImage(path("probe.hdr").toStdString(), softboxStudio(64, 32).pixels());
  session.open(path("probe.hdr"));
  ASSERT_TRUE(quiet());
  EXPECT_TRUE(messages.empty());
  EXPECT_NE(session.relighter().environment(), before);
  EXPECT_TRUE(session.environmentFile().endsWith(QLatin1String("probe.hdr")));
  session.document().undo();
  ASSERT_TRUE(quiet());
  EXPECT_EQ(session.relighter().environment(), before) << "maps that were read are kept";
}

TEST_F(SessionTest, TurningTheLightRelightsWithoutBaking) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  const std::vector<Rgb> before = session.relighter().surface().irradiance;
  session.setEnvironmentAngle(120);
  EXPECT_TRUE(session.bakes().fresh());
  EXPECT_FALSE(session.bakes().baking());
  const std::vector<Rgb>& after = session.relighter().surface().irradiance;
  ASSERT_EQ(after.size(), before.size());
  float largest = 0;
  for (std::size_t i = 0; i < after.size(); ++i) largest = std::max(largest, length(after[i] - before[i]));
  EXPECT_GT(largest, 0.1f);
  session.setEnvironmentAngle(480);
  EXPECT_NEAR(session.environmentAngle(), 120, 1e-3);
}

TEST_F(SessionTest, MaterialsAreLive) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  session.document().set(QStringLiteral("objects[0].material.albedo"), QStringLiteral("[0.1,0.2,0.3]"));
  EXPECT_EQ(session.relighter().materials()[0].albedo, Rgb(0.1f, 0.2f, 0.3f)) << "before any bake";
  ASSERT_TRUE(quiet());
  EXPECT_TRUE(session.bakes().fresh());
}

TEST_F(SessionTest, AProjectIsSavedAndOpensWithoutBaking) {
  std::vector<Rgb> irradiance;
  {
    Session first;
    first.open(writeScene());
    ASSERT_TRUE(waitFor([&] { return first.settled() && first.bakes().fresh(); }));
    first.setEnvironmentAngle(33);
    first.save(path("saved.prt"));
    ASSERT_TRUE(waitFor([&] { return first.jobs().idle(); }));
    EXPECT_TRUE(QFile::exists(path("saved.prt")));
    EXPECT_FALSE(first.document().modified());
    EXPECT_EQ(first.document().title(), QLatin1String("saved.prt"));
    irradiance = first.relighter().surface().irradiance;
  }
  EXPECT_FALSE(QFile::exists(path("saved.prt.work"))) << "nothing is left behind";
  Session& other = session;
  int previews = 0;
  QObject::connect(&other.bakes(), &BakeController::productArrived,
                   [&](const QString&, const ProductState& state) { previews += !state.final(); });
  other.open(path("saved.prt"));
  ASSERT_TRUE(waitFor([&] { return other.settled() && other.bakes().fresh(); }));
  EXPECT_EQ(previews, 0) << "everything was in the project";
  EXPECT_NEAR(other.environmentAngle(), 33, 1e-4);
  EXPECT_EQ(other.relighter().surface().irradiance, irradiance);
  EXPECT_TRUE(messages.empty());
}

TEST_F(SessionTest, SavingAgainIntoTheSameFileKeepsUndo) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  session.save(path("a.prt"));
  ASSERT_TRUE(quiet());
  session.setEnvironmentAngle(10);
  session.save(path("a.prt"));
  ASSERT_TRUE(quiet());
  EXPECT_TRUE(messages.empty());
  EXPECT_FALSE(session.document().modified());
  EXPECT_TRUE(session.document().canUndo());
}

TEST_F(SessionTest, AFileThatCannotBeWrittenIsTold) {
  ASSERT_TRUE(openAndSettle(writeScene()));
  session.save(path("no/such/folder/a.prt"));
  ASSERT_TRUE(quiet());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].severity, Severity::Error);
  EXPECT_TRUE(session.document().path().isEmpty());
}

TEST_F(SessionTest, DestructionInTheMidstOfEverythingIsClean) {
  for (int i = 0; i < 4; ++i) {
    Session brief;
    Recipe recipe = smallScene();
    recipe.transfer.rays = 1 << 20;
    brief.open(write("slow.json", QByteArray::fromStdString(recipeToJson(recipe).dump())));
    test::pass(60 * i);
  }
}

}  // namespace
}  // namespace prt::ui
