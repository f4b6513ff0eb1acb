// 'Where is this bake wrong?', driven by keys and the dock.

#include "tests/ui/studio_fixture.h"
#include "ui/docks/error_section.h"
#include "ui/model/error_estimate.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::s;
using test::smallScene;
using test::waitFor;

class ErrorOverlayTest : public test::StudioTest {
 protected:
  ErrorEstimate& errors() { return session.errors(); }
  template <class Widget>
  Widget& child(const char* name) {
    return *window.findChild<ErrorSection*>()->findChild<Widget*>(s(name));
  }
  void pressE() { QTest::keyClick(handle(), Qt::Key_E); }
  bool measured() {
    return waitFor([this] { return errors().complete() && !errors().measuring(); });
  }
};

TEST_F(ErrorOverlayTest, ESteppsThroughTheErrors) {
  openAndSettle();
  const QImage plain = picture();
  pressE();
  EXPECT_EQ(errors().shown(), ErrorShown::Total);
  ASSERT_TRUE(measured());
  const QImage total = picture();
  EXPECT_GT(difference(plain, total), 0.02);
  std::vector<QImage> seen{total};
  for (const ErrorShown next : {ErrorShown::MonteCarlo, ErrorShown::Interpolation, ErrorShown::Truncation}) {
    pressE();
    EXPECT_EQ(errors().shown(), next);
    seen.push_back(picture());
    EXPECT_GT(difference(seen[seen.size() - 2], seen.back()), 0.005) << int(next);
  }
  pressE();
  EXPECT_EQ(errors().shown(), ErrorShown::Off);
  EXPECT_LT(difference(plain, picture()), 0.01) << "and back to the picture";
  EXPECT_FALSE(session.document().canUndo()) << "looking is no edit";
}

TEST_F(ErrorOverlayTest, TheNumbersStandInTheDock) {
  openAndSettle();
  QTest::mouseClick(&child<QPushButton>("measureErrors"), Qt::LeftButton);
  EXPECT_TRUE(errors().measuring());
  ASSERT_TRUE(measured());
  const QString total = child<QLabel>("errorTotal").text();
  EXPECT_EQ(total, percentText(errors().map()->totalRms()));
  EXPECT_GT(errors().map()->totalRms(), 1e-4);
  EXPECT_EQ(errors().shown(), ErrorShown::Off) << "measuring alone changes no picture";
  ASSERT_TRUE(session.status().estimatedError);
  EXPECT_EQ(*session.status().estimatedError, errors().map()->totalRms());
}

TEST_F(ErrorOverlayTest, TurningTheLightJudgesAnew) {
  openAndSettle();
  pressE();
  ASSERT_TRUE(measured());
  const std::vector<Vec3> before = errors().map()->vertices;
  session.setEnvironmentAngle(120);
  EXPECT_EQ(errors().map()->vertices, before) << "judged on the interface's thread";
  ASSERT_TRUE(waitFor([&] { return errors().upToDate(); }));
  EXPECT_NE(errors().map()->vertices, before);
  EXPECT_FALSE(errors().measuring()) << "nothing is traced again";
  // Many moves, and what is shown at last is of the last one.
  for (int degrees = 0; degrees < 90; degrees += 5) session.setEnvironmentAngle(degrees), pass(3);
  ASSERT_TRUE(waitFor([&] { return errors().upToDate(); }));
  const std::vector<Vec3> turned = errors().map()->vertices;
  session.setEnvironmentAngle(120);
  ASSERT_TRUE(waitFor([&] { return errors().upToDate(); }));
  EXPECT_NE(errors().map()->vertices, turned);
  session.setEnvironmentAngle(85);
  ASSERT_TRUE(waitFor([&] { return errors().upToDate(); }));
  EXPECT_EQ(errors().map()->vertices, turned);
  errors().setByPrior(true);
  ASSERT_TRUE(waitFor([&] { return errors().upToDate(); }));
  const std::vector<Vec3> prior = errors().map()->vertices;
  session.setEnvironmentAngle(10);
  pass(150);
  EXPECT_EQ(errors().map()->vertices, prior) << "all light that may come does not turn";
}

TEST_F(ErrorOverlayTest, AnEditForgetsAndMeasuresAgain) {
  openAndSettle();
  pressE();
  ASSERT_TRUE(measured());
  const double noise = errors().map()->rms.x;
  session.document().set(s("transfer.rays"), s("4096"));
  EXPECT_TRUE(waitFor([this] { return !errors().map(); })) << "numbers of another bake are not shown";
  EXPECT_TRUE(session.layers().values().empty());
  ASSERT_TRUE(measured()) << "while the overlay is on, it follows the bake";
  EXPECT_LT(errors().map()->rms.x, 0.5 * noise);
}

TEST_F(ErrorOverlayTest, CancellingTurnsItOff) {
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.detail = 1;
  openAndSettle(recipe);
  pressE();
  ASSERT_TRUE(errors().measuring());
  QTest::mouseClick(&child<QPushButton>("measureErrors"), Qt::LeftButton);
  ASSERT_TRUE(waitFor([this] { return !errors().measuring(); }, 5000));
  pass(100);
  EXPECT_FALSE(errors().measuring()) << "it does not begin again by itself";
  if (!errors().map()) {
    EXPECT_EQ(errors().shown(), ErrorShown::Off);
  }
}

TEST_F(ErrorOverlayTest, TheSuggestionIsOneClickAndOneStep) {
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1024;
  recipe.transfer.bands = 9;
  recipe.lights = {
      {.name = "sky", .kind = LightKind::Constant, .radiance = Rgb(1)}};  // what is left: a coarse mesh
  openAndSettle(recipe);
  errors().measure();
  ASSERT_TRUE(measured());
  ASSERT_TRUE(errors().suggestion());
  auto& apply = child<QPushButton>("applySuggestion");
  ASSERT_TRUE(apply.isVisible());
  EXPECT_EQ(apply.text(), s("A finer mesh"));
  QTest::mouseClick(&apply, Qt::LeftButton);
  EXPECT_FLOAT_EQ(session.document().recipe().objects[0].mesh.detail, 0.375f);
  EXPECT_EQ(session.document().undoName(), s("Finer mesh"));
  session.document().undo();
  EXPECT_FALSE(session.document().canUndo());
}

TEST(ErrorScale, EndsAtRoundNumbers) {
  EXPECT_DOUBLE_EQ(roundScale(0.013), 0.02);
  EXPECT_DOUBLE_EQ(roundScale(0.02), 0.02);
  EXPECT_DOUBLE_EQ(roundScale(0.0201), 0.05);
  EXPECT_DOUBLE_EQ(roundScale(0.7), 1);
  EXPECT_EQ(percentText(0.0123), s("1.23 %"));
  EXPECT_EQ(percentText(0.123), s("12.3 %"));
}

}  // namespace
}  // namespace prt::ui
