#include "ui/docks/synthesis_dock.h"

#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/widgets/property_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class SynthesisDockTest : public test::StudioTest {
 protected:
  SynthesisDockTest() {
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->objectName() != s("synthesis")) dock->hide();
    window.bringToFront(s("synthesis"));
  }
  QCheckBox* shown() { return window.findChild<QCheckBox*>(s("patchOnSurface")); }
  QString state() { return window.findChild<QLabel*>(s("synthesisState"))->text(); }
  QLabel* map() { return window.findChild<QLabel*>(s("idMap")); }
  PropertyRow* row(const char* path) {
    for (PropertyRow* each : window.findChildren<PropertyRow*>())
      if (each->path() == s(path)) return each;
    return nullptr;
  }
  QImage picture() {
    EXPECT_TRUE(settled());
    EXPECT_TRUE(waitFor([&] { return session.jobs().idle(); }));
    pass(300);
    return window.viewport().grab().toImage();
  }
  static Recipe smallPatch() {
    Recipe recipe = test::smallScene();
    recipe.patch.model = PatchModel::HeightField;
    recipe.patch.heightmap = "builtin:bins";
    recipe.patch.grid = 24;
    recipe.rtt.texels = 12, recipe.rtt.views = 4, recipe.rtt.rays = 64, recipe.rtt.bounces = 1;
    recipe.rtt.supersamples = 1;
    recipe.synthesis.vertices = 4000, recipe.synthesis.scale = 0.2f;
    recipe.idmap.size = 128;
    recipe.atlas.size = 256;
    return recipe;
  }
};

TEST_F(SynthesisDockTest, WithoutAPatchItSaysWhatToDo) {
  openAndSettle();
  EXPECT_FALSE(shown()->isEnabled());
  EXPECT_TRUE(state().contains(s("Choose a patch first"))) << state().toStdString();
  EXPECT_FALSE(window.findChild<QPushButton*>(s("synthesisBake"))->isVisible());
}

TEST_F(SynthesisDockTest, OneClickShowsThePatchOnTheSurfaceAndUndoTakesItAway) {
  openAndSettle(smallPatch());
  const QImage plain = picture();
  EXPECT_FALSE(map()->isVisible());
  Pointer(shown()).click(QPointF(8, shown()->height() / 2.0));
  EXPECT_EQ(session.document().recipe().method.name, "biscale");
  const QImage patched = picture();
  EXPECT_EQ(session.status().method, s("Bi-scale"));
  EXPECT_GT(difference(plain, patched), 0.01);
  EXPECT_TRUE(state().contains(s("Distance to the patch"))) << state().toStdString();
  EXPECT_TRUE(map()->isVisible());
  session.document().undo();
  EXPECT_FALSE(shown()->isChecked());
  EXPECT_LT(difference(plain, picture()), 0.002);
}

TEST_F(SynthesisDockTest, IdsAreShownOnTheModelInRedAndGreen) {
  Recipe recipe = smallPatch();
  recipe.method.name = "biscale";
  openAndSettle(recipe);
  auto* ids = window.findChild<QCheckBox*>(s("showIds"));
  ASSERT_TRUE(ids->isEnabled());
  for (QScrollArea* column : window.findChildren<QScrollArea*>())
    if (column->isAncestorOf(ids)) column->ensureWidgetVisible(ids);
  const QImage before = picture();
  Pointer(ids).click(QPointF(8, ids->height() / 2.0));
  const QImage after = picture();
  EXPECT_GT(difference(before, after), 0.02);
  // On the model there is no blue, and all kinds of red and green.
  int onModel = 0, blue = 0, red = 0, green = 0;
  for (int y = -60; y <= 60; y += 4)
    for (int x = -20; x <= 20; x += 4) {
      const QPoint at(window.viewport().width() / 2 + x, window.viewport().height() / 2 + y);
      if (!window.viewport().pick(at)) continue;
      const QColor color = after.pixelColor(at);
      ++onModel;
      blue += color.blue() > 40, red += color.red() > 128, green += color.green() > 128;
    }
  EXPECT_GT(onModel, 100);
  EXPECT_LT(blue, onModel / 20);
  EXPECT_GT(red, onModel / 8);
  EXPECT_GT(green, onModel / 8);
  Pointer(ids).click(QPointF(8, ids->height() / 2.0));
  EXPECT_LT(difference(before, picture()), 0.002);
}

TEST_F(SynthesisDockTest, TheLightTurnsOverThePatchWithoutABake) {
  Recipe recipe = smallPatch();
  recipe.method.name = "biscale";
  openAndSettle(recipe);
  const QImage before = picture();
  session.setEnvironmentAngle(120);
  ASSERT_TRUE(waitFor([&] { return difference(before, window.viewport().grab().toImage()) > 0.01; }));
  EXPECT_TRUE(session.bakes().fresh());
}

TEST_F(SynthesisDockTest, TheFilterChangesThePictureWithoutABake) {
  Recipe recipe = smallPatch();
  recipe.method.name = "biscale";
  recipe.synthesis.scale = 0.05f;  // texels far smaller than pixels
  openAndSettle(recipe);
  ASSERT_TRUE(row("method.filter")->isVisible());
  const QImage sharp = picture();
  session.document().set(s("method.filter"), s("true"));
  ASSERT_TRUE(waitFor([&] {
    const auto patch = session.relighter().shownPatch();
    return patch && patch->filter;
  }));
  EXPECT_TRUE(session.bakes().fresh());
  EXPECT_GT(difference(sharp, picture()), 0.005);
  session.document().undo();
  ASSERT_TRUE(waitFor([&] { return !session.relighter().shownPatch()->filter; }));
  EXPECT_LT(difference(sharp, picture()), 0.002);
}

TEST_F(SynthesisDockTest, RowsAreThoseOfTheWayOfLaying) {
  openAndSettle(smallPatch());
  session.bakes().setAutomatic(false);
  EXPECT_TRUE(row("synthesis.vertices")->isVisible());
  EXPECT_FALSE(row("synthesis.repeat")->isVisible());
  session.document().set(s("synthesis.mapping"), s("uv"));
  EXPECT_FALSE(row("synthesis.vertices")->isVisible());
  EXPECT_TRUE(row("synthesis.repeat")->isVisible());
}

}  // namespace
}  // namespace prt::ui
