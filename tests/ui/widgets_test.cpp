// Fields and rows, driven by mouse and keys.

#include "tests/ui/studio_fixture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/compass.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/property_row.h"

#include "libprt/core/error.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QTimer>
#include <QToolButton>
#include <QToolTip>

namespace prt::ui {
namespace {

using test::pass;
using test::s;
using test::smallScene;
using test::waitFor;

// A window with one row of a document.
struct RowBench {
  explicit RowBench(const char* path) {
    document.open(Recipe{}, {});
    row = std::make_unique<PropertyRow>(document, s(path));
    row->resize(260, row->height());
    row->show();
    row->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(row.get()));
  }
  NumberField& number() { return *qobject_cast<NumberField*>(row->editor()); }
  QWindow* window() { return row->windowHandle(); }
  QPoint fieldCenter() { return row->editor()->geometry().center(); }
  void drag(const QPoint& from, int pixels, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::mousePress(window(), Qt::LeftButton, modifiers, from);
    for (const int at : {pixels / 2, pixels}) {
      const QPointF to = from + QPointF(at, 0);
      QMouseEvent move(QEvent::MouseMove, to, window()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                       modifiers);
      QCoreApplication::sendEvent(window(), &move);
    }
    QTest::mouseRelease(window(), Qt::LeftButton, modifiers, from + QPoint(pixels, 0));
  }

  Document document;
  std::unique_ptr<PropertyRow> row;
};

TEST(PropertyRow, DraggingTheFieldScrubsAsOneStep) {
  RowBench bench("material.exponent");
  bench.drag(bench.fieldCenter(), 60);
  const float exponent = bench.document.recipe().objects[0].material.exponent;
  EXPECT_GT(exponent, 60) << "a logarithmic range moves by factors";
  EXPECT_EQ(bench.document.undoName(), s("Exponent of object"));
  bench.document.undo();
  EXPECT_FALSE(bench.document.canUndo()) << "one drag, one step";
  EXPECT_EQ(bench.number().value(), 32);
}

TEST(PropertyRow, ShiftScrubsFinelyAndCtrlCoarsely) {
  const NumberField field({.low = 0, .high = 240, .decimals = 3, .unit = {}});
  EXPECT_NEAR(field.scrubbed(100, 10, Qt::NoModifier), 110, 1e-6);
  EXPECT_NEAR(field.scrubbed(100, 10, Qt::ShiftModifier), 101, 1e-6);
  EXPECT_NEAR(field.scrubbed(100, 10, Qt::ControlModifier), 200, 1e-6);
  EXPECT_EQ(field.scrubbed(100, 1000, Qt::NoModifier), 240) << "stops at the end of the range";
}

TEST(PropertyRow, DraggingTheLabelScrubsToo) {
  RowBench bench("transfer.bands");
  bench.drag(QPoint(10, bench.row->height() / 2), 80);
  EXPECT_GT(bench.document.recipe().transfer.bands, 5);
}

TEST(PropertyRow, AClickOpensTheEditorWhichTakesArithmetic) {
  RowBench bench("transfer.rays");
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  ASSERT_TRUE(bench.number().editing());
  QTest::keyClicks(bench.row->findChild<QLineEdit*>(), s("2k + 48"));
  QTest::keyClick(bench.row->findChild<QLineEdit*>(), Qt::Key_Return);
  EXPECT_EQ(bench.document.recipe().transfer.rays, 2048);
  EXPECT_FALSE(bench.number().editing());
}

TEST(PropertyRow, NonsenseKeepsTheEditorAndTheValue) {
  RowBench bench("transfer.rays");
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  auto* editor = bench.row->findChild<QLineEdit*>();
  QTest::keyClicks(editor, s("many"));
  QTest::keyClick(editor, Qt::Key_Return);
  EXPECT_TRUE(bench.number().editing());
  EXPECT_TRUE(editor->property("invalid").toBool());
  QTest::keyClick(editor, Qt::Key_Escape);
  EXPECT_FALSE(bench.number().editing());
  EXPECT_EQ(bench.document.recipe().transfer.rays, Recipe{}.transfer.rays);
}

TEST(PropertyRow, ValuesAreKeptInTheRange) {
  RowBench bench("transfer.bands");
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  QTest::keyClicks(bench.row->findChild<QLineEdit*>(), s("50"));
  QTest::keyClick(bench.row->findChild<QLineEdit*>(), Qt::Key_Return);
  EXPECT_EQ(bench.document.recipe().transfer.bands, 10);
}

TEST(PropertyRow, ADoubleClickOrTheResetButtonReturnsToTheDefault) {
  RowBench bench("transfer.bounces");
  const int usual = Recipe{}.transfer.bounces;
  bench.document.set(s("transfer.bounces"), s("9"));
  QTest::mouseDClick(bench.row->findChild<QLabel*>(), Qt::LeftButton);
  EXPECT_EQ(bench.document.recipe().transfer.bounces, usual) << "on the label";
  bench.document.set(s("transfer.bounces"), s("9"));
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  EXPECT_EQ(bench.document.recipe().transfer.bounces, usual) << "on the field";
  bench.document.set(s("transfer.bounces"), s("9"));
  auto* button = bench.row->findChild<QToolButton*>();
  ASSERT_TRUE(button->isVisible());
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(bench.document.recipe().transfer.bounces, usual);
  EXPECT_FALSE(button->isVisible()) << "nothing to reset";
}

TEST(PropertyRow, TheWheelNeedsTheFocus) {
  RowBench bench("transfer.bands");
  bench.row->setFocus();
  const auto turn = [&] {
    const QPointF at = bench.fieldCenter();
    QWheelEvent wheel(at, bench.window()->mapToGlobal(at), QPoint(), QPoint(0, 120), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(bench.window(), &wheel);
  };
  turn();
  EXPECT_EQ(bench.document.recipe().transfer.bands, 5) << "scrolling over a panel changes nothing";
  bench.number().setFocus();
  turn();
  EXPECT_EQ(bench.document.recipe().transfer.bands, 6);
  QTest::keyClick(&bench.number(), Qt::Key_Down);
  EXPECT_EQ(bench.document.recipe().transfer.bands, 5);
}

TEST(PropertyRow, EscapeDuringAScrubTakesItBack) {
  RowBench bench("material.exponent");
  QTest::mousePress(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  const QPointF to = bench.fieldCenter() + QPoint(50, 0);
  QMouseEvent move(QEvent::MouseMove, to, bench.window()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QCoreApplication::sendEvent(bench.window(), &move);
  EXPECT_GT(bench.number().value(), 32);
  QTest::keyClick(&bench.number(), Qt::Key_Escape);
  EXPECT_EQ(bench.number().value(), 32);
  EXPECT_FALSE(bench.document.canUndo());
}

TEST(PropertyRow, ChoicesTogglesAndColoursEditTheRecipe) {
  RowBench model("material.model");
  auto* box = qobject_cast<QComboBox*>(model.row->editor());
  ASSERT_TRUE(box);
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Down);
  EXPECT_EQ(model.document.recipe().objects[0].material.model, MaterialModel::Phong);

  RowBench twoSided("material.twoSided");
  QTest::mouseClick(twoSided.row->editor(), Qt::LeftButton, Qt::NoModifier,
                    QPoint(7, twoSided.row->editor()->height() / 2));
  EXPECT_TRUE(twoSided.document.recipe().objects[0].material.twoSided);

  RowBench albedo("material.albedo");
  auto* field = qobject_cast<ColorField*>(albedo.row->editor());
  ASSERT_TRUE(field);
  QTest::mouseClick(field, Qt::LeftButton);
  auto* picker = field->findChild<ColorPicker*>();
  ASSERT_TRUE(picker && picker->isVisible());
  QTest::mousePress(picker, Qt::LeftButton, Qt::NoModifier, QPoint(150, 20));
  QTest::mouseRelease(picker, Qt::LeftButton, Qt::NoModifier, QPoint(150, 20));
  const Rgb picked = albedo.document.recipe().objects[0].material.albedo;
  EXPECT_NE(picked, Material{}.albedo);
  EXPECT_GT(std::max({picked.x, picked.y, picked.z}), 0.6f) << "the upper right is bright and strong";
  EXPECT_EQ(albedo.document.undoName(), s("Albedo of object"));
}

TEST(PropertyRow, TheTooltipSaysWhatItIsAndWhatAChangeCosts) {
  const QString tip = parameterTip(parameterAt("transfer.bands"));
  for (const char* part : {"Spherical-harmonic", "Range 1 to 10", "Default 5", "Cost", "transfer.bands"})
    EXPECT_TRUE(tip.contains(QLatin1String(part))) << tip.toStdString();
}

// The menu that a right click opens over a row: its entries, and one of them chosen with the keyboard.
class RowMenu {
 public:
  explicit RowMenu(RowBench& bench, const QPoint& at) : bench_(bench), at_(at) {}
  /// Opens the menu and triggers the entry whose text begins so; all entries as they were.
  QStringList choose(const char* beginning) {
    QStringList entries;
    QTimer timer;  // fires while the menu waits
    timer.setSingleShot(true);
    QObject::connect(&timer, &QTimer::timeout, [&] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      ASSERT_TRUE(menu) << "no menu";
      QAction* chosen = nullptr;
      for (QAction* action : menu->actions()) {
        if (!action->text().isEmpty()) entries << action->text();
        if (action->text().startsWith(s(beginning))) chosen = action;
      }
      if (!chosen) {
        ADD_FAILURE() << beginning;
        menu->close();
        return;
      }
      menu->setActiveAction(chosen);
      QTest::keyClick(menu, Qt::Key_Return);
    });
    timer.start(50);
    QContextMenuEvent event(QContextMenuEvent::Mouse, at_, bench_.row->mapToGlobal(at_));
    QApplication::sendEvent(bench_.row->childAt(at_), &event);
    return entries;
  }

 private:
  RowBench& bench_;
  QPoint at_;
};

TEST(PropertyRow, TheRightButtonCopiesPastesResetsAndTellsTheCost) {
  RowBench bench("transfer.rays");
  for (const QPoint& at : {bench.fieldCenter(), QPoint(10, bench.row->height() / 2)}) {
    bench.document.set(s("transfer.rays"), s("777"));
    const QStringList entries = RowMenu(bench, at).choose("Copy");
    EXPECT_EQ(QApplication::clipboard()->text(), s("777"));
    EXPECT_TRUE(entries.contains(s("What does this cost?"))) << entries.join(u'|').toStdString();
    RowMenu(bench, at).choose("Reset");
    EXPECT_EQ(bench.document.recipe().transfer.rays, Recipe{}.transfer.rays);
    RowMenu(bench, at).choose("Paste");
    EXPECT_EQ(bench.document.recipe().transfer.rays, 777);
    QToolTip::hideText();
    RowMenu(bench, at).choose("What does");
    EXPECT_TRUE(waitFor([] { return QToolTip::isVisible(); }, 1000));
    EXPECT_TRUE(QToolTip::text().contains(QString::fromStdString(parameterAt("transfer.rays").cost)));
    QToolTip::hideText();
  }
}

TEST(PropertyRow, PastingNonsenseChangesNothing) {
  RowBench bench("transfer.rays");
  QApplication::clipboard()->setText(s("a poem"));
  RowMenu(bench, bench.fieldCenter()).choose("Paste");
  EXPECT_EQ(bench.document.recipe().transfer.rays, Recipe{}.transfer.rays);
  EXPECT_FALSE(bench.document.canUndo());
  QToolTip::hideText();
}

TEST(PropertyRow, ADoubleClickOrTheRightButtonResetsChoicesAndColoursToo) {
  RowBench model("material.model");
  model.document.set(s("material.model"), s("phong"));
  QTest::mouseDClick(model.row->findChild<QLabel*>(), Qt::LeftButton);
  EXPECT_EQ(model.document.recipe().objects[0].material.model, MaterialModel::Lambert);
  model.document.set(s("material.model"), s("phong"));
  const QStringList entries = RowMenu(model, model.fieldCenter()).choose("Reset");
  EXPECT_EQ(model.document.recipe().objects[0].material.model, MaterialModel::Lambert)
      << entries.join(u'|').toStdString();
}

TEST(PropertyRow, ShiftScrubsFinerWithTheMouse) {
  RowBench plain("material.exponent"), fine("material.exponent");
  plain.drag(plain.fieldCenter(), 60);
  fine.drag(fine.fieldCenter(), 60, Qt::ShiftModifier);
  const auto exponent = [](RowBench& bench) { return bench.document.recipe().objects[0].material.exponent; };
  EXPECT_GT(exponent(fine), 32);
  EXPECT_LT(exponent(fine), exponent(plain));
}

TEST(PropertyRow, UnitsMayBeTyped) {
  RowBench bench("lights[0].rotation");
  QTest::mouseClick(bench.window(), Qt::LeftButton, Qt::NoModifier, bench.fieldCenter());
  QTest::keyClicks(bench.row->findChild<QLineEdit*>(), s("0.25*180 deg"));
  QTest::keyClick(bench.row->findChild<QLineEdit*>(), Qt::Key_Return);
  EXPECT_EQ(bench.document.recipe().lights[0].rotation, 45);
}

TEST(PropertyRow, AnUnknownPathIsRefused) {
  Document document;
  EXPECT_THROW(PropertyRow(document, s("transfer.bends")), ValueError);
}

TEST(ColorField, ScreenColoursRoundTrip) {
  for (const Rgb& c : {Rgb(0), Rgb(0.18f, 0.5f, 0.02f), Rgb(1)})
    EXPECT_LT(length(fromScreen(toScreen(c)) - c), 1e-3f);
}

TEST(Compass, TurnsWithThePointer) {
  Compass compass;
  compass.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&compass));
  QSignalSpy turns(&compass, &Compass::turned);
  const QPoint top(compass.width() / 2, 6), left(6, compass.height() / 2);
  QTest::mousePress(&compass, Qt::LeftButton, Qt::NoModifier, top);
  QMouseEvent move(QEvent::MouseMove, left, compass.mapToGlobal(QPointF(left)), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QCoreApplication::sendEvent(&compass, &move);
  QTest::mouseRelease(&compass, Qt::LeftButton, Qt::NoModifier, left);
  EXPECT_NEAR(compass.angle(), 90, 3) << "from -Z to -X is +90 degrees";
  EXPECT_GE(turns.count(), 1);
}

TEST(WrapDegrees, StaysWithinHalfATurn) {
  EXPECT_EQ(wrapDegrees(0), 0);
  EXPECT_NEAR(wrapDegrees(270), -90, 1e-9);
  EXPECT_NEAR(wrapDegrees(-3600 + 10), 10, 1e-9);
}

using DockTest = test::StudioTest;

TEST_F(DockTest, TheCancelButtonEndsABakeAndBakeGoesOn) {
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;
  open(recipe);
  ASSERT_TRUE(waitFor([&] { return session.bakes().baking() && session.relighter().transfer(); }));
  auto* button = window.findChild<QPushButton*>(s("bakeButton"));
  ASSERT_TRUE(button && button->isVisible());
  EXPECT_EQ(button->text(), s("Cancel"));
  const quint64 job = session.bakes().job();
  QElapsedTimer timer;
  timer.start();
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(waitFor([&] { return session.jobs().find(job)->over(); }));
  RecordProperty("milliseconds", int(timer.elapsed()));
  EXPECT_LT(timer.elapsed(), 1000);
  EXPECT_EQ(button->text(), s("Bake"));
  EXPECT_TRUE(button->isEnabled());
  EXPECT_TRUE(session.relighter().transfer()) << "the best picture so far stays";
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_TRUE(session.bakes().baking());
}

TEST_F(DockTest, EditsInTheDocksReachTheDocumentAndUndoWorksFromTheKeyboard) {
  openAndSettle();
  auto* bands = window.findChild<PropertyRow*>(s("transfer.bands"));
  ASSERT_TRUE(bands);
  bands->apply(s("4"));
  EXPECT_EQ(session.document().recipe().transfer.bands, 4);
  QTest::keyClick(handle(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(session.document().recipe().transfer.bands, 5);
  QTest::keyClick(handle(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(session.document().recipe().transfer.bands, 4);
}

TEST_F(DockTest, TheAngleFieldTurnsTheLight) {
  openAndSettle();
  auto* angle = window.findChild<NumberField*>(s("environmentAngle"));
  ASSERT_TRUE(angle);
  QTest::mouseClick(angle, Qt::LeftButton);
  QTest::keyClicks(angle->findChild<QLineEdit*>(), s("90/2"));
  QTest::keyClick(angle->findChild<QLineEdit*>(), Qt::Key_Return);
  EXPECT_NEAR(session.environmentAngle(), 45, 1e-4);
}

TEST_F(DockTest, ExposureChangesThePictureNotTheDocument) {
  openAndSettle();
  const QImage before = picture();
  auto* exposure = window.findChild<NumberField*>(s("exposure"));
  ASSERT_TRUE(exposure);
  exposure->setFocus();
  for (int i = 0; i < 4; ++i) QTest::keyClick(exposure, Qt::Key_Up);
  EXPECT_NEAR(session.view().tone().exposure, 1, 1e-6);
  EXPECT_GT(test::difference(before, picture()), 0.3);
  EXPECT_FALSE(session.document().modified());
}

}  // namespace
}  // namespace prt::ui
