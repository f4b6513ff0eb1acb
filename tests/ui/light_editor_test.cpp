#include "ui/model/light_editor.h"

#include "libprt/light/light_rig.h"
#include "libprt/light/sky_angles.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

class LightEditorTest : public testing::Test {
 protected:
  LightEditorTest() { document.open(Recipe{}, {}); }
  const LightRecipe& light(int i) const { return document.recipe().lights[std::size_t(i)]; }

  Document document;
  LightEditor lights{document};
};

TEST_F(LightEditorTest, AddsACircleWhereItIsAskedAndSelectsIt) {
  const Vec3 direction = normalize(Vec3(1, 2, -0.5f));
  const int added = lights.addCircle(direction);
  EXPECT_EQ(added, 1);
  EXPECT_EQ(lights.selected(), 1);
  EXPECT_EQ(light(1).kind, LightKind::Circle);
  EXPECT_EQ(light(1).direction, direction);
  EXPECT_EQ(light(1).angle, LightEditor::kNewAngle);
  EXPECT_EQ(document.undoName(), QStringLiteral("Add circle light"));
  lights.addCircle(direction);
  EXPECT_EQ(light(1).name, "circle");
  EXPECT_EQ(light(2).name, "circle 2");
  document.undo();
  document.undo();
  EXPECT_EQ(lights.count(), 1);
  EXPECT_EQ(lights.selected(), 0) << "the one that was selected is gone";
}

TEST_F(LightEditorTest, ADragIsOneNamedStep) {
  const int circle = lights.addCircle({0, 1, 0});
  lights.beginDrag(QStringLiteral("Move circle"));
  for (int i = 1; i <= 5; ++i) lights.aim(circle, normalize(Vec3(0.1f * float(i), 1, 0)));
  lights.endDrag();
  EXPECT_EQ(document.undoName(), QStringLiteral("Move circle"));
  EXPECT_LT(length(light(circle).direction - normalize(Vec3(0.5f, 1, 0))), 1e-6f);
  document.undo();
  EXPECT_EQ(light(circle).direction, Vec3(0, 1, 0));
  EXPECT_EQ(document.undoName(), QStringLiteral("Add circle light"));
}

TEST_F(LightEditorTest, ACancelledDragLeavesNothing) {
  const int circle = lights.addCircle({0, 1, 0});
  const Recipe before = document.recipe();
  lights.beginDrag(QStringLiteral("Move circle"));
  lights.aim(circle, {1, 0, 0});
  lights.cancelDrag();
  EXPECT_EQ(document.recipe(), before);
  EXPECT_EQ(document.undoName(), QStringLiteral("Add circle light"));
  EXPECT_FALSE(document.inGesture());
  lights.endDrag();  // the button comes up later
  EXPECT_EQ(document.undoName(), QStringLiteral("Add circle light"));
}

TEST_F(LightEditorTest, EveryEditSaysWhatItDid) {
  const int circle = lights.addCircle({0, 1, 0});
  lights.resize(circle, 50);
  EXPECT_EQ(document.undoName(), QStringLiteral("Resize circle"));
  EXPECT_EQ(light(circle).angle, 50);
  lights.setColor(circle, {5, 4, 3});
  EXPECT_EQ(document.undoName(), QStringLiteral("Colour of circle"));
  EXPECT_EQ(light(circle).radiance, Rgb(5, 4, 3));
  lights.setIntensity(circle, 2.5);
  EXPECT_EQ(document.undoName(), QStringLiteral("Intensity of circle"));
  EXPECT_EQ(light(circle).intensity, 2.5f);
  lights.setOn(circle, false);
  EXPECT_EQ(document.undoName(), QStringLiteral("Mute circle"));
  EXPECT_FALSE(light(circle).on);
  lights.setOn(circle, true);
  EXPECT_EQ(document.undoName(), QStringLiteral("Switch circle on"));
  lights.rename(circle, QStringLiteral(" key "));
  EXPECT_EQ(light(circle).name, "key");
  lights.rename(circle, QStringLiteral("  "));
  EXPECT_EQ(light(circle).name, "key") << "a light keeps a name";
  lights.remove(circle);
  EXPECT_EQ(document.undoName(), QStringLiteral("Delete key"));
  EXPECT_EQ(lights.selected(), -1);
}

TEST_F(LightEditorTest, ValuesStayWithinWhatARecipeMayHold) {
  const int circle = lights.addCircle({0, 1, 0});
  lights.resize(circle, 500);
  EXPECT_EQ(light(circle).angle, 360);
  lights.resize(circle, -1);
  EXPECT_EQ(light(circle).angle, 0.01f);
  lights.setColor(circle, Rgb(-1, 2, 0));
  EXPECT_EQ(light(circle).radiance, Rgb(0, 2, 0));
  lights.aim(circle, Vec3(0));
  lights.aim(circle, Vec3(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(light(circle).direction, Vec3(0, 1, 0));
  lights.aim(7, {1, 0, 0});
  lights.remove(-1);
  EXPECT_EQ(lights.count(), 2);
}

TEST_F(LightEditorTest, ACopyStandsBesideItsOriginal) {
  const int circle = lights.addCircle(normalize(Vec3(0, 1, -1)));
  lights.setColor(circle, {3, 2, 1});
  const int copy = lights.duplicate(circle);
  EXPECT_EQ(copy, circle + 1);
  EXPECT_EQ(lights.selected(), copy);
  EXPECT_EQ(light(copy).name, "circle 2");
  EXPECT_EQ(light(copy).radiance, Rgb(3, 2, 1));
  EXPECT_NEAR(light(copy).direction.y, light(circle).direction.y, 1e-6f);
  EXPECT_LT(dot(light(copy).direction, light(circle).direction), 0.97f);
}

TEST_F(LightEditorTest, LightsStayInTheWorldWhileTheEnvironmentTurns) {
  const int circle = lights.addCircle({0, 0, -1});
  document.set(QStringLiteral("lights[0].rotation"), QStringLiteral("90"));
  const auto marks = lights.marks();
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_TRUE(marks[0].sun);
  EXPECT_EQ(marks[1].light, circle);
  EXPECT_LT(length(marks[1].direction - Vec3(0, 0, -1)), 1e-6f);
  // A light with a rotation of its own is aimed where the pointer is all the same.
  document.set(QStringLiteral("lights[1].rotation"), QStringLiteral("30"));
  lights.aim(circle, {1, 0, 0});
  EXPECT_LT(length(lights.marks()[1].direction - Vec3(1, 0, 0)), 1e-6f);
}

TEST_F(LightEditorTest, TheSunIsDraggedInTheWorldAndTurnsWithItsSky) {
  document.set(QStringLiteral("lights[0].rotation"), QStringLiteral("40"));
  const Vec3 wanted = directionOf(SkyAngles{radians(100.0), radians(25.0)});
  lights.aim(0, wanted);
  EXPECT_EQ(document.undoName(), QStringLiteral("Move sun"));
  EXPECT_NEAR(light(0).sunAzimuth, 60, 1e-3) << "in the sky's own frame";
  EXPECT_NEAR(light(0).sunElevation, 25, 1e-3);
  EXPECT_LT(length(lights.marks()[0].direction - wanted), 1e-5f);
  lights.aim(0, {0, -1, 0});
  EXPECT_EQ(light(0).sunElevation, 1) << "it does not set";
  document.set(QStringLiteral("lights[0].path"), QStringLiteral("builtin:overcast"));
  EXPECT_TRUE(lights.marks().empty()) << "no sun to drag";
}

TEST_F(LightEditorTest, OneEnvironmentLightsAtATime) {
  const int other = lights.duplicate(0);
  EXPECT_FALSE(light(other).on);
  EXPECT_EQ(lights.environment(), 0);
  lights.setOn(other, true);
  EXPECT_FALSE(light(0).on);
  EXPECT_EQ(lights.environment(), other);
  lights.setEnvironment(QStringLiteral("builtin:studio"));
  EXPECT_EQ(light(other).path, "builtin:studio");
  EXPECT_EQ(light(0).path, "builtin:clear-sky");
  lights.remove(0);
  lights.remove(0);
  EXPECT_EQ(lights.environment(), -1);
  lights.setEnvironment(QStringLiteral("builtin:overcast"));
  ASSERT_EQ(lights.count(), 1);
  EXPECT_EQ(light(0).path, "builtin:overcast");
}

TEST_F(LightEditorTest, TheSelectionFollowsTheList) {
  const int a = lights.addCircle({0, 1, 0}), b = lights.addCircle({1, 0, 0});
  EXPECT_EQ(lights.selected(), b);
  lights.remove(a);
  EXPECT_EQ(lights.selected(), a) << "the same light, one place up";
  lights.select(99);
  EXPECT_EQ(lights.selected(), -1);
  lights.select(a);
  document.open(Recipe{}, {});
  EXPECT_EQ(lights.selected(), -1);
}

}  // namespace
}  // namespace prt::ui
