// The docks of the meso scale, driven by mouse and keys.

#include "ui/docks/patch_dock.h"
#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/docks/rtt_dock.h"
#include "ui/model/patch_presets.h"
#include "ui/model/told_path.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/patch_canvas.h"
#include "ui/widgets/preset_grid.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/rtt_square.h"
#include "ui/widgets/view_grid.h"

#include <QAction>
#include <QApplication>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class PatchDockTest : public test::StudioTest {
 protected:
  PatchDockTest() {  // one dock as high as it needs to be
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->objectName() != s("patch") && dock->objectName() != s("rtt")) dock->hide();
  }
  void bring(const char* dock) {
    ASSERT_TRUE(window.bringToFront(s(dock)));
    pass(50);
  }
  const PatchOptions& patch() { return session.document().recipe().patch; }
  PresetGrid* presets() { return window.findChild<PresetGrid*>(s("patchPresets")); }
  PatchCanvas* canvas() { return window.findChild<PatchCanvas*>(); }
  RttSquare* square() { return window.findChild<RttSquare*>(); }
  ViewGrid* views() { return window.findChild<ViewGrid*>(); }
  PropertyRow* row(const char* path) {
    for (PropertyRow* each : window.findChildren<PropertyRow*>())
      if (each->path() == s(path)) return each;
    return nullptr;
  }
  int preset(const char* name) {
    for (std::size_t i = 0; i < patchPresets().size(); ++i)
      if (patchPresets()[i].name == s(name)) return int(i);
    return -1;
  }
  void choose(const char* name) { Pointer(presets()).click(QRectF(presets()->cell(preset(name))).center()); }
  /// What the canvas shows once it stands still.
  QImage settledPicture() {
    const PatchPreview& preview = window.findChild<PatchDock*>()->preview();
    EXPECT_TRUE(waitFor([&] { return preview.current(); }));
    return canvas()->grab().toImage();
  }
  Recipe smallRtt() {
    Recipe recipe = test::smallScene();
    recipe.patch = patchPresets()[std::size_t(preset("Bins"))].options;
    recipe.patch.grid = 24;
    recipe.rtt.texels = 12, recipe.rtt.views = 4, recipe.rtt.rays = 64, recipe.rtt.bounces = 1;
    recipe.rtt.supersamples = 1;
    return recipe;
  }
};

TEST_F(PatchDockTest, WithoutAPatchItSaysWhatToDo) {
  openAndSettle();
  bring("patch");
  EXPECT_EQ(patch().model, PatchModel::None);
  EXPECT_FALSE(row("patch.depth")->isVisible());
  bring("rtt");
  EXPECT_FALSE(window.findChild<QPushButton*>(s("rttBake"))->isVisible());
}

TEST_F(PatchDockTest, APresetIsOneStepAndShowsItsShape) {
  openAndSettle();
  bring("patch");
  session.bakes().setAutomatic(false);
  const QImage empty = settledPicture();
  choose("Weave");
  EXPECT_EQ(patch().model, PatchModel::Weave);
  EXPECT_EQ(undoName(), s("Patch: weave"));
  EXPECT_EQ(presets()->current(), preset("Weave"));
  EXPECT_TRUE(row("patch.yarns")->isVisible());
  EXPECT_FALSE(row("patch.heightmap")->isVisible());
  EXPECT_GT(difference(empty, settledPicture()), 0.05);
  session.document().undo();
  EXPECT_EQ(patch().model, PatchModel::None);
  EXPECT_LT(difference(empty, settledPicture()), 0.001);
}

TEST_F(PatchDockTest, DraggingTurnsThePatchAndEditsNothing) {
  openAndSettle();
  bring("patch");
  session.bakes().setAutomatic(false);
  choose("Bins");
  canvas()->setFocus();  // its frame is part of the picture
  const QImage before = settledPicture();
  Pointer hand(canvas());
  hand.drag({60, 60}, {160, 40});
  const QImage turned = settledPicture();
  EXPECT_GT(difference(before, turned), 0.02);
  EXPECT_EQ(undoName(), s("Patch: bins"));
  QTest::mouseDClick(canvas(), Qt::LeftButton, {}, QPoint(60, 60));
  EXPECT_LT(difference(before, settledPicture()), 0.001) << "a double click looks from where it began";
}

TEST_F(PatchDockTest, AFileThatIsNotThereIsToldBesideTheShape) {
  openAndSettle();
  bring("patch");
  session.bakes().setAutomatic(false);
  choose("Stucco");
  settledPicture();
  row("patch.heightmap")->apply(s("\"nowhere/relief.png\""));
  MessageBar* message = window.findChild<PatchDock*>()->findChild<MessageBar*>();
  ASSERT_TRUE(waitFor([&] { return message->isVisible(); }));
  EXPECT_TRUE(message->text().contains(s("relief.png"))) << message->text().toStdString();
  session.document().undo();
  ASSERT_TRUE(waitFor([&] { return !message->isVisible(); }));
}

TEST_F(PatchDockTest, AFileIsChosenInADialogAndToldFromTheProjectsFolder) {
  openAndSettle();
  bring("patch");
  session.bakes().setAutomatic(false);
  choose("Stucco");
  const QTemporaryDir pictures;
  const QString file = pictures.filePath(s("relief.png"));
  QImage picture(8, 8, QImage::Format_Grayscale8);
  picture.fill(90);
  ASSERT_TRUE(picture.save(file));
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  QTimer poll;
  QObject::connect(&poll, &QTimer::timeout, &window, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog || !dialog->isVisible()) return;
    if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
    dialog->findChild<QLineEdit*>(s("fileNameEdit"))->setText(file);
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open), Qt::LeftButton);
  });
  poll.start(50);
  row("patch.heightmap")->findChild<QAction*>(s("browse"))->trigger();
  poll.stop();
  EXPECT_EQ(QString::fromStdString(patch().heightmap), toldPath(session.document(), file));
  EXPECT_NE(undoName(), s("Patch: stucco")) << "a step of its own";
}

TEST_F(PatchDockTest, TheTextureIsBakedAndLitByTheLightOfTheScene) {
  bring("rtt");
  openAndSettle(smallRtt());
  ASSERT_TRUE(waitFor([&] { return views()->grab().toImage() != QImage() && session.jobs().idle(); }));
  pass(100);
  EXPECT_TRUE(window.findChild<QLabel*>(s("rttState"))->text().contains(s("% between its views")));
  const QImage before = square()->grab().toImage();
  Recipe brighter = session.document().recipe();
  brighter.lights[0].intensity *= 0.25f;
  session.document().edit(s("dim"), brighter);
  ASSERT_TRUE(waitFor([&] { return difference(before, square()->grab().toImage()) > 0.3; }))
      << "no bake is needed to see another light";
  EXPECT_TRUE(session.bakes().fresh());
}

TEST_F(PatchDockTest, ThumbnailsAndTheDiscChooseTheView) {
  bring("rtt");
  openAndSettle(smallRtt());
  ASSERT_TRUE(waitFor([&] { return session.jobs().idle(); }));
  pass(100);
  const QImage before = square()->grab().toImage();
  Pointer(views()).click(views()->cell(0).center());
  ASSERT_TRUE(waitFor([&] { return difference(before, square()->grab().toImage()) > 0.05; }));
  const QImage low = square()->grab().toImage();
  Pointer(square()).click(square()->disc().center());
  EXPECT_TRUE(waitFor([&] { return difference(low, square()->grab().toImage()) > 0.05; }));
}

}  // namespace
}  // namespace prt::ui
