// Lights as handles around the model, worked with the mouse.

#include "ui/viewport/light_handles.h"
#include "libprt/light/sky_angles.h"
#include "libprt/project/lights.h"
#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"

#include <QAction>
#include <QScreen>

namespace prt::ui {
namespace {

using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

TEST(PointOnSphere, IsWhereTheSightMeetsIt) {
  const HandleSphere sphere{{1, 2, 3}, 2};
  const Vec3 eye(1, 2, 13);
  const auto toward = [&](const Vec3& point) { return Sight{eye, normalize(point - eye)}; };
  for (const Vec3& d : {Vec3(0, 0, 1), normalize(Vec3(0.4f, -0.3f, 1)), normalize(Vec3(-1, 0.2f, 0.6f))})
    EXPECT_LT(length(pointOnSphere(sphere, toward(sphere.center + 2.0f * d), true) - d), 1e-4f);
  const Vec3 behind = normalize(Vec3(0.3f, 0.1f, -1));
  EXPECT_LT(length(pointOnSphere(sphere, toward(sphere.center + 2.0f * behind), false) - behind), 1e-4f);
}

TEST(PointOnSphere, GoesOnOverTheEdgeWithoutAJump) {
  const HandleSphere sphere{{0, 0, 0}, 1};
  Vec3 last = pointOnSphere(sphere, {{0, 0, 9}, {0, 0, -1}}, true);
  EXPECT_LT(length(last - Vec3(0, 0, 1)), 1e-5f);
  for (float x = 0; x <= 2; x += 0.002f) {  // parallel sights, ever farther out
    const Vec3 d = pointOnSphere(sphere, {{x, 0, 9}, {0, 0, -1}}, true);
    EXPECT_NEAR(length(d), 1, 1e-5f);
    EXPECT_LT(length(d - last), 0.07f) << x;
    last = d;
  }
  EXPECT_LT(length(last - Vec3(0, 0, -1)), 0.07f) << "at twice the radius it is straight behind";
}

class LightHandlesTest : public test::StudioTest {
 protected:
  void openWithCircle(const Vec3& towardsCamera) {
    Recipe recipe = test::smallScene();
    recipe.lights[0].path = "builtin:overcast";
    openAndSettle(recipe);
    ASSERT_TRUE(waitFor([this] { return session.rays().ready() && session.jobs().idle(); }));
    const Frame axes = session.view().camera().axes();
    session.lights().addCircle(normalize(axes.toWorld(towardsCamera)));
    session.lights().resize(1, 24);
    session.lights().select(-1);
    pass(30);
  }
  ViewGeometry view() { return {session.view().camera(), window.viewport().size()}; }
  QPointF placeOf(const Vec3& direction) {
    const HandleSphere sphere = window.lightHandles().sphere(view());
    const auto at = view().project(sphere.center + sphere.radius * direction);
    EXPECT_TRUE(at);
    return at.value_or(QPointF());
  }
  // A point of the rim, to the right of the middle.
  QPointF rimOf(int i) {
    const Vec3 d = light(i).direction, side = normalize(cross(Vec3(0, 1, 0), d));
    const float half = float(radians(light(i).angle / 2));
    return placeOf(std::cos(half) * d + std::sin(half) * side);
  }
  // The viewport as it is on the screen, once it has come to rest.
  QImage screen() {
    const auto grab = [this] {
      const QRect place(window.viewport().mapTo(&window, QPoint(0, 0)), window.viewport().size());
      return window.screen()->grabWindow(window.winId()).toImage().copy(place);
    };
    pass(150);
    QImage last = grab();
    for (int i = 0; i < 60; ++i) {
      pass(100);
      const QImage now = grab();
      if (now == last) break;
      last = now;
    }
    return last;
  }

  Pointer hand{&window.viewport()};
};

TEST_F(LightHandlesTest, ALightIsDraggedOverTheSphereAsOneStep) {
  openWithCircle({0.1f, 0.5f, 1});
  const Camera camera = session.view().camera();
  const QPointF from = placeOf(light(1).direction), to = from + QPointF(70, 40);
  hand.press(from);
  hand.move(from + QPointF(35, 20));
  EXPECT_TRUE(window.viewport().hint().contains(s("circle")));
  hand.move(to);
  hand.release(to);
  EXPECT_LT(QLineF(placeOf(light(1).direction), to).length(), 1.5) << "it stays under the pointer";
  EXPECT_EQ(session.lights().selected(), 1);
  EXPECT_EQ(session.document().undoName(), s("Move circle"));
  EXPECT_EQ(session.view().camera(), camera);
  session.document().undo();
  EXPECT_EQ(session.document().undoName(), s("Resize circle")) << "one drag, one step";
}

TEST_F(LightHandlesTest, ItsRimResizesIt) {
  openWithCircle({0.1f, 0.3f, 1});
  const Vec3 direction = light(1).direction;
  const QPointF from = rimOf(1), middle = placeOf(direction);
  const QPointF to = from + (from - middle);  // about twice as far out
  hand.drag(from, to);
  const Vec3 under = pointOnSphere(window.lightHandles().sphere(view()), view().sightAt(to), true);
  EXPECT_NEAR(light(1).angle / 2, degrees(std::acos(double(dot(under, direction)))), 0.5)
      << "the rim is under the pointer";
  EXPECT_GT(light(1).angle, 40);
  EXPECT_EQ(light(1).direction, direction);
  EXPECT_EQ(session.document().undoName(), s("Resize circle"));
}

TEST_F(LightHandlesTest, OneBehindTheModelIsDraggedOnItsFarSide) {
  openWithCircle({0.6f, 0.5f, -1});
  const QPointF from = placeOf(light(1).direction), to = from + QPointF(-20, -15);
  hand.drag(from, to);
  EXPECT_LT(dot(light(1).direction, session.view().camera().axes().normal), 0);
  EXPECT_LT(QLineF(placeOf(light(1).direction), to).length(), 1.5);
}

TEST_F(LightHandlesTest, BeyondTheEdgeItRollsToTheFarSide) {
  openWithCircle({0.8f, 0, 0.5f});
  const Vec3 back = session.view().camera().axes().normal;
  EXPECT_GT(dot(light(1).direction, back), 0);
  const QPointF from = placeOf(light(1).direction);
  hand.drag(from, from + QPointF(0.5 * QLineF(from, placeOf(back)).length(), 0));
  EXPECT_LT(dot(light(1).direction, back), 0);
}

TEST_F(LightHandlesTest, TheSunIsDraggedToo) {
  openAndSettle();  // under the clear sky
  // On the side of whoever looks, above the middle.
  const SkyAngles eye = anglesOf(session.view().camera().axes().normal);
  session.lights().aim(0, directionOf(SkyAngles{eye.azimuth + 0.3, eye.elevation + 0.3}));
  ASSERT_TRUE(waitFor([&] { return session.rays().ready() && session.settled(); }));
  const Vec3 sun = worldDirection(light(0));
  const QPointF from = placeOf(sun), to = from + QPointF(25, -20);
  hand.drag(from, to);
  EXPECT_EQ(session.document().undoName(), s("Move sun"));
  EXPECT_LT(QLineF(placeOf(worldDirection(light(0))), to).length(), 1.5);
  EXPECT_EQ(light(0).rotation, 0) << "its sky does not turn";
  EXPECT_TRUE(waitFor([&] { return session.environmentExact(); }));
}

TEST_F(LightHandlesTest, EscapeTakesItBack) {
  openWithCircle({0.1f, 0.5f, 1});
  const Recipe before = session.document().recipe();
  const QPointF from = placeOf(light(1).direction);
  hand.press(from);
  hand.move(from + QPointF(50, 20));
  EXPECT_NE(session.document().recipe(), before);
  QTest::keyClick(handle(), Qt::Key_Escape);
  EXPECT_EQ(session.document().recipe(), before);
  hand.release(from + QPointF(50, 20));
  EXPECT_EQ(session.document().undoName(), s("Resize circle"));
}

TEST_F(LightHandlesTest, ShiftDragOverAHandleStillTurnsTheEnvironment) {
  openWithCircle({0.1f, 0.5f, 1});
  const Vec3 direction = light(1).direction;
  const QPointF from = placeOf(direction);
  hand.drag(from, from + QPointF(60, 0), Qt::ShiftModifier);
  EXPECT_EQ(light(1).direction, direction);
  EXPECT_LT(session.environmentAngle(), -10);
}

// How much differs within a few pixels of a place.
int changedNear(const QImage& a, const QImage& b, const QPointF& at) {
  int changed = 0;
  for (int dy = -9; dy <= 9; ++dy)
    for (int dx = -9; dx <= 9; ++dx) {
      const QPoint p = (at + QPointF(dx, dy)).toPoint();
      if (!a.rect().contains(p)) continue;
      const QRgb x = a.pixel(p), y = b.pixel(p);
      changed +=
          std::abs(qRed(x) - qRed(y)) + std::abs(qGreen(x) - qGreen(y)) + std::abs(qBlue(x) - qBlue(y));
    }
  return changed;
}

TEST_F(LightHandlesTest, WhatTheModelHidesIsDrawnFaintAndTheToggleHidesAll) {
  openWithCircle({0, 0, 1});
  session.view().setBackground(BackgroundMode::Plain);
  session.lights().setIntensity(1, 0);  // the model behind the handle looks the same wherever the light is
  const Vec3 towards = session.view().camera().axes().normal;
  auto* toggle = window.findChild<QAction*>(s("lightHandles"));
  ASSERT_TRUE(toggle && toggle->isChecked());
  const auto drawn = [&](const Vec3& direction) {
    session.lights().aim(1, direction);
    window.lightHandles().setEnabled(true);
    const QImage with = screen();
    window.lightHandles().setEnabled(false);
    return changedNear(with, screen(), placeOf(direction));
  };
  // The vase fills the middle of the view: before it, and straight behind it.
  const int before = drawn(towards), behind = drawn(-towards);
  EXPECT_GT(before, 3000);
  EXPECT_GT(behind, 200) << "faint, but there";
  EXPECT_LT(behind, before / 2);

  window.lightHandles().setEnabled(true);
  toggle->trigger();
  EXPECT_FALSE(window.lightHandles().enabled());
  const Recipe recipe = session.document().recipe();
  hand.drag(placeOf(light(1).direction), placeOf(light(1).direction) + QPointF(40, 0));
  EXPECT_EQ(session.document().recipe(), recipe) << "what is not shown is not grabbed";
}

}  // namespace
}  // namespace prt::ui
