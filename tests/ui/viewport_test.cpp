// The viewport, driven by mouse and keys.

#include "tests/ui/studio_fixture.h"
#include "ui/viewport/cpu_canvas.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/message_bar.h"

#include <QMimeData>
#include <QDropEvent>
#include <QDragEnterEvent>
#include <QWheelEvent>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::smallScene;
using test::waitFor;

using ViewportTest = test::StudioTest;

TEST_F(ViewportTest, ShowsTheSceneWithOpenGl) {
  openAndSettle();
  EXPECT_TRUE(dynamic_cast<GlCanvas*>(&window.viewport().canvas())) << window.viewport().canvas().describe().toStdString();
  const QImage image = picture();
  ASSERT_FALSE(image.isNull());
  const QColor middle = image.pixelColor(image.rect().center());
  EXPECT_GT(middle.red(), middle.blue() + 20) << "the clay vase stands in the middle";
  EXPECT_GT(window.viewport().canvas().frameMilliseconds(), 0);
}

TEST_F(ViewportTest, ATwoSidedMaterialIsDrawnWhileItIsBaked) {
  openAndSettle();
  CpuCanvas cpu({session.relighter(), session.view(), session.layers(), [](QPainter&) {}}, nullptr);
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
    EXPECT_NEAR(length(session.view().camera().eye - camera.target), length(camera.eye - camera.target), 1e-3);
  }
  EXPECT_GT(difference(before, picture()), 0.05);
  EXPECT_FALSE(session.document().canUndo()) << "moving the camera is no edit";
}

TEST_F(ViewportTest, ShiftWithTheSamePans) {
  openAndSettle();
  for (const auto& [button, modifiers] : {std::pair(Qt::LeftButton, Qt::AltModifier | Qt::ShiftModifier),
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

TEST_F(ViewportTest, TheWheelZoomsTowardsThePointer) {
  openAndSettle();
  const Camera before = session.view().camera();
  const QPoint at = inView(150, 0);
  QWheelEvent wheel(at, handle()->mapToGlobal(at), QPoint(), QPoint(0, 240), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(handle(), &wheel);
  const Camera& after = session.view().camera();
  EXPECT_LT(length(after.eye - after.target), 0.8f * length(before.eye - before.target));
  EXPECT_GT(dot(after.target - before.target, before.axes().tangent), 1e-3f) << "the pointer was right of the middle";
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
  QMouseEvent move(QEvent::MouseMove, from + QPoint(40, 0), handle()->mapToGlobal(QPointF(from + QPoint(40, 0))), Qt::NoButton,
                   Qt::LeftButton, Qt::ShiftModifier);
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
  QObject::connect(&session.bakes(), &BakeController::productArrived, &window, [&](const QString& stage, const ProductState& state) {
    if (stage == QStringLiteral("transfer")) levels.push_back(state.final() ? 0 : state.level);
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
  EXPECT_TRUE(window.messageBar().text().contains(QStringLiteral("bad.ply"))) << window.messageBar().text().toStdString();
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
  const QImage gl = picture();
  CpuCanvas cpu({session.relighter(), session.view(), session.layers(), [](QPainter&) {}}, nullptr);
  cpu.resize(window.viewport().size());
  QImage other = cpu.grabPicture();
  ASSERT_EQ(other.size(), gl.size());
  // The plain background is the screen's business: compare where the model is.
  int compared = 0, agreeing = 0;
  for (int y = gl.height() / 3; y < 2 * gl.height() / 3; ++y)
    for (int x = gl.width() * 2 / 5; x < gl.width() * 3 / 5; ++x) {
      const QRgb p = gl.pixel(x, y), q = other.pixel(x, y);
      ++compared;
      agreeing += std::abs(qRed(p) - qRed(q)) <= 2 && std::abs(qGreen(p) - qGreen(q)) <= 2 && std::abs(qBlue(p) - qBlue(q)) <= 2;
    }
  EXPECT_GT(double(agreeing) / compared, 0.95);
}

}  // namespace
}  // namespace prt::ui
