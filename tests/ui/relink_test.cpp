// Projects whose files moved, and the questions and bars around documents, with real clicks.

#include "libprt/core/image_io.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_writer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/dialogs/relink_dialog.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/recovery_bar.h"

#include <QAbstractButton>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

namespace prt::ui {
namespace {

using test::s;
using test::StudioTest;
using test::waitFor;

class Relink : public StudioTest {
 protected:
  QString path(const char* name) const { return folder.filePath(QLatin1String(name)); }
  void SetUp() override { session.project().setRecoveryRoot(path("recovery").toStdString()); }
  void write(const char* name, const char* builtin) const {
    Job job;
    writeMesh(path(name).toStdString(), makeBuiltinMesh(builtin, 0.3f, 1), {}, job);
  }
  // A project with a mesh and a probe in folders of their own.
  void makeProject() {
    QDir(folder.path()).mkpath(s("data"));
    write("data/thing.obj", "rock");
    writeImage(path("data/probe.hdr").toStdString(), softboxStudio(64, 32).pixels());
    Recipe recipe = test::smallScene();
    recipe.objects[0].mesh.path = "data/thing.obj";
    recipe.lights[0].path = "data/probe.hdr";
    openAndSettle(recipe);
    session.save(path("a.prt"));
    ASSERT_TRUE(waitFor([this] { return !session.project().saving(); }));
    openAndSettle();
  }
  QAbstractButton* named(const char* name) {
    for (auto* each : window.findChildren<QAbstractButton*>(s(name)))
      if (each->isVisible()) return each;
    return nullptr;
  }
  // Presses a button of the question once it is there.
  void answer(const char* text, QStringList* said = nullptr) {
    auto* poll = new QTimer(&window);
    QObject::connect(poll, &QTimer::timeout, &window, [this, poll, text, said] {
      auto* box = window.findChild<QMessageBox*>(s("leaveQuestion"));
      if (!box || !box->isVisible()) return;
      poll->deleteLater();
      if (said) *said << box->informativeText();
      for (QAbstractButton* each : box->buttons())
        if (each->text().remove(u'&') == QLatin1String(text)) return QTest::mouseClick(each, Qt::LeftButton);
    });
    poll->start(20);
  }
};

TEST_F(Relink, AProjectWhoseFilesMovedOpensAndFindsThemAgain) {
  makeProject();
  QDir(folder.path()).mkpath(s("elsewhere/deep"));
  QFile::rename(path("data/thing.obj"), path("elsewhere/deep/thing.obj"));
  QFile::rename(path("data/probe.hdr"), path("elsewhere/probe.hdr"));
  session.open(path("a.prt"));
  ASSERT_TRUE(
      waitFor([this] { return session.document().title() == QLatin1String("a.prt") && session.settled(); }));
  EXPECT_TRUE(session.relighter().scene() != nullptr) << "the mesh is in the project";
  EXPECT_TRUE(waitFor([this] { return session.bakes().fresh(); })) << "and so is what was baked";
  EXPECT_EQ(session.project().brokenLinks().size(), 2u);
  const QString said = window.messageBar().text();
  EXPECT_TRUE(said.contains(s("thing.obj")) && said.contains(s("probe.hdr"))) << said.toStdString();

  QAbstractButton* locate = named("messageFix");
  ASSERT_NE(locate, nullptr);
  QTest::mouseClick(locate, Qt::LeftButton);
  auto* dialog = window.findChild<RelinkDialog*>(s("relinkDialog"));
  ASSERT_NE(dialog, nullptr);
  EXPECT_FALSE(dialog->isModal());
  dialog->search(path("elsewhere"));
  auto* relink = dialog->findChild<QPushButton*>(s("relink"));
  ASSERT_TRUE(waitFor([&] { return relink->isEnabled(); }));
  QTest::mouseClick(relink, Qt::LeftButton);
  EXPECT_EQ(session.document().recipe().objects[0].mesh.path, "elsewhere/deep/thing.obj");
  EXPECT_EQ(session.document().recipe().lights[0].path, "elsewhere/probe.hdr");
  EXPECT_EQ(session.document().undoName(), s("Relink 2 files"));
  EXPECT_TRUE(session.project().brokenLinks().empty());
  ASSERT_TRUE(waitFor([this] { return session.settled() && session.bakes().fresh(); }));
  EXPECT_TRUE(session.relighter().environment() != nullptr);
}

TEST_F(Relink, OtherContentsAreTakenOnlyWhenTicked) {
  makeProject();
  QDir(folder.path()).mkpath(s("elsewhere"));
  QFile::remove(path("data/thing.obj"));
  write("elsewhere/thing.obj", "vase");
  session.open(path("a.prt"));
  ASSERT_TRUE(waitFor([this] { return session.project().brokenLinks().size() == 1; }));
  RelinkDialog dialog(session.project(), &window);
  dialog.show();
  dialog.search(folder.path() + s("/elsewhere"));
  auto* result = dialog.findChild<QLabel*>(s("relinkResult"));
  ASSERT_TRUE(waitFor([&] { return result->text().contains(s("other contents")); }))
      << result->text().toStdString();
  auto* relink = dialog.findChild<QPushButton*>(s("relink"));
  QTest::mouseClick(relink, Qt::LeftButton);
  EXPECT_EQ(session.project().brokenLinks().size(), 1u) << "not without a tick";
  dialog.findChild<QTreeWidget*>()->topLevelItem(0)->setCheckState(0, Qt::Checked);
  QTest::mouseClick(relink, Qt::LeftButton);
  EXPECT_TRUE(session.project().brokenLinks().empty());
  EXPECT_EQ(session.document().recipe().objects[0].mesh.path, "elsewhere/thing.obj");
}

TEST_F(Relink, AFileThatChangedIsTold) {
  makeProject();
  write("data/thing.obj", "vase");
  session.open(path("a.prt"));
  ASSERT_TRUE(waitFor([this] { return session.project().brokenLinks().size() == 1; }));
  EXPECT_EQ(session.project().brokenLinks()[0].state, LinkState::Changed);
  EXPECT_TRUE(window.messageBar().text().contains(s("Changed"))) << window.messageBar().text().toStdString();
  EXPECT_EQ(named("messageFix"), nullptr) << "nothing to locate";
}

TEST_F(Relink, ClosingAsksAboutEditsOnlyAndSaysWhatTheyAre) {
  openAndSettle();
  QStringList said;
  session.document().set(s("objects[0].material.exponent"), s("90"));
  answer("Cancel", &said);
  EXPECT_FALSE(window.close());
  EXPECT_TRUE(window.isVisible());
  ASSERT_EQ(said.size(), 1);
  EXPECT_TRUE(said[0].contains(s("1 edit since the last save: Exponent of vase"))) << said[0].toStdString();

  session.save(path("b.prt"));
  ASSERT_TRUE(waitFor([this] { return !session.project().saving(); }));
  session.setEnvironmentAngle(20);
  answer("Save");
  EXPECT_FALSE(window.close()) << "once it is saved";
  EXPECT_TRUE(waitFor([this] { return !window.isVisible(); }));
  EXPECT_NEAR(double(ProjectFile::open(path("b.prt").toStdString())->recipe().lights[0].rotation), 20, 1e-4);
}

TEST_F(Relink, ClosingWithoutEditsAsksNothing) {
  openAndSettle();
  EXPECT_TRUE(window.close());
}

TEST_F(Relink, DroppingAMeshOverEditsAsks) {
  makeProject();
  session.setEnvironmentAngle(20);
  const auto drop = [this] {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path("data/thing.obj"))});
    QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window.viewport(), &enter);
    QDropEvent event(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window.viewport(), &event);
  };
  answer("Cancel");
  drop();
  EXPECT_FALSE(session.opening());
  answer("Don't save");
  drop();
  EXPECT_TRUE(waitFor([this] { return session.document().title() == QLatin1String("thing.obj"); }));
}

TEST_F(Relink, TheHistoryGoesBackSeveralSteps) {
  openAndSettle();
  const Recipe first = session.document().recipe();
  for (const char* exponent : {"20", "30", "40"})
    session.document().set(s("objects[0].material.exponent"), QLatin1String(exponent));
  auto* history = window.findChild<QMenu*>(s("history"));
  ASSERT_NE(history, nullptr);
  Q_EMIT history->aboutToShow();
  ASSERT_EQ(history->actions().size(), 4);
  EXPECT_EQ(history->actions()[1]->text(), s("Exponent of vase"));
  history->actions()[3]->trigger();
  EXPECT_EQ(session.document().recipe(), first);
  Q_EMIT history->aboutToShow();
  history->actions()[0]->trigger();
  EXPECT_EQ(session.document().recipe().objects[0].material.exponent, 40);
}

TEST_F(Relink, RecentFilesThatAreGoneAreGreyAndCanBeRemoved) {
  makeProject();
  auto* menu = window.findChild<QMenu*>(s("recentFiles"));
  ASSERT_NE(menu, nullptr);
  Q_EMIT menu->aboutToShow();
  EXPECT_EQ(menu->actions()[0]->text(), s("a.prt"));
  EXPECT_TRUE(menu->actions()[0]->isEnabled());
  QFile::remove(path("a.prt"));
  Q_EMIT menu->aboutToShow();
  EXPECT_FALSE(menu->actions()[0]->isEnabled());
  menu->actions()[menu->actions().size() - 2]->trigger();
  EXPECT_FALSE(session.project().recent().files().contains(path("a.prt")));
}

TEST_F(Relink, WhatACrashLeftIsOfferedAndRestored) {
  makeProject();
  auto place = RecoveryPlace::create(path("recovery").toStdString());
  RecoveryEntry entry;
  entry.path = path("a.prt");
  entry.title = s("a.prt");
  entry.time = QDateTime::currentDateTime();
  entry.edits = {s("Turn environment")};
  entry.saved = entry.recipe = ProjectFile::open(path("a.prt").toStdString())->recipe();
  entry.recipe.lights[0].rotation = 33;
  place->keep(entry, {});
  place.reset();
  window.offerRecovery();
  test::pass(50);
  auto* bar = window.findChild<RecoveryBar*>();
  ASSERT_TRUE(bar && bar->isVisible());
  ASSERT_NE(named("openSaved"), nullptr);
  QTest::mouseClick(named("openSaved"), Qt::LeftButton);
  ASSERT_TRUE(
      waitFor([this] { return session.document().title() == QLatin1String("a.prt") && session.settled(); }));
  EXPECT_EQ(session.environmentAngle(), 0);
  EXPECT_TRUE(bar->isVisible()) << "still on offer";
  QTest::mouseClick(named("restoreRecovery"), Qt::LeftButton);
  ASSERT_TRUE(waitFor([this] { return std::abs(session.environmentAngle() - 33) < 1e-3; }));
  EXPECT_TRUE(session.document().modified());
  EXPECT_FALSE(bar->isVisible());
}

}  // namespace
}  // namespace prt::ui
