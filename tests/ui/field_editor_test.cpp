// Strokes drawn with the mouse and the field that follows them.

#include "ui/model/field_editor.h"

#include "libprt/project/synthesis_stages.h"
#include "tests/ui/brush_fixture.h"
#include "tests/ui/pointer.h"
#include "ui/model/chart_editor.h"
#include "ui/viewport/view_geometry.h"

#include <QAction>
#include <QCheckBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class FieldEditorTest : public test::BrushTest {
 protected:
  void openShape() { openAndSettle(quickScene()); }
  void takeBrush() {
    BrushTest::takeBrush(Qt::Key_D, Brush::Strokes);
    settle();
  }
  void settle() {
    ASSERT_TRUE(waitFor([this] { return session.painting().on() && field.settled(); }));
    ASSERT_TRUE(settled());
    pass(50);
  }
  ViewGeometry geometry() { return {session.view().camera(), window.viewport().size()}; }
  /// Up the middle of the model.
  void drawUpwards() { Pointer(&window.viewport()).drag(at(0, 60), at(0, -60)); }
  QPushButton* button(const char* name) { return find<QPushButton>(name); }

  FieldEditor& field = session.field();
};

TEST_F(FieldEditorTest, ADragDrawsAStrokeThatTheFieldFollowsAndUndoTakesItBack) {
  openShape();
  takeBrush();
  EXPECT_TRUE(field.shown()) << "one sees what one does";
  ASSERT_TRUE(field.field());
  const QImage before = shot();
  Pointer hand(&window.viewport());
  hand.press(at(0, 60));
  for (int i = 1; i <= 4; ++i) hand.move(at(0, 60 - 30 * i));
  EXPECT_TRUE(field.drawing());
  EXPECT_GT(difference(before, shot()), 0.0005) << "it is shown while it is drawn";
  EXPECT_TRUE(session.document().recipe().field.strokes.empty());
  hand.release(at(0, -60));
  ASSERT_EQ(field.strokes().size(), 1u);
  EXPECT_EQ(undoName(), s("Paint stroke"));
  EXPECT_EQ(field.selected(), 0);
  settle();
  // The stroke goes up on screen; so does the field there.
  const auto hit = window.viewport().pick(at(0, 0));
  ASSERT_TRUE(hit);
  const Vec3 normal = session.painting().on()->normalAt({hit->triangle, hit->barycentric});
  const Vec3 tangent = tangentAt(field.field()->frames, hit->triangle, hit->barycentric, normal);
  const auto from = geometry().project(hit->position),
             to = geometry().project(hit->position + 0.01f * tangent);
  ASSERT_TRUE(from && to);
  EXPECT_LT(to->y() - from->y(), -5 * std::abs(to->x() - from->x()));
  // Points of the stroke are few, and lie under the way of the hand.
  const auto& points = field.strokes()[0].points;
  EXPECT_LT(points.size(), 20u);
  EXPECT_LT(std::abs(geometry().project(points.front())->y() - at(0, 60).y()), 2);
  EXPECT_LT(std::abs(geometry().project(points.back())->y() - at(0, -60).y()), 2);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(field.strokes().empty());
  EXPECT_TRUE(session.document().recipe().field.strokes.empty());
}

TEST_F(FieldEditorTest, ClickSelectsDeleteErasesAndCtrlClickToo) {
  openShape();
  takeBrush();
  drawUpwards();
  Pointer hand(&window.viewport());
  hand.drag(at(-20, 40), at(20, 40));
  ASSERT_EQ(field.strokes().size(), 2u);
  hand.click(at(0, -30));
  EXPECT_EQ(field.selected(), 0);
  EXPECT_EQ(field.strokes().size(), 2u) << "a click is no stroke";
  QTest::keyClick(&window.viewport(), Qt::Key_Delete);
  ASSERT_EQ(field.strokes().size(), 1u);
  EXPECT_EQ(undoName(), s("Erase stroke"));
  hand.press(at(10, 40), Qt::ControlModifier);
  hand.release(at(10, 40), Qt::ControlModifier);
  EXPECT_TRUE(field.strokes().empty());
  session.document().undo();
  session.document().undo();
  EXPECT_EQ(field.strokes().size(), 2u);
}

TEST_F(FieldEditorTest, EscDropsWhatIsDrawnThenLeaves) {
  openShape();
  takeBrush();
  Pointer hand(&window.viewport());
  hand.press(at(0, 40));
  hand.move(at(0, -40));
  ASSERT_TRUE(field.drawing());
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_FALSE(field.drawing());
  EXPECT_EQ(session.painting().brush(), Brush::Strokes);
  hand.release(at(0, -40));
  EXPECT_TRUE(field.strokes().empty());
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_EQ(session.painting().brush(), Brush::None);
}

TEST_F(FieldEditorTest, AltDragNavigatesAndTheKnifePutsTheBrushAway) {
  openShape();
  takeBrush();
  const Camera before = session.view().camera();
  Pointer(&window.viewport()).drag(QPointF(20, 200), QPointF(80, 200));
  EXPECT_TRUE(field.strokes().empty()) << "beside the model";
  Pointer(&window.viewport()).drag(at(0, 0), at(60, 0), Qt::AltModifier);
  EXPECT_TRUE(field.strokes().empty());
  EXPECT_GT(distance(session.view().camera().eye, before.eye), 0.01f);
  QTest::keyClick(&window, Qt::Key_K);
  EXPECT_TRUE(session.charts().cutting());
  EXPECT_EQ(session.painting().brush(), Brush::None);
  QTest::keyClick(&window, Qt::Key_D);
  EXPECT_FALSE(session.charts().cutting());
}

TEST_F(FieldEditorTest, TheDockDrawsErasesAndTells) {
  Recipe recipe = test::smallScene();
  recipe.transfer.rays = 64, recipe.transfer.bounces = 0;
  openAndSettle(recipe);
  ASSERT_TRUE(window.bringToFront(s("synthesis")));
  pass(50);
  QTest::mouseClick(button("drawStrokes"), Qt::LeftButton);
  EXPECT_EQ(session.painting().brush(), Brush::Strokes);
  EXPECT_TRUE(window.findChild<QAction*>(s("paintStrokes"))->isChecked());
  settle();
  EXPECT_FALSE(button("eraseStrokes")->isEnabled());
  drawUpwards();
  Pointer(&window.viewport()).drag(at(-20, 40), at(20, 40));
  settle();
  auto* told = window.findChild<QLabel*>(s("strokesState"));
  EXPECT_TRUE(told->text().startsWith(s("2 strokes"))) << told->text().toStdString();
  EXPECT_TRUE(told->text().contains(s("winds in"))) << told->text().toStdString();
  EXPECT_EQ(button("eraseStrokes")->text(), s("Erase"));
  QTest::mouseClick(button("eraseStrokes"), Qt::LeftButton);
  ASSERT_EQ(field.strokes().size(), 1u) << "the selected one";
  field.select(-1);
  QTest::mouseClick(button("eraseStrokes"), Qt::LeftButton);
  EXPECT_TRUE(field.strokes().empty());
  auto* shown = window.findChild<QCheckBox*>(s("showField"));
  Pointer(shown).click(QPointF(8, shown->height() / 2.0));
  EXPECT_FALSE(field.shown());
  EXPECT_TRUE(session.layers().marks().empty());
  EXPECT_FALSE(shown->isChecked());
}

TEST_F(FieldEditorTest, LinesAreShownOnBothCanvasesAndGoWithTheirScene) {
  openShape();
  field.setShown(true);
  settle();
  for (const Drawing drawing : {Drawing::Cpu, Drawing::OpenGl}) {
    window.viewport().setDrawing(drawing);
    ASSERT_TRUE(waitFor([this] { return window.viewport().canvas().settled(); }));
    const QImage with = shot();
    field.setShown(false);
    ASSERT_TRUE(waitFor([this] { return window.viewport().canvas().settled(); }));
    EXPECT_GT(difference(with, shot()), 0.005) << int(drawing);
    field.setShown(true);
    settle();
  }
  session.document().set(s("mesh.detail"), s("0.2"));
  settle();
  EXPECT_EQ(field.field()->frames.tangents.size(), 3 * session.relighter().scene()->mesh.triangleCount());
}

TEST_F(FieldEditorTest, StrokesThatCannotBeReadAreTold) {
  openShape();
  field.setShown(true);
  settle();
  Recipe broken = session.document().recipe();
  broken.field.strokes = "1,2";
  session.document().edit(s("break"), broken);
  EXPECT_TRUE(field.error().contains(s("field.strokes"))) << field.error().toStdString();
  EXPECT_FALSE(field.field());
  session.document().undo();
  EXPECT_TRUE(field.error().isEmpty());
  settle();
  EXPECT_TRUE(field.field());
}

}  // namespace
}  // namespace prt::ui
