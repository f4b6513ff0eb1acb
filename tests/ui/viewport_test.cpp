// The viewport, driven by mouse and keys.

#include "tests/ui/studio_fixture.h"
#include "ui/viewport/cpu_canvas.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/message_bar.h"

#include <QAction>
#include <QApplication>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMenu>
#include <QMimeData>
#include <QWheelEvent>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::smallScene;
using test::waitFor;

using ViewportTest = test::StudioTest;

TEST_F(ViewportTest, ShowsTheSceneWithWhatIsFasterOrWithWhatIsChosen) {
  Viewport& view = window.viewport();
  const bool card = GlCanvas::support() == GlSupport::Hardware;
  EXPECT_EQ(dynamic_cast<GlCanvas*>(&view.canvas()) != nullptr, card)
      << view.canvas().describe().toStdString();
  openAndSettle();
  const QImage first = picture();
  view.setDrawing(Drawing::OpenGl);
  EXPECT_TRUE(dynamic_cast<GlCanvas*>(&view.canvas()));
  EXPECT_TRUE(waitFor([&] { return view.canvas().frames() > 0; }));
  const QImage gl = picture();
  view.setDrawing(Drawing::Cpu);
  EXPECT_TRUE(dynamic_cast<CpuCanvas*>(&view.canvas()));
  EXPECT_TRUE(waitFor([&] { return view.canvas().settled(); }));
  EXPECT_LT(difference(picture(), gl), 0.02);
  EXPECT_LT(difference(first, gl), 0.02);
  view.setDrawing(Drawing::Automatic);
}

TEST_F(ViewportTest, TheVaseStandsInTheMiddle) {
  openAndSettle();
  const QImage image = picture();
  ASSERT_FALSE(image.isNull());
  const QColor middle = image.pixelColor(image.rect().center());
  EXPECT_GT(middle.red(), middle.blue() + 20) << "the clay vase stands in the middle";
  EXPECT_GT(window.viewport().canvas().frameMilliseconds(), 0);
}

TEST_F(ViewportTest, ATwoSidedMaterialIsDrawnWhileItIsBaked) {
  window.viewport().setDrawing(Drawing::OpenGl);
  openAndSettle();
  CpuCanvas cpu({session.relighter(), session.view(), session.layers(), session.jobs(), [](QPainter&) {}},
                nullptr);
  cpu.resize(64, 48);
  const auto samples = [this] { return session.relighter().samples()->size(); };
  const std::size_t oneSided = samples();
  for (const bool twoSided : {true, false, true}) {
    Recipe recipe = session.document().recipe();
    recipe.objects[0].material.twoSided = twoSided;
    session.document().edit(QStringLiteral("Two-sided"), recipe);
    EXPECT_FALSE(cpu.grabPicture().isNull()) << "before the bake begins";
    ASSERT_TRUE(waitFor([&] {
      picture();
      cpu.grabPicture();
      return session.settled() && session.bakes().fresh();
    }));
    EXPECT_EQ(samples(), twoSided ? 2 * oneSided : oneSided);
    EXPECT_TRUE(dynamic_cast<GlCanvas*>(&window.viewport().canvas())) << "OpenGL draws on";
    EXPECT_FALSE(picture().isNull());
    EXPECT_FALSE(cpu.grabPicture().isNull());
  }
  window.viewport().setDrawing(Drawing::Automatic);
}

TEST_F(ViewportTest, AltDragAndMiddleDragOrbit) {
  openAndSettle();
  const QImage before = picture();
  const std::pair<Qt::MouseButton, Qt::KeyboardModifiers> ways[] = {{Qt::LeftButton, Qt::AltModifier},
                                                                    {Qt::MiddleButton, Qt::NoModifier}};
  for (const auto& [button, modifiers] : ways) {
    const Camera camera = session.view().camera();
    drag(button, modifiers, QPoint(120, 30));
    EXPECT_EQ(session.view().camera().target, camera.target);
    EXPECT_GT(length(session.view().camera().eye - camera.eye), 0.1f);
    EXPECT_NEAR(length(session.view().camera().eye - camera.target), length(camera.eye - camera.target),
                1e-3);
  }
  EXPECT_GT(difference(before, picture()), 0.05);
  EXPECT_FALSE(session.document().canUndo()) << "moving the camera is no edit";
}

TEST_F(ViewportTest, ShiftWithTheSamePans) {
  openAndSettle();
  for (const auto& [button, modifiers] :
       {std::pair(Qt::LeftButton, Qt::AltModifier | Qt::ShiftModifier),
        std::pair(Qt::MiddleButton, Qt::KeyboardModifiers(Qt::ShiftModifier))}) {
    const Camera camera = session.view().camera();
    drag(button, modifiers, QPoint(80, -40));
    const Vec3 moved = session.view().camera().target - camera.target;
    EXPECT_LT(dot(moved, camera.axes().tangent), -1e-3f) << "the scene follows the pointer to the right";
    EXPECT_LT(dot(moved, camera.axes().bitangent), -1e-3f) << "and up";
    EXPECT_NEAR(length(session.view().camera().eye - camera.eye - moved), 0, 1e-4);
  }
}

TEST_F(ViewportTest, PlainDragsDoNothing) {
  openAndSettle();
  const Camera camera = session.view().camera();
  drag(Qt::LeftButton, Qt::NoModifier, QPoint(100, 50));
  drag(Qt::RightButton, Qt::NoModifier, QPoint(100, 50));
  EXPECT_EQ(session.view().camera(), camera);
  EXPECT_FALSE(session.document().modified());
}

Recipe twoVases() {
  Recipe recipe = smallScene();
  recipe.objects.push_back(recipe.objects[0]);
  recipe.objects[0].transform.translate = Vec3(-0.6f, 0, 0);
  recipe.objects[1].transform.translate = Vec3(0.6f, 0, 0);
  CameraRecipe camera;
  camera.eye = Vec3(0, 0.5f, 4);
  camera.target = Vec3(0, 0.5f, 0);
  recipe.cameras = {camera};
  return recipe;
}

TEST_F(ViewportTest, AClickSelectsTheObjectUnderThePointerADragDoesNot) {
  openAndSettle(twoVases());
  Viewport& view = window.viewport();
  // Where the second vase's middle appears: perspective by hand.
  const double focal = 0.5 * view.height() / std::tan(0.5 * radians(30)), dx = 0.6 * focal / 4;
  std::vector<QPointF> clicks;
  QObject::connect(&view, &Viewport::clicked, &window, [&](const QPointF& at) { clicks.push_back(at); });
  const auto hit = view.pick(QPointF(0.5 * view.width() + dx, 0.5 * view.height()));
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->object, 1u);
  EXPECT_NEAR(hit->position.y, 0.5, 0.02);
  EXPECT_NEAR(hit->position.x, 0.6, 0.15);
  EXPECT_FALSE(view.pick(QPointF(2, 2)));

  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, inView(int(dx), 0));
  EXPECT_EQ(session.selectedObject(), 1);
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, inView(-int(dx), 0));
  EXPECT_EQ(session.selectedObject(), 0);
  ASSERT_EQ(clicks.size(), 2u);
  EXPECT_NEAR(clicks[0].x() - clicks[1].x(), 2 * int(dx), 1);
  drag(Qt::LeftButton, Qt::NoModifier, QPoint(int(dx), 0));
  EXPECT_EQ(clicks.size(), 2u);
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier,
                    inView(-view.width() / 2 + 5, -view.height() / 2 + 5));
  EXPECT_EQ(session.selectedObject(), 0) << "the background selects nothing else";
  EXPECT_EQ(clicks.size(), 3u);
  EXPECT_FALSE(session.document().modified());
}

TEST_F(ViewportTest, TheWheelZoomsTowardsThePointer) {
  openAndSettle();
  const Camera before = session.view().camera();
  const QPoint at = inView(150, 0);
  QWheelEvent wheel(at, handle()->mapToGlobal(at), QPoint(), QPoint(0, 240), Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(handle(), &wheel);
  const Camera& after = session.view().camera();
  EXPECT_LT(length(after.eye - after.target), 0.8f * length(before.eye - before.target));
  EXPECT_GT(dot(after.target - before.target, before.axes().tangent), 1e-3f)
      << "the pointer was right of the middle";
}

TEST_F(ViewportTest, FFramesAndRResets) {
  openAndSettle();
  const Camera home = session.view().camera();
  drag(Qt::MiddleButton, Qt::ShiftModifier, QPoint(300, 200));
  drag(Qt::MiddleButton, Qt::NoModifier, QPoint(100, 0));
  QTest::keyClick(handle(), Qt::Key_F);
  EXPECT_NEAR(length(session.view().camera().target - session.bounds().center()), 0, 1e-4);
  EXPECT_NE(session.view().camera(), home);
  QTest::keyClick(handle(), Qt::Key_R);
  EXPECT_EQ(session.view().camera(), home);
}

TEST_F(ViewportTest, ShiftDragTurnsTheEnvironmentWithEitherButton) {
  openAndSettle();
  const QImage before = picture();
  const Camera camera = session.view().camera();
  drag(Qt::LeftButton, Qt::ShiftModifier, QPoint(200, 0));
  const double first = session.environmentAngle();
  EXPECT_LT(first, -20) << "to the right is clockwise seen from above";
  EXPECT_EQ(session.document().undoName(), QStringLiteral("Turn environment"));
  EXPECT_GT(difference(before, picture()), 0.05) << "the light on the model and what stands behind it";
  drag(Qt::RightButton, Qt::ShiftModifier, QPoint(-100, 0));
  EXPECT_GT(session.environmentAngle(), first + 10);
  EXPECT_EQ(session.view().camera(), camera);
  EXPECT_FALSE(session.bakes().baking()) << "turning the light bakes nothing";

  session.document().undo();
  session.document().undo();
  EXPECT_EQ(session.environmentAngle(), 0) << "two drags, two steps";
  EXPECT_FALSE(session.document().canUndo());
  EXPECT_LT(difference(before, picture()), 0.01);
}

TEST_F(ViewportTest, TheEnvironmentTurnsWhileTheHandMoves) {
  openAndSettle();
  const QPoint from = inView();
  QTest::mousePress(handle(), Qt::LeftButton, Qt::ShiftModifier, from);
  const quint64 version = session.relighter().lightVersion();
  QMouseEvent move(QEvent::MouseMove, from + QPoint(40, 0),
                   handle()->mapToGlobal(QPointF(from + QPoint(40, 0))), Qt::NoButton, Qt::LeftButton,
                   Qt::ShiftModifier);
  QCoreApplication::sendEvent(handle(), &move);
  EXPECT_GT(session.relighter().lightVersion(), version);
  EXPECT_TRUE(window.viewport().hint().contains(QStringLiteral("Turning")));
  QTest::mouseRelease(handle(), Qt::LeftButton, Qt::ShiftModifier, from + QPoint(40, 0));
  EXPECT_FALSE(window.viewport().hint().contains(QStringLiteral("Turning")));
}

TEST_F(ViewportTest, PreviewsRefineThePictureAndTheFinalOneReplacesThem) {
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.detail = 0.5f;
  recipe.transfer.rays = 4096;
  std::vector<int> levels;
  QObject::connect(&session.bakes(), &BakeController::productArrived, &window,
                   [&](const QString& stage, const ProductState& state) {
                     if (stage == QStringLiteral("transfer"))
                       levels.push_back(state.final() ? 0 : state.level);
                   });
  open(recipe);
  ASSERT_TRUE(waitFor([&] { return !levels.empty(); }));
  EXPECT_GT(levels.front(), 0) << "a preview comes first";
  EXPECT_LT(session.status().level, session.status().levels);
  ASSERT_TRUE(waitFor([&] { return session.bakes().fresh(); }));
  EXPECT_EQ(levels.back(), 0);
  EXPECT_EQ(session.status().level, session.status().levels);
  EXPECT_EQ(session.status().rays, 4096);
}

TEST_F(ViewportTest, ADroppedMeshIsOpenedAndABadOneIsToldInTheViewport) {
  openAndSettle();
  const Recipe before = session.document().recipe();
  const auto drop = [&](const QString& file) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    const QPoint at(100, 100);
    QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window.viewport(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent event(QPointF(at), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window.viewport(), &event);
    ASSERT_TRUE(waitFor([&] { return !session.opening(); }));
  };
  QFile bad(folder.filePath(QStringLiteral("bad.ply")));
  ASSERT_TRUE(bad.open(QIODevice::WriteOnly));
  bad.write("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n");
  bad.close();
  drop(bad.fileName());
  EXPECT_TRUE(window.messageBar().isVisible());
  EXPECT_TRUE(window.messageBar().text().contains(QStringLiteral("bad.ply")))
      << window.messageBar().text().toStdString();
  EXPECT_EQ(session.document().recipe(), before);

  QFile good(folder.filePath(QStringLiteral("good.obj")));
  ASSERT_TRUE(good.open(QIODevice::WriteOnly));
  good.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  good.close();
  drop(good.fileName());
  EXPECT_FALSE(window.messageBar().isVisible()) << "what went wrong before is over";
  EXPECT_EQ(session.document().title(), QStringLiteral("good.obj"));
  EXPECT_TRUE(waitFor([&] { return session.bakes().fresh(); }));
}

TEST_F(ViewportTest, GlAndCpuCanvasShowTheSamePicture) {
  openAndSettle();
  session.view().setBackground(BackgroundMode::Plain);
  window.viewport().setDrawing(Drawing::OpenGl);
  ASSERT_TRUE(waitFor(
      [&] { return window.viewport().canvas().frames() > 0 && window.viewport().canvas().settled(); }));
  const QImage gl = picture();
  CpuCanvas cpu({session.relighter(), session.view(), session.layers(), session.jobs(), [](QPainter&) {}},
                nullptr);
  cpu.resize(window.viewport().size());
  QImage other = cpu.grabPicture();
  ASSERT_EQ(other.size(), gl.size());
  // The plain background is the screen's business: compare where the model is.
  int compared = 0, agreeing = 0;
  for (int y = gl.height() / 3; y < 2 * gl.height() / 3; ++y)
    for (int x = gl.width() * 2 / 5; x < gl.width() * 3 / 5; ++x) {
      const QRgb p = gl.pixel(x, y), q = other.pixel(x, y);
      ++compared;
      agreeing += std::abs(qRed(p) - qRed(q)) <= 2 && std::abs(qGreen(p) - qGreen(q)) <= 2 &&
                  std::abs(qBlue(p) - qBlue(q)) <= 2;
    }
  EXPECT_GT(double(agreeing) / compared, 0.95);
}

TEST_F(ViewportTest, ThePresetDecidesWhatDragsDoAndTheHintFollows) {
  openAndSettle();
  QStringList hints;
  QObject::connect(&window.viewport(), &Viewport::hintChanged, &window,
                   [&](const QString& hint) { hints << hint; });
  auto* maya = window.findChild<QAction*>(QStringLiteral("navigation.1"));
  ASSERT_TRUE(maya);
  maya->trigger();
  EXPECT_EQ(session.view().navigation(), NavigationPreset::Maya);
  EXPECT_TRUE(maya->isChecked());
  EXPECT_TRUE(hints.last().contains(QStringLiteral("Alt+right zooms"))) << hints.last().toStdString();

  const Camera before = session.view().camera();
  drag(Qt::MiddleButton, Qt::NoModifier, QPoint(100, 0));
  EXPECT_EQ(session.view().camera(), before) << "the middle button alone is Blender's";
  drag(Qt::MiddleButton, Qt::AltModifier, QPoint(60, 0));
  EXPECT_GT(length(session.view().camera().target - before.target), 1e-3f);
  const float away = length(session.view().camera().eye - session.view().camera().target);
  drag(Qt::RightButton, Qt::AltModifier, QPoint(100, 0));
  EXPECT_LT(length(session.view().camera().eye - session.view().camera().target), 0.9f * away);
  window.findChild<QAction*>(QStringLiteral("navigation.0"))->trigger();
}

TEST_F(ViewportTest, KeysLookAlongAxesAndSwitchToParallelRays) {
  openAndSettle();
  const Vec3 target = session.view().camera().target;
  const auto side = [&] { return normalize(session.view().camera().eye - target); };
  window.viewport().setFocus();
  QTest::keyClick(handle(), Qt::Key_1);
  EXPECT_NEAR(side().z, 1, 1e-5);
  EXPECT_TRUE(session.view().camera().orthographic);
  QTest::keyClick(handle(), Qt::Key_3);
  EXPECT_NEAR(side().x, 1, 1e-5);
  QTest::keyClick(handle(), Qt::Key_3, Qt::ControlModifier);
  EXPECT_NEAR(side().x, -1, 1e-5);
  QTest::keyClick(handle(), Qt::Key_7);
  EXPECT_NEAR(side().y, 1, 1e-5);
  QTest::keyClick(handle(), Qt::Key_5);
  EXPECT_FALSE(session.view().camera().orthographic);
  QTest::keyClick(handle(), Qt::Key_Plus);
  EXPECT_FLOAT_EQ(session.view().tone().exposure, 0.5f);
  QTest::keyClick(handle(), Qt::Key_0);
  EXPECT_FLOAT_EQ(session.view().tone().exposure, 0);
  QTest::keyClick(handle(), Qt::Key_R);
}

TEST_F(ViewportTest, FFramesTheSelectedObjectAndAAll) {
  openAndSettle(twoVases());
  session.selectObject(1);
  QTest::keyClick(handle(), Qt::Key_F);
  EXPECT_NEAR(session.view().camera().target.x, 0.6f, 0.05f);
  QTest::keyClick(handle(), Qt::Key_A);
  EXPECT_NEAR(session.view().camera().target.x, 0, 0.05f);
}

TEST_F(ViewportTest, BackgroundsAreTheEnvironmentItsBlurOrPlainInBothDrawings) {
  Recipe recipe = smallScene();
  recipe.lights[0].path = "builtin:orientation";  // edges, which a blur changes
  openAndSettle(recipe);
  QImage seen[2][3];
  for (const Drawing drawing : {Drawing::Cpu, Drawing::OpenGl}) {
    window.viewport().setDrawing(drawing);
    for (int i = 0; i < 3; ++i) {
      session.view().setBackground(BackgroundMode(i));
      ASSERT_TRUE(waitFor(
          [&] { return window.viewport().canvas().frames() > 0 && window.viewport().canvas().settled(); }));
      seen[drawing == Drawing::OpenGl][i] = picture();
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(difference(seen[0][i], seen[1][i]), 0.02) << "background " << i;
    EXPECT_GT(difference(seen[0][i], seen[0][(i + 1) % 3]), 0.2);
  }
  session.view().setBackground(BackgroundMode::Environment);
  QTest::keyClick(handle(), Qt::Key_B);
  EXPECT_EQ(session.view().background(), BackgroundMode::Blurred);
  session.view().setBackground(BackgroundMode::Environment);
  window.viewport().setDrawing(Drawing::Automatic);
}

TEST_F(ViewportTest, ARightClickOpensAMenuARightDragDoesNot) {
  openAndSettle(twoVases());
  int menus = 0;
  QObject::connect(&window.viewport(), &Viewport::menuRequested, &window, [&] { ++menus; });
  drag(Qt::RightButton, Qt::ShiftModifier, QPoint(60, 0));
  drag(Qt::RightButton, Qt::NoModifier, QPoint(60, 0));
  EXPECT_EQ(menus, 0);
  QTest::mouseClick(handle(), Qt::RightButton, Qt::NoModifier, inView(120, 0));
  ASSERT_EQ(menus, 1);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu);
  QStringList entries;
  for (const QAction* action : menu->actions()) entries << action->objectName();
  EXPECT_TRUE(entries.contains(QStringLiteral("frameSelected"))) << entries.join(u' ').toStdString();
  EXPECT_TRUE(entries.contains(QStringLiteral("copyPicture")));
  menu->close();
}

TEST_F(ViewportTest, SmoothEdgesComeWhenTheHandRestsAndGoWhenItMoves) {
  window.viewport().setDrawing(Drawing::Cpu);
  openAndSettle();
  Canvas& canvas = window.viewport().canvas();
  ASSERT_TRUE(waitFor([&] { return canvas.settled(); }));
  session.view().orbit(0.1f, 0);
  EXPECT_FALSE(canvas.settled());
  ASSERT_TRUE(waitFor([&] { return canvas.settled(); }));
  window.viewport().setDrawing(Drawing::Automatic);
}

}  // namespace
}  // namespace prt::ui
