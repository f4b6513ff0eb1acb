#include "ui/model/view_state.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

float distance(const Camera& c) {
  return length(c.eye - c.target);
}

// Where a point appears: from the middle of the view, in heights, y upwards.
Vec2 place(const Camera& camera, const Vec3& point) {
  const Frame axes = camera.axes();
  const Vec3 d = point - camera.eye;
  const float depth = -dot(d, axes.normal), height = 2 * std::tan(0.5f * camera.verticalFov);
  return Vec2(dot(d, axes.tangent), dot(d, axes.bitangent)) / (depth * height);
}

TEST(ViewState, OrbitTurnsAboutTheTarget) {
  ViewState view;
  const Camera before = view.camera();
  view.orbit(0.25f, 0.1f);
  const Camera& after = view.camera();
  EXPECT_NEAR(distance(after), distance(before), 1e-4);
  EXPECT_EQ(after.target, before.target);
  EXPECT_GT(length(after.eye - before.eye), 0.5f);
  EXPECT_GT(after.eye.y, 0) << "dragging down shows the top";
  EXPECT_LT(after.eye.x, 0) << "dragging right brings the left side to the front";
}

TEST(ViewState, OrbitStopsShortOfThePolesAndStaysFinite) {
  ViewState view;
  for (int i = 0; i < 40; ++i) view.orbit(0.01f, 0.3f);  // downwards: over the top
  EXPECT_TRUE(isFinite(view.camera().eye));
  EXPECT_GT(view.camera().eye.y, 0.99f * distance(view.camera()));
  for (int i = 0; i < 80; ++i) view.orbit(0.01f, -0.3f);
  EXPECT_LT(view.camera().eye.y, -0.99f * distance(view.camera()));
  EXPECT_NEAR(distance(view.camera()), 3, 1e-3);
}

TEST(ViewState, PanMovesTheTargetWithThePointer) {
  ViewState view;
  const Vec3 point = view.camera().target;
  view.pan(0.2f, -0.1f);  // pointer: right and up (y grows downwards)
  const Vec2 now = place(view.camera(), point);
  EXPECT_NEAR(now.x, 0.2f, 1e-5);
  EXPECT_NEAR(now.y, 0.1f, 1e-5);
}

TEST(ViewState, ZoomKeepsWhatIsUnderThePointer) {
  ViewState view;
  const Frame axes = view.camera().axes();
  const Vec3 point = view.camera().target + 0.4f * axes.tangent - 0.3f * axes.bitangent;
  const Vec2 at = place(view.camera(), point);
  const float before = distance(view.camera());
  view.zoom(3, at.x, at.y);
  EXPECT_LT(distance(view.camera()), before);
  EXPECT_NEAR(length(place(view.camera(), point) - at), 0, 1e-5);
  view.zoom(-3, at.x, at.y);
  EXPECT_NEAR(distance(view.camera()), before, 1e-4);
}

TEST(ViewState, FrameShowsTheWholeBoxFromTheSameSide) {
  ViewState view;
  view.orbit(0.3f, 0.2f);
  const Vec3 direction = view.camera().axes().normal;
  Box3 box;
  box.extend(Vec3(10, 20, 30));
  box.extend(Vec3(14, 21, 33));
  view.frame(box);
  EXPECT_NEAR(length(view.camera().axes().normal - direction), 0, 1e-5);
  float largest = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? 10 : 14, i & 2 ? 20 : 21, i & 4 ? 30 : 33);
    const Vec2 at = place(view.camera(), corner);
    largest = std::max({largest, std::abs(at.x), std::abs(at.y)});
  }
  EXPECT_LT(largest, 0.5f);
  EXPECT_GT(largest, 0.25f);
  const Camera framed = view.camera();
  view.frame(Box3{});
  EXPECT_EQ(view.camera(), framed) << "nothing to frame";
}

TEST(ViewState, ResetReturnsHome) {
  ViewState view;
  Camera home;
  home.eye = Vec3(1, 2, 3);
  view.setHome(home);
  view.orbit(0.3f, 0.3f);
  view.reset();
  EXPECT_EQ(view.camera(), home);
}

TEST(ViewState, SaysWhenItChangesAndOnlyThen) {
  ViewState view;
  int changes = 0;
  QObject::connect(&view, &ViewState::changed, [&] { ++changes; });
  view.setTone({.exposure = 1, .curve = ToneCurve::Linear});
  view.setTone({.exposure = 1, .curve = ToneCurve::Linear});
  view.setBackground(BackgroundMode::Plain);
  view.setBackground(BackgroundMode::Plain);
  EXPECT_EQ(changes, 2);
}

TEST(ViewState, ParallelRaysKeepTheSizeAtTheTargetAndZoomAndPanLikeAPinhole) {
  ViewState view;
  const Frame axes = view.camera().axes();
  const Vec3 point = view.camera().target + 0.3f * axes.tangent - 0.2f * axes.bitangent;
  const Vec2 before = view.camera().project(point, 100, 100).value();
  view.setOrthographic(true);
  EXPECT_NEAR(length(view.camera().project(point, 100, 100).value() - before), 0, 1e-3);
  view.zoom(2, (before.x - 50) / 100, (50 - before.y) / 100);
  EXPECT_NEAR(length(view.camera().project(point, 100, 100).value() - before), 0, 1e-3)
      << "what is under the pointer stays";
  EXPECT_LT(view.camera().viewHeight(), 0.8f * 2 * 3 * std::tan(0.2617994f));
  view.pan(0.1f, 0);
  EXPECT_NEAR(view.camera().project(point, 100, 100)->x, before.x + 10, 1e-2);
  view.reset();
  EXPECT_FALSE(view.camera().orthographic);
}

TEST(ViewState, LooksFromASideAndFromTheTop) {
  ViewState view;
  view.orbit(0.2f, 0.1f);
  const float away = distance(view.camera());
  const Vec3 target = view.camera().target;
  view.lookFrom(Vec3(2, 0, 0));
  EXPECT_NEAR(length(view.camera().eye - target - Vec3(away, 0, 0)), 0, 1e-4);
  EXPECT_NEAR(view.camera().axes().bitangent.y, 1, 1e-5);
  view.lookFrom(Vec3(0, 1, 0));
  EXPECT_NEAR(view.camera().axes().normal.y, 1, 1e-5);
  EXPECT_NEAR(view.camera().axes().tangent.x, 1, 1e-5) << "+x stays to the right";
  view.orbit(0, -0.1f);
  EXPECT_TRUE(isFinite(view.camera().eye));
  EXPECT_LT(view.camera().eye.y - target.y, away);
}

TEST(ViewState, SaysWhenSomethingChangedAndOnlyThen) {
  ViewState view;
  int changes = 0;
  QObject::connect(&view, &ViewState::changed, [&] { ++changes; });
  view.setBackground(BackgroundMode::Blurred);
  view.setGrid(true);
  view.setCompass(false);
  view.setNavigation(NavigationPreset::Maya);
  EXPECT_EQ(changes, 4);
  view.setGrid(true);
  view.setNavigation(NavigationPreset::Maya);
  EXPECT_EQ(changes, 4);
}

}  // namespace
}  // namespace prt::ui
