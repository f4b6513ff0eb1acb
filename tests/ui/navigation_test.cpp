#include "ui/model/navigation.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

constexpr auto kNone = Qt::NoModifier;
constexpr auto kAlt = Qt::AltModifier;

TEST(Navigation, EachPresetHasItsHabits) {
  using P = NavigationPreset;
  EXPECT_EQ(dragAction(P::Blender, Qt::MiddleButton, kNone), DragAction::Orbit);
  EXPECT_EQ(dragAction(P::Blender, Qt::MiddleButton, Qt::ShiftModifier), DragAction::Pan);
  EXPECT_EQ(dragAction(P::Blender, Qt::MiddleButton, Qt::ControlModifier), DragAction::Zoom);
  EXPECT_EQ(dragAction(P::Blender, Qt::LeftButton, kAlt), DragAction::Orbit);
  EXPECT_EQ(dragAction(P::Blender, Qt::RightButton, kAlt), DragAction::None);
  for (const P preset : {P::Maya, P::Substance}) {
    EXPECT_EQ(dragAction(preset, Qt::LeftButton, kAlt), DragAction::Orbit);
    EXPECT_EQ(dragAction(preset, Qt::MiddleButton, kAlt), DragAction::Pan);
    EXPECT_EQ(dragAction(preset, Qt::RightButton, kAlt), DragAction::Zoom);
    EXPECT_EQ(dragAction(preset, Qt::MiddleButton, kNone), DragAction::None);
  }
  EXPECT_EQ(dragAction(P::Substance, Qt::LeftButton, kAlt | Qt::ControlModifier), DragAction::Pan);
}

TEST(Navigation, ShiftTurnsTheLightAndPlainClicksAreFreeInEveryPreset) {
  for (const NavigationPreset preset : navigationPresets()) {
    for (const auto button : {Qt::LeftButton, Qt::RightButton}) {
      EXPECT_EQ(dragAction(preset, button, Qt::ShiftModifier), DragAction::TurnLight);
      EXPECT_EQ(dragAction(preset, button, kNone), DragAction::None);
      EXPECT_EQ(dragAction(preset, button, Qt::ShiftModifier | Qt::KeypadModifier), DragAction::TurnLight);
    }
  }
}

TEST(Navigation, HintsAndKeysSayWhatThePresetDoes) {
  EXPECT_TRUE(navigationHint(NavigationPreset::Blender).contains(QStringLiteral("middle orbits")));
  EXPECT_TRUE(navigationHint(NavigationPreset::Maya).contains(QStringLiteral("Alt+left orbits")));
  EXPECT_FALSE(navigationHint(NavigationPreset::Maya).contains(QStringLiteral("Shift+middle")));
  for (const NavigationPreset preset : navigationPresets()) {
    EXPECT_TRUE(navigationHint(preset).contains(QStringLiteral("turns the light")));
    EXPECT_GE(navigationKeys(preset).size(), 5);
    EXPECT_EQ(navigationPreset(nameOf(preset)), preset);
  }
  EXPECT_EQ(navigationPreset(QStringLiteral("nobody's")), NavigationPreset::Blender);
}

TEST(Navigation, WheelsZoomAndFingersOrbitPanAndPinch) {
  EXPECT_EQ(wheelMove(false, 0, 240, kNone).zoomSteps, 2);
  EXPECT_EQ(wheelMove(false, 120, 0, kAlt).zoomSteps, 1) << "Alt turns wheels sideways";
  EXPECT_EQ(wheelMove(false, 0, 120, Qt::ShiftModifier).panY, 0);
  const WheelMove orbit = wheelMove(true, 10, -20, kNone);
  EXPECT_EQ(orbit.orbitX, 10);
  EXPECT_EQ(orbit.orbitY, -20);
  EXPECT_EQ(orbit.zoomSteps, 0);
  EXPECT_EQ(wheelMove(true, 10, -20, Qt::ShiftModifier).panX, 10);
  EXPECT_GT(wheelMove(true, 0, 30, Qt::ControlModifier).zoomSteps, 0);
}

}  // namespace
}  // namespace prt::ui
