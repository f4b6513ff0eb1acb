// The light dock, driven by mouse and keys.

#include "ui/docks/light_dock.h"
#include "libprt/core/image_io.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/sky_angles.h"
#include "libprt/project/lights.h"
#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/lat_long.h"
#include "ui/widgets/light_list.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/probe_strip.h"
#include "ui/widgets/property_row.h"

#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QToolButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class LightDockTest : public test::StudioTest {
 protected:
  // Without a sun in the way, and with the dock as high as it needs to be.
  void openUnder(const char* sky = "builtin:overcast") {
    Recipe recipe = test::smallScene();
    recipe.lights[0].path = sky;
    recipe.lights[0].name = "sky";
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->objectName() != s("light")) dock->hide();
    openAndSettle(recipe);
    ASSERT_TRUE(waitFor([this] { return session.jobs().idle(); }));
    panorama = window.findChild<Panorama*>();
    list = window.findChild<LightList*>();
    strip = window.findChild<ProbeStrip*>();
    ASSERT_TRUE(panorama && list && strip);
    pass(20);
  }
  QPointF placeOf(const Vec3& direction) { return toStrip(direction, panorama->size()); }
  // A point of the rim beside the middle of a light.
  QPointF rimOf(int i) {
    const SkyAngles a = anglesOf(light(i).direction);
    return placeOf(directionOf(SkyAngles{a.azimuth, a.elevation - radians(light(i).angle / 2)}));
  }

  Panorama* panorama = nullptr;
  LightList* list = nullptr;
  ProbeStrip* strip = nullptr;
};

TEST_F(LightDockTest, DraggingTheSkyTurnsItAsOneStep) {
  openUnder();
  Pointer hand(panorama);
  hand.drag({100, 80}, {100 + panorama->width() / 8.0, 80});
  EXPECT_NEAR(session.environmentAngle(), -45, 1.5) << "to the right is clockwise from above";
  EXPECT_EQ(undoName(), s("Turn environment"));
  session.document().undo();
  EXPECT_EQ(session.environmentAngle(), 0);
  EXPECT_FALSE(session.document().canUndo());
}

TEST_F(LightDockTest, ADoubleClickAddsACircleLightThereWhichLightsTheModel) {
  openUnder();
  const QImage before = picture();
  const QPointF at = QPointF(panorama->width() * 0.7, panorama->height() * 0.3).toPoint();
  Pointer(panorama).doubleClick(at);
  ASSERT_EQ(session.lights().count(), 2);
  EXPECT_EQ(light(1).kind, LightKind::Circle);
  EXPECT_LT(length(light(1).direction - fromStrip(at, panorama->size())), 1e-4f);
  EXPECT_EQ(session.lights().selected(), 1);
  EXPECT_EQ(undoName(), s("Add circle light"));
  EXPECT_GT(difference(before, picture()), 0.02);
  EXPECT_TRUE(session.bakes().fresh()) << "nothing is baked again";
  session.document().undo();
  EXPECT_EQ(session.lights().count(), 1);
}

TEST_F(LightDockTest, TheButtonAddsOneToo) {
  openUnder();
  QTest::mouseClick(window.findChild<QToolButton*>(s("addCircleLight")), Qt::LeftButton);
  ASSERT_EQ(session.lights().count(), 2);
  EXPECT_GT(dot(light(1).direction, session.view().camera().axes().normal), 0.2f)
      << "on the side of whoever looks";
}

TEST_F(LightDockTest, ALightIsDraggedByItsMiddleAndKeepsWhereItWasGrabbed) {
  openUnder();
  session.lights().addCircle(directionOf(SkyAngles{radians(40.0), radians(20.0)}));
  session.lights().select(-1);
  Pointer hand(panorama);
  const QPointF middle = placeOf(light(1).direction), grabbed = middle + QPointF(2, 1);
  hand.press(grabbed);
  EXPECT_EQ(session.lights().selected(), 1);
  hand.move(grabbed + QPointF(30, -12));
  const quint64 version = session.relighter().lightVersion();
  hand.move(grabbed + QPointF(60, -24));
  EXPECT_GT(session.relighter().lightVersion(), version) << "the picture follows the hand";
  hand.release(grabbed + QPointF(60, -24));
  EXPECT_LT(QLineF(placeOf(light(1).direction), middle + QPointF(60, -24)).length(), 0.01);
  EXPECT_EQ(undoName(), s("Move circle"));
  EXPECT_EQ(light(0).rotation, 0) << "the sky stayed";
  session.document().undo();
  EXPECT_EQ(undoName(), s("Add circle light")) << "one drag, one step";
}

TEST_F(LightDockTest, ALightDraggedOverTheEdgeComesInAtTheOther) {
  openUnder();
  session.lights().addCircle(fromStrip({6, 0.5 * panorama->height()}, panorama->size()));
  Pointer hand(panorama);
  hand.drag(placeOf(light(1).direction), placeOf(light(1).direction) + QPointF(-20, 0));
  EXPECT_NEAR(placeOf(light(1).direction).x(), panorama->width() - 14, 0.1);
}

TEST_F(LightDockTest, TheRimResizes) {
  openUnder();
  session.lights().addCircle(directionOf(SkyAngles{radians(-30.0), radians(30.0)}));
  session.lights().resize(1, 40);
  const Vec3 before = light(1).direction;
  const double pixel = 180.0 / panorama->height();  // degrees
  Pointer hand(panorama);
  hand.drag(rimOf(1), rimOf(1) + QPointF(0, 10));
  EXPECT_NEAR(light(1).angle, 40 + 20 * pixel, 0.5);
  EXPECT_EQ(light(1).direction, before);
  EXPECT_EQ(undoName(), s("Resize circle"));
}

TEST_F(LightDockTest, EscapeTakesADragBack) {
  openUnder();
  session.lights().addCircle({0, 0, -1});
  const Recipe before = session.document().recipe();
  Pointer hand(panorama);
  const QPointF at = placeOf(light(1).direction);
  hand.press(at);
  hand.move(at + QPointF(25, 10));
  EXPECT_NE(session.document().recipe(), before);
  QTest::keyClick(panorama, Qt::Key_Escape);
  EXPECT_EQ(session.document().recipe(), before);
  hand.move(at + QPointF(50, 10));
  hand.release(at + QPointF(50, 10));
  EXPECT_EQ(session.document().recipe(), before);
  EXPECT_EQ(undoName(), s("Add circle light"));
}

TEST_F(LightDockTest, DeleteRemovesTheSelectedLight) {
  openUnder();
  session.lights().addCircle({0, 0, -1});
  Pointer(panorama).click(placeOf({0, 0, -1}));
  QTest::keyClick(panorama, Qt::Key_Delete);
  EXPECT_EQ(session.lights().count(), 1);
  EXPECT_EQ(undoName(), s("Delete circle"));
}

TEST_F(LightDockTest, TheEyeMutesAndThePictureFollows) {
  openUnder();
  session.lights().addCircle(normalize(Vec3(0.3f, 1, 1)));
  const QImage lit = picture();
  Pointer hand(list);
  hand.click(list->eye(1).center());
  EXPECT_FALSE(light(1).on);
  EXPECT_EQ(undoName(), s("Mute circle"));
  EXPECT_GT(difference(lit, picture()), 0.02);
  hand.click(list->eye(1).center());
  EXPECT_TRUE(light(1).on);
  EXPECT_LT(difference(lit, picture()), 0.001);
  hand.click(list->eye(0).center());
  EXPECT_FALSE(light(0).on) << "the environment too";
  const QImage dark = picture();
  EXPECT_LT(qGray(dark.pixel(2, 2)), 12) << "no sky behind the model";
}

TEST_F(LightDockTest, ListPanoramaAndRowsShareTheSelection) {
  openUnder();
  session.lights().addCircle({0, 0, -1});
  session.lights().addCircle(directionOf(SkyAngles{radians(90.0), 0.2}));
  pass(20);  // until the list has room for them
  Pointer hand(list);
  hand.click(list->row(1).center());
  EXPECT_EQ(session.lights().selected(), 1);
  pass(20);  // rows show once they are laid out
  auto* angle = window.findChild<PropertyRow*>(s("lights[1].angle"));
  ASSERT_TRUE(angle);
  EXPECT_TRUE(angle->isVisibleTo(window.findChild<LightDock*>()));
  angle->apply(s("12"));
  EXPECT_EQ(light(1).angle, 12);
  Pointer(panorama).click(placeOf(light(2).direction));
  EXPECT_EQ(session.lights().selected(), 2);
  EXPECT_TRUE(window.findChild<PropertyRow*>(s("lights[2].radiance")));
  EXPECT_FALSE(window.findChild<PropertyRow*>(s("lights[1].angle"))) << "the rows are the selected light's";
  list->setFocus();
  QTest::keyClick(list, Qt::Key_Up);
  EXPECT_EQ(session.lights().selected(), 1);
  QTest::keyClick(list, Qt::Key_Space);
  EXPECT_FALSE(light(1).on);
}

TEST_F(LightDockTest, RenamesInPlace) {
  openUnder();
  session.lights().addCircle({0, 0, -1});
  pass(20);
  Pointer(list).doubleClick(list->row(1).center());
  auto* editor = list->findChild<QLineEdit*>();
  ASSERT_TRUE(editor && editor->isVisible());
  QTest::keyClicks(editor, s("key light"));
  QTest::keyClick(editor, Qt::Key_Return);
  EXPECT_EQ(light(1).name, "key light");
  EXPECT_EQ(undoName(), s("Rename key light"));
}

TEST_F(LightDockTest, TheSwatchPicksAColourAndKeepsTheBrightness) {
  openUnder();
  session.lights().addCircle({0, 0, -1});
  session.lights().setColor(1, Rgb(8));
  pass(20);
  Pointer(list).click(list->swatch(1).center());
  auto* picker = list->findChild<ColorPicker*>();
  ASSERT_TRUE(picker && picker->isVisible());
  Pointer(picker).drag({60, 60}, {150, 9});
  const Rgb color = light(1).radiance;
  EXPECT_NEAR(std::max({color.x, color.y, color.z}), 8, 0.15) << "the upper edge is as bright as before";
  EXPECT_LT(std::min({color.x, color.y, color.z}), 2);
  EXPECT_EQ(undoName(), s("Colour of circle"));
  session.document().undo();
  EXPECT_EQ(light(1).radiance, Rgb(8)) << "one drag, one step";
  picker->hide();
}

TEST_F(LightDockTest, AClickOnAPictureChangesTheEnvironment) {
  openUnder();
  const auto& probes = session.probes().probes();
  ASSERT_TRUE(waitFor([&] { return probes.front().picture != nullptr; }))
      << "the pictures come by themselves";
  const auto orientation = std::find_if(probes.begin(), probes.end(),
                                        [](const Probe& p) { return p.path == s("builtin:orientation"); });
  const QImage before = picture();
  Pointer(strip).click(strip->cell(int(orientation - probes.begin())).center());
  EXPECT_EQ(session.environmentFile(), s("builtin:orientation"));
  EXPECT_EQ(undoName(), s("Change environment"));
  ASSERT_TRUE(waitFor([&] { return session.settled(); }));
  EXPECT_GT(difference(before, picture()), 0.3);
  session.document().undo();
  EXPECT_EQ(session.environmentFile(), s("builtin:overcast"));
}

TEST_F(LightDockTest, ADroppedHdrBecomesTheEnvironmentAndStaysAClickAway) {
  openUnder();
  const QString file = folder.filePath(s("drop.exr"));
  writeImage(file.toStdString(), softboxStudio(64, 32).pixels());
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file)});
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window.findChild<LightDock*>(), &enter);
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window.findChild<LightDock*>(), &drop);
  ASSERT_TRUE(waitFor([&] { return session.environmentFile() == file && session.settled(); }))
      << session.environmentFile().toStdString();
  session.useEnvironment(s("builtin:studio"));
  const auto& probes = session.probes().probes();
  const auto dropped =
      std::find_if(probes.begin(), probes.end(), [&](const Probe& p) { return p.path == file; });
  ASSERT_NE(dropped, probes.end());
  Pointer(strip).click(strip->cell(int(dropped - probes.begin())).center());
  EXPECT_TRUE(waitFor([&] { return session.environmentFile() == file; }));
}

TEST_F(LightDockTest, ABrokenEnvironmentIsToldInTheDockAndTheOldOneStays) {
  openUnder();
  QFile bad(folder.filePath(s("bad.hdr")));
  ASSERT_TRUE(bad.open(QIODevice::WriteOnly));
  bad.write("#?RADIANCE\nnonsense");
  bad.close();
  session.useEnvironment(bad.fileName());
  auto* message = window.findChild<LightDock*>()->findChild<MessageBar*>();
  ASSERT_TRUE(waitFor([&] { return message->isVisible(); }));
  EXPECT_TRUE(message->text().contains(s("bad.hdr")));
  EXPECT_EQ(session.environmentFile(), s("builtin:overcast"));
  EXPECT_FALSE(session.document().modified());
}

TEST_F(LightDockTest, TheSunIsDraggedThePictureFollowsAndTheExactSkyComesAfterwards) {
  openUnder("builtin:clear-sky");
  const QImage before = picture();
  Pointer hand(panorama);
  const Vec3 sun = worldDirection(light(0)), wanted = directionOf(SkyAngles{radians(-60.0), radians(20.0)});
  hand.press(placeOf(sun));
  hand.move(0.5 * (placeOf(sun) + placeOf(wanted)));
  EXPECT_FALSE(session.environmentExact());
  EXPECT_EQ(session.relighter().environment()->height(), 64) << "a coarse map while dragging";
  EXPECT_TRUE(session.jobs().idle()) << "nothing queues up behind the hand";
  hand.move(placeOf(wanted));
  hand.release(placeOf(wanted));
  ASSERT_TRUE(waitFor([&] { return session.environmentExact() && session.settled(); }));
  EXPECT_EQ(session.relighter().environment()->height(), 256);
  EXPECT_NEAR(light(0).sunAzimuth, -60, 0.1);
  EXPECT_NEAR(light(0).sunElevation, 20, 0.1);
  EXPECT_EQ(undoName(), s("Move sun"));
  EXPECT_GT(difference(before, picture()), 0.1);
  session.document().undo();
  ASSERT_TRUE(waitFor([&] { return session.environmentExact() && session.settled(); }));
  EXPECT_LT(difference(before, picture()), 0.001);
}

TEST_F(LightDockTest, TheRowsOfTheSunMoveItToo) {
  openUnder("builtin:clear-sky");
  auto* elevation = window.findChild<PropertyRow*>(s("lights[0].sunElevation"));
  ASSERT_TRUE(elevation);
  elevation->apply(s("12"));
  EXPECT_NEAR(worldDirection(light(0)).y, std::sin(radians(12.0)), 1e-5);
  session.useEnvironment(s("builtin:overcast"));
  EXPECT_FALSE(window.findChild<PropertyRow*>(s("lights[0].sunElevation"))) << "no sun, no rows";
}

}  // namespace
}  // namespace prt::ui
