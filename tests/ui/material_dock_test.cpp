// The material dock, driven by mouse and keys.

#include "ui/docks/material_dock.h"
#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/widgets/lobe_plot.h"
#include "ui/widgets/parameter_slider.h"
#include "ui/widgets/preset_grid.h"
#include "ui/widgets/property_row.h"

#include <QDockWidget>
#include <QFrame>
#include <QPushButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class MaterialDockTest : public test::StudioTest {
 protected:
  MaterialDockTest() {  // as high as it needs to be
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->objectName() != s("material")) dock->hide();
  }
  void openGlossy() {
    Recipe recipe = test::smallScene();
    recipe.objects[0].material.model = MaterialModel::Phong;
    recipe.objects[0].material.albedo = Rgb(0.2f);
    recipe.objects[0].material.specular = Rgb(0.5f);
    recipe.transfer.bounces = 1;
    openAndSettle(recipe);
    pass(20);
  }
  const Material& material() { return session.document().recipe().objects[0].material; }
  ParameterSlider* slider() { return window.findChild<ParameterSlider*>(); }
  LobePlot* plot() { return window.findChild<LobePlot*>(); }
  PresetGrid* presets() { return window.findChild<PresetGrid*>(s("presetGrid")); }
  QFrame* warning() { return window.findChild<QFrame*>(s("energyWarning")); }
  int preset(const char* name) {
    for (std::size_t i = 0; i < materialPresets().size(); ++i)
      if (materialPresets()[i].name == s(name)) return int(i);
    return -1;
  }
};

TEST_F(MaterialDockTest, TheExponentSlidesLogarithmicallyLiveAndAsOneStep) {
  openGlossy();
  ASSERT_TRUE(slider() && slider()->logarithmic());
  const auto decade = slider()->placeOf(100) - slider()->placeOf(10);
  EXPECT_NEAR(slider()->placeOf(10000) - slider()->placeOf(1000), decade, 1e-6)
      << "each decade gets the same room";
  const QImage before = picture();
  Pointer hand(slider());
  hand.press({slider()->placeOf(32), 8});
  hand.move({slider()->placeOf(200), 8});
  EXPECT_NEAR(material().exponent, 200, 8);
  EXPECT_NEAR(session.relighter().materials()[0].exponent, material().exponent, 1e-3)
      << "the next frame shows it";
  EXPECT_FALSE(session.bakes().baking());
  hand.move({slider()->placeOf(1), 8});
  hand.release({slider()->placeOf(1), 8});
  EXPECT_EQ(material().exponent, 1);
  EXPECT_TRUE(session.bakes().fresh()) << "an exponent bakes nothing";
  EXPECT_GT(difference(before, picture()), 0.005);
  EXPECT_EQ(session.document().undoName(), s("Exponent of vase"));
  session.document().undo();
  EXPECT_EQ(material().exponent, 32);
  EXPECT_FALSE(session.document().canUndo());
}

TEST_F(MaterialDockTest, TheSliderReachesBothEndsAndTakesKeys) {
  openGlossy();
  Pointer hand(slider());
  hand.drag({slider()->placeOf(32), 8}, {double(slider()->width()) + 50, 8});
  EXPECT_EQ(material().exponent, 10000);
  hand.drag({slider()->placeOf(10000), 8}, {-50, 8});
  EXPECT_EQ(material().exponent, 1);
  slider()->setFocus();
  for (int i = 0; i < 50; ++i) QTest::keyClick(slider(), Qt::Key_Right);
  EXPECT_NEAR(material().exponent, 100, 2) << "half the steps, half the decades";
}

TEST_F(MaterialDockTest, APresetIsAClickAndBakesWhatItMust) {
  openGlossy();
  ASSERT_GE(presets()->cell(0).width(), 24);
  Pointer(presets()).click(presets()->cell(preset("Lacquer")).center());
  EXPECT_EQ(material().exponent, 2000);
  EXPECT_EQ(session.document().undoName(), s("Preset Lacquer"));
  EXPECT_EQ(presets()->current(), preset("Lacquer"));
  EXPECT_FALSE(session.bakes().fresh()) << "another albedo changes the bounces, and the dock says so";
  ASSERT_TRUE(waitFor([&] { return session.bakes().fresh(); }));
  session.document().set(s("material.exponent"), s("1990"));
  EXPECT_EQ(presets()->current(), -1) << "no longer the preset";
}

TEST_F(MaterialDockTest, TooMuchReflectionIsToldAndFixedWithOneClick) {
  openGlossy();
  EXPECT_FALSE(warning()->isVisible());
  window.findChild<PropertyRow*>(s("objects[0].material.albedo"))->apply(s("0.8"));
  EXPECT_TRUE(warning()->isVisible());
  QTest::mouseClick(window.findChild<QPushButton*>(s("keepEnergy")), Qt::LeftButton);
  EXPECT_FALSE(warning()->isVisible());
  EXPECT_NEAR(material().albedo.x, 0.8 / 1.3, 1e-4);
  EXPECT_EQ(session.document().undoName(), s("Keep energy"));
  session.document().undo();
  EXPECT_TRUE(warning()->isVisible());
}

TEST_F(MaterialDockTest, ThePlotFollowsTheMaterialAndItsLightIsDragged) {
  openGlossy();
  const double before = plot()->lobe().highest;
  session.document().set(s("material.exponent"), s("400"));
  EXPECT_GT(plot()->lobe().highest, 5 * before);
  const QPointF foot(0.5 * plot()->width(), plot()->height() - 8.0);
  Pointer(plot()).drag(foot + QPointF(0, -40), foot + QPointF(-40, -40));
  EXPECT_NEAR(plot()->incidence(), 45, 1.5);
  EXPECT_FALSE(session.document().undoName().contains(s("ncidence"))) << "looking is no edit";
  const QImage linear = plot()->grab().toImage();
  Pointer(plot()).click(plot()->scaleButton().center());
  EXPECT_TRUE(plot()->logarithmic());
  EXPECT_NE(plot()->grab().toImage(), linear);
  EXPECT_TRUE(plot()->accessibleDescription().contains(s("45")))
      << "the tooltip tells the albedo at that angle";
}

TEST_F(MaterialDockTest, ALambertSurfaceHasNoRowsOfALobe) {
  openAndSettle();
  auto* exponent = window.findChild<PropertyRow*>(s("objects[0].material.exponent"));
  EXPECT_FALSE(exponent->isVisible());
  window.findChild<PropertyRow*>(s("objects[0].material.model"))->apply(s("phong"));
  EXPECT_TRUE(exponent->isVisible());
  EXPECT_TRUE(slider()->isVisible());
}

TEST_F(MaterialDockTest, ShowsTheSelectedObject) {
  Recipe recipe = test::smallScene();
  recipe.objects.push_back(recipe.objects[0]);
  recipe.objects[1].name = "second";
  recipe.objects[1].transform.translate = Vec3(2, 0, 0);
  openAndSettle(recipe);
  session.selectObject(1);
  EXPECT_TRUE(window.findChild<PropertyRow*>(s("objects[1].material.albedo")));
  EXPECT_FALSE(window.findChild<PropertyRow*>(s("objects[0].material.albedo")));
  Pointer(presets()).click(presets()->cell(preset("Clay")).center());
  EXPECT_EQ(session.document().recipe().objects[1].material.albedo,
            materialPresets()[std::size_t(preset("Clay"))].material.albedo);
  EXPECT_NE(session.document().recipe().objects[0].material.albedo,
            session.document().recipe().objects[1].material.albedo);
}

}  // namespace
}  // namespace prt::ui
