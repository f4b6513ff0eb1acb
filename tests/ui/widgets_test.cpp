// Fields and rows, driven by mouse and keys.

#include "tests/ui/studio_fixture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/compass.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include "libprt/core/error.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QToolButton>

namespace prt::ui {
namespace {

using test::pass;
using test::smallScene;
using test::waitFor;

QString s(const char* text) { return QString::fromUtf8(text); }

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
      QMouseEvent move(QEvent::MouseMove, to, window()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, modifiers);
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
  EXPECT_EQ(bench.document.undoName(), s("Exponent"));
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
    QWheelEvent wheel(at, bench.window()->mapToGlobal(at), QPoint(), QPoint(0, 120), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
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
  QMouseEvent move(QEvent::MouseMove, to, bench.window()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
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
  QTest::mouseClick(twoSided.row->editor(), Qt::LeftButton, Qt::NoModifier, QPoint(7, twoSided.row->editor()->height() / 2));
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
  EXPECT_EQ(albedo.document.undoName(), s("Albedo"));
}

TEST(PropertyRow, TheTooltipSaysWhatItIsAndWhatAChangeCosts) {
  const QString tip = parameterTip(parameterAt("transfer.bands"));
  for (const char* part : {"Spherical-harmonic", "Range 1 to 10", "Default 5", "Cost", "transfer.bands"})
    EXPECT_TRUE(tip.contains(QLatin1String(part))) << tip.toStdString();
}

TEST(PropertyRow, AnUnknownPathIsRefused) {
  Document document;
  EXPECT_THROW(PropertyRow(document, s("transfer.bends")), ValueError);
}

TEST(ColorField, ScreenColoursRoundTrip) {
  for (const Rgb& c : {Rgb(0), Rgb(0.18f, 0.5f, 0.02f), Rgb(1)})
    EXPECT_LT(length(fromScreen(toScreen(c)) - c), 1e-3f);
}

TEST(Theme, TextIsLegibleOnEverySurface) {
  const auto luminanceOf = [](const QColor& c) { return double(luminance(fromScreen(c))); };
  const auto contrast = [&](const QColor& a, const QColor& b) {
    const double x = luminanceOf(a), y = luminanceOf(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
  };
  const Theme& t = darkTheme();
  for (const QColor& surface : {t.window, t.panel, t.field})
    for (const QColor& text : {t.text, t.muted, t.accent, t.done, t.stale, t.failed})
      EXPECT_GE(contrast(text, surface), 4.5) << text.name().toStdString() << " on " << surface.name().toStdString();
  EXPECT_GE(contrast(t.onAccent, t.accent), 4.5);
}

TEST(Theme, EveryIconIsThere) {
  for (const char* name : {"document-open", "edit-undo", "edit-reset", "process-stop", "run-build", "data-error", "zoom-fit-best"}) {
    const QImage image = icon(s(name)).pixmap(16, 16).toImage();
    bool drawn = false;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) drawn = drawn || qAlpha(image.pixel(x, y)) > 128;
    EXPECT_TRUE(drawn) << name;
  }
}

TEST(Compass, TurnsWithThePointer) {
  Compass compass;
  compass.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&compass));
  QSignalSpy turns(&compass, &Compass::turned);
  const QPoint top(compass.width() / 2, 6), left(6, compass.height() / 2);
  QTest::mousePress(&compass, Qt::LeftButton, Qt::NoModifier, top);
  QMouseEvent move(QEvent::MouseMove, left, compass.mapToGlobal(QPointF(left)), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
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
