#pragma once
// A studio in which somebody paints on the model.

#include "tests/ui/studio_fixture.h"
#include "ui/model/painting.h"

#include <QDockWidget>

namespace prt::test {

class BrushTest : public StudioTest {
 protected:
  /// Baked in a moment, with square compartments as its patch.
  static Recipe quickScene() {
    Recipe recipe = smallScene();
    recipe.transfer.rays = 64, recipe.transfer.bounces = 0;
    return recipe;
  }
  static Recipe quickPatch() {
    Recipe recipe = quickScene();
    recipe.patch.model = PatchModel::HeightField;
    recipe.patch.heightmap = "builtin:bins";
    recipe.patch.grid = 24;
    recipe.rtt.texels = 12, recipe.rtt.views = 4, recipe.rtt.rays = 64, recipe.rtt.bounces = 1;
    recipe.rtt.supersamples = 1;
    return recipe;
  }
  /// The Synthesis dock in front, and of the others these at most.
  void openWithDocks(const Recipe& recipe, const QStringList& others = {}) {
    openAndSettle(recipe);
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->objectName() != s("synthesis") && !others.contains(dock->objectName())) dock->hide();
    ASSERT_TRUE(window.bringToFront(s("synthesis")));
    pass(50);
  }
  /// By its key; it can paint when the surface is read.
  void takeBrush(Qt::Key key, ui::Brush brush) {
    window.viewport().setFocus();
    QTest::keyClick(&window, key);
    ASSERT_EQ(session.painting().brush(), brush);
    ASSERT_TRUE(waitFor([this] { return session.painting().on() != nullptr; }));
  }
  /// A place in the viewport, from its middle.
  QPointF at(double dx, double dy) {
    return QPointF(window.viewport().width() / 2 + dx, window.viewport().height() / 2 + dy);
  }
  template <class Widget>
  Widget* find(const char* name) {
    return window.findChild<Widget*>(s(name));
  }
  /// With what lies over the model.
  QImage shot() {
    pass(50);
    return window.viewport().canvas().widget()->grab().toImage();
  }
};

}  // namespace prt::test
