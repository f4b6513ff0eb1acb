// The command palette, from the keyboard.

#include "tests/ui/studio_fixture.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/window/command_palette.h"
#include "ui/window/layouts.h"

#include <QApplication>
#include <QDockWidget>
#include <QLineEdit>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>

namespace prt::ui {
namespace {

using test::pass;
using test::s;
using test::smallScene;
using test::waitFor;

class PaletteTest : public test::StudioTest {
 protected:
  PaletteTest() { QSettings().remove(s("palette")); }

  CommandPalette& palette() { return window.commandPalette(); }
  QLineEdit* line() { return window.findChild<QLineEdit*>(s("paletteLine")); }
  void openPalette() {
    QTest::keyClick(handle(), Qt::Key_K, Qt::ControlModifier);
    ASSERT_TRUE(palette().isOpen());
  }
  void type(const char* text) { QTest::keyClicks(line(), s(text)); }
  void enter() { QTest::keyClick(line(), Qt::Key_Return); }
};

TEST_F(PaletteTest, CtrlKAndF3OpenItAndEscGivesTheKeyboardBack) {
  openAndSettle();
  QWidget* before = QApplication::focusWidget();
  openPalette();
  EXPECT_TRUE(line()->hasFocus());
  QTest::keyClick(line(), Qt::Key_Escape);
  EXPECT_FALSE(palette().isOpen());
  EXPECT_EQ(QApplication::focusWidget(), before);
  QTest::keyClick(handle(), Qt::Key_F3);
  EXPECT_TRUE(palette().isOpen());
}

TEST_F(PaletteTest, AClickBesideItClosesIt) {
  openAndSettle();
  openPalette();
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, QPoint(20, window.height() - 60));
  EXPECT_FALSE(palette().isOpen());
}

TEST_F(PaletteTest, EnterRunsTheBestMatch) {
  openAndSettle();
  const Camera home = session.view().camera();
  session.view().orbit(0.4f, 0.1f);
  openPalette();
  type("resv");
  EXPECT_EQ(palette().titles().first(), s("Reset view"));
  enter();
  EXPECT_FALSE(palette().isOpen());
  EXPECT_EQ(session.view().camera(), home);
}

TEST_F(PaletteTest, ArrowsChooseAndGoAround) {
  openAndSettle();
  openPalette();
  type("layout");
  auto* list = window.findChild<QListView*>(s("paletteList"));
  const int rows = list->model()->rowCount();
  ASSERT_GT(rows, 2);
  EXPECT_EQ(list->currentIndex().row(), 0);
  QTest::keyClick(line(), Qt::Key_Down);
  EXPECT_EQ(list->currentIndex().row(), 1);
  QTest::keyClick(line(), Qt::Key_Up);
  QTest::keyClick(line(), Qt::Key_Up);
  EXPECT_EQ(list->currentIndex().row(), rows - 1);
}

TEST_F(PaletteTest, SamplesLayoutsAndButtonsAreCommands) {
  openAndSettle();
  openPalette();
  const QStringList all = palette().titles();
  for (const QString& sample : session.sampleScenes())
    EXPECT_TRUE(all.contains(sample)) << sample.toStdString();
  for (const LayoutPlan& plan : window.layouts().plans())
    EXPECT_TRUE(all.contains(plan.title)) << plan.title.toStdString();
  EXPECT_TRUE(all.contains(s("Bake by itself after edits")));
}

TEST_F(PaletteTest, EveryActionOfTheMenusIsThere) {
  openAndSettle();
  openPalette();
  const QStringList all = palette().titles();
  int actions = 0;
  for (const QMenu* menu : window.menuBar()->findChildren<QMenu*>())
    for (const QAction* action : menu->actions()) {
      if (action->menu() || action->isSeparator() || !action->isVisible() || action->text().isEmpty())
        continue;
      ++actions;
      EXPECT_TRUE(all.contains(action->text().remove(u'&'))) << action->text().toStdString();
    }
  EXPECT_GT(actions, 15);
}

TEST_F(PaletteTest, AParameterIsFocusedInItsRowEvenInATabBehind) {
  openAndSettle();
  window.layouts().choose(s("bake"));
  auto* light = window.findChild<QDockWidget*>(s("light"));
  window.bringToFront(s("light"));
  pass(50);
  auto* row = window.findChild<PropertyRow*>(s("transfer.rays"));
  openPalette();
  type("transfer.rays");
  enter();
  EXPECT_TRUE(row->isVisible());
  EXPECT_TRUE(row->editor()->hasFocus());
  QTest::keyClick(row->editor(), Qt::Key_Up);
  EXPECT_EQ(session.document().undoName(), s("Rays")) << "and can be changed at once";
  EXPECT_FALSE(light->widget()->visibleRegion().isEmpty());
  openPalette();
  type("albedo");
  enter();
  pass(30);
  EXPECT_TRUE(light->widget()->visibleRegion().isEmpty()) << "the material's tab came to the front";
}

TEST_F(PaletteTest, ALineSetsAValue) {
  openAndSettle();
  openPalette();
  type("transfer.bands = 4");
  enter();
  EXPECT_EQ(session.document().recipe().transfer.bands, 4);
  EXPECT_EQ(session.document().undoName(), s("Bands"));
}

TEST_F(PaletteTest, AWrongValueIsToldAndChangesNothing) {
  openAndSettle();
  openPalette();
  type("transfer.bands = 99");
  EXPECT_TRUE(palette().titles().first().contains(s("transfer.bands")))
      << palette().titles().first().toStdString();
  enter();
  EXPECT_TRUE(palette().isOpen()) << "to be corrected";
  EXPECT_EQ(session.document().recipe().transfer.bands, 5);
}

TEST_F(PaletteTest, AParameterWithoutARowIsSetInTheLine) {
  openAndSettle();
  openPalette();
  type("transfer.seed");
  enter();
  ASSERT_TRUE(palette().isOpen());
  EXPECT_EQ(line()->text(), s("transfer.seed = 1"));
  QTest::keyClick(line(), Qt::Key_Backspace);
  type("7");
  enter();
  EXPECT_FALSE(palette().isOpen());
  EXPECT_EQ(session.document().recipe().transfer.seed, 7u);
}

TEST_F(PaletteTest, AParameterWhoseRowIsTakenAwayIsSetInTheLine) {
  openAndSettle();
  auto* row = window.findChild<PropertyRow*>(s("patch.yarns"));
  ASSERT_TRUE(row->isHidden()) << "there is no weave";
  openPalette();
  type("patch.yarns");
  enter();
  ASSERT_TRUE(palette().isOpen());
  EXPECT_TRUE(line()->text().startsWith(s("patch.yarns = "))) << line()->text().toStdString();
  line()->setText(s("patch.model = weave"));
  enter();
  EXPECT_FALSE(row->isHidden());
  openPalette();
  type("patch.yarns");
  enter();
  EXPECT_TRUE(row->editor()->hasFocus()) << "now it has a row to go to";
}

TEST_F(PaletteTest, EveryParameterOfTheRecipeIsFound) {
  openAndSettle();
  openPalette();
  for (const std::string& path : pathsOf(session.document().recipe())) {
    line()->setText(QString::fromStdString(path).section(u'.', -1));
    EXPECT_FALSE(palette().titles().isEmpty()) << path;
  }
}

TEST_F(PaletteTest, WhatWasUsedLeadsNextTime) {
  openAndSettle();
  openPalette();
  type("frame all");
  enter();
  openPalette();
  EXPECT_EQ(palette().titles().first(), s("Frame all"));
}

TEST_F(PaletteTest, LettersTypedInItAreNoShortcuts) {
  openAndSettle();
  const Camera before = session.view().camera();
  session.view().orbit(0.3f, 0);
  const Camera turned = session.view().camera();
  openPalette();
  type("r?f");
  EXPECT_EQ(line()->text(), s("r?f"));
  EXPECT_EQ(session.view().camera(), turned);
  EXPECT_NE(before, turned);
}

}  // namespace
}  // namespace prt::ui
