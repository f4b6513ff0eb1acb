// Wishes painted with the mouse, and the part of the patch that is picked for them.

#include "ui/model/wish_editor.h"

#include "tests/ui/brush_fixture.h"
#include "tests/ui/pointer.h"
#include "ui/widgets/exemplar_square.h"

#include <QCheckBox>
#include <QPushButton>

namespace prt::ui {
namespace {

using test::difference;
using test::Pointer;
using test::s;
using test::waitFor;

class WishEditorTest : public test::BrushTest {
 protected:
  void openShape(bool patch = true) { openWithDocks(patch ? quickPatch() : quickScene()); }
  void takeBrush() {
    BrushTest::takeBrush(Qt::Key_W, Brush::Wishes);
    ASSERT_TRUE(waitFor([this] { return wishes.settled(); }));
  }
  QPushButton* button(const char* name) { return find<QPushButton>(name); }
  ExemplarSquare* exemplar() { return find<ExemplarSquare>("exemplarSquare"); }

  WishEditor& wishes = session.wishes();
};

TEST_F(WishEditorTest, ADragPaintsSpotsOfThePickedPartAndUndoTakesThemBack) {
  openShape();
  takeBrush();
  wishes.setPart({0.25f, 0.75f}, 0.1f);
  const QImage before = shot();
  Pointer hand(&window.viewport());
  hand.press(at(0, 60));
  hand.move(at(0, 0));
  hand.move(at(0, -60));
  EXPECT_TRUE(wishes.painting());
  EXPECT_GT(difference(before, shot()), 0.005) << "the region is shown while it is painted";
  EXPECT_TRUE(session.document().recipe().synthesis.wishes.empty());
  hand.release(at(0, -60));
  ASSERT_GT(wishes.wishes().size(), 2u);
  EXPECT_EQ(undoName(), s("Paint wish"));
  for (const PatchWish& wish : wishes.wishes()) {
    EXPECT_EQ(wish.place, Vec2(0.25f, 0.75f));
    EXPECT_EQ(wish.extent, 0.1f);
    EXPECT_NEAR(wish.radius, wishes.radius(), 1e-6f);
  }
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(wishes.wishes().empty());
  EXPECT_TRUE(session.layers().marks().empty());
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(wishes.wishes().empty());
}

TEST_F(WishEditorTest, CtrlDragErasesAClickPaintsOneSpotAndKeysSizeTheBrush) {
  openShape();
  takeBrush();
  Pointer hand(&window.viewport());
  hand.click(at(0, 0));
  ASSERT_EQ(wishes.wishes().size(), 1u);
  const float width = wishes.width();
  QTest::keyClick(&window.viewport(), Qt::Key_BracketRight);
  EXPECT_GT(wishes.width(), width);
  QTest::keyClick(&window.viewport(), Qt::Key_BracketLeft);
  EXPECT_NEAR(wishes.width(), width, 1e-6f);
  hand.drag(at(-10, 0), at(10, 0), Qt::ControlModifier);
  EXPECT_TRUE(wishes.wishes().empty());
  EXPECT_EQ(undoName(), s("Erase wishes"));
  session.document().undo();
  EXPECT_EQ(wishes.wishes().size(), 1u);
}

TEST_F(WishEditorTest, EscDropsWhatIsPaintedThenLeaves) {
  openShape();
  takeBrush();
  Pointer hand(&window.viewport());
  hand.press(at(0, 40));
  hand.move(at(0, -40));
  ASSERT_TRUE(wishes.painting());
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_FALSE(wishes.painting());
  hand.release(at(0, -40));
  EXPECT_TRUE(wishes.wishes().empty());
  EXPECT_TRUE(session.document().recipe().synthesis.wishes.empty());
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_EQ(session.painting().brush(), Brush::None);
}

TEST_F(WishEditorTest, ThePartIsPickedOnThePictureOfThePatch) {
  openShape(false);
  EXPECT_FALSE(exemplar()->isVisible()) << "there is no patch yet";
  openShape();
  ASSERT_TRUE(waitFor([this] { return exemplar()->hasPicture(); }));
  const QRectF box = exemplar()->square();
  const QImage before = exemplar()->grab().toImage();
  Pointer hand(exemplar());
  hand.press(box.topLeft() + QPointF(0.25 * box.width(), 0.25 * box.height()));
  hand.move(box.topLeft() + QPointF(0.45 * box.width(), 0.25 * box.height()));
  hand.release(box.topLeft() + QPointF(0.45 * box.width(), 0.25 * box.height()));
  EXPECT_NEAR(wishes.place().x, 0.25f, 0.01f);
  EXPECT_NEAR(wishes.place().y, 0.75f, 0.01f) << "v is up";
  EXPECT_NEAR(wishes.extent(), 0.2f, 0.01f);
  EXPECT_GT(difference(before, exemplar()->grab().toImage()), 0.01);
  QTest::keyClick(exemplar(), Qt::Key_Right);
  EXPECT_NEAR(wishes.place().x, 0.27f, 0.01f);
}

TEST_F(WishEditorTest, WishesOfAFileAreFoundOnTheSurfaceAndTheDockErasesThem) {
  openShape();
  takeBrush();
  Pointer(&window.viewport()).drag(at(0, 40), at(0, -40));
  const Recipe painted = session.document().recipe();
  const auto marks = session.layers().marks();
  ASSERT_EQ(marks.size(), 1u);
  session.document().undo();  // nobody is asked whether it should be saved
  openAndSettle(painted);
  EXPECT_EQ(session.painting().brush(), Brush::None);
  ASSERT_TRUE(waitFor([this] { return session.painting().on() && wishes.settled(); }));
  ASSERT_EQ(session.layers().marks().size(), 1u);
  EXPECT_EQ(session.layers().marks()[0].triangles.size(), marks[0].triangles.size());
  auto* shown = window.findChild<QCheckBox*>(s("showWishes"));
  Pointer(shown).click(QPointF(8, shown->height() / 2.0));
  EXPECT_TRUE(session.layers().marks().empty());
  QTest::mouseClick(button("eraseWishes"), Qt::LeftButton);
  EXPECT_TRUE(session.document().recipe().synthesis.wishes.empty());
  EXPECT_EQ(undoName(), s("Erase all wishes"));
}

}  // namespace
}  // namespace prt::ui
