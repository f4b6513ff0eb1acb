// OpenGL and CPU drawing change places at run time: beside a bake, in a window that nobody sees, and when the
// window system takes the OpenGL context away.

#include "tests/ui/studio_fixture.h"
#include "ui/viewport/cpu_canvas.h"
#include "ui/viewport/gl_canvas.h"

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::smallScene;
using test::waitFor;

class CanvasSwitchTest : public test::StudioTest {
 protected:
  Viewport& view() { return window.viewport(); }
  bool isGl() { return dynamic_cast<GlCanvas*>(&view().canvas()) != nullptr; }
  bool drawn(quint64 frames = 1) {
    return waitFor([&] { return view().canvas().frames() >= frames; }, 10000);
  }
  bool still() {
    return waitFor([this] { return view().canvas().settled(); }, 20000);
  }
  CanvasContext context() {
    return {session.relighter(), session.view(), session.layers(), session.jobs(), [](QPainter&) {}};
  }
};

TEST_F(CanvasSwitchTest, WhileABakeRuns) {
  if (GlCanvas::support() == GlSupport::None) GTEST_SKIP() << "no OpenGL 4.5 here";
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;
  open(recipe);
  ASSERT_TRUE(waitFor([this] { return session.relighter().transfer() && session.bakes().baking(); }));
  const quint64 job = session.bakes().job();
  for (int round = 0; round < 3; ++round)
    for (const Drawing drawing : {Drawing::OpenGl, Drawing::Cpu}) {
      view().setDrawing(drawing);
      EXPECT_EQ(isGl(), drawing == Drawing::OpenGl);
      ASSERT_TRUE(drawn());
      const quint64 frames = view().canvas().frames();
      session.setEnvironmentAngle(session.environmentAngle() + 20);
      ASSERT_TRUE(drawn(frames + 1)) << "the light still turns";
    }
  EXPECT_TRUE(session.bakes().baking());
  EXPECT_EQ(session.bakes().job(), job) << "nobody disturbed the bake";
  session.bakes().cancel();
  ASSERT_TRUE(waitFor([this] { return session.jobs().idle(); }));
  ASSERT_TRUE(still());
  const QImage cpu = picture();
  view().setDrawing(Drawing::OpenGl);
  ASSERT_TRUE(drawn() && still());
  EXPECT_LT(difference(cpu, picture()), 0.02);
  view().setDrawing(Drawing::Automatic);
}

TEST_F(CanvasSwitchTest, InAWindowThatIsNotSeen) {
  if (GlCanvas::support() == GlSupport::None) GTEST_SKIP() << "no OpenGL 4.5 here";
  openAndSettle();
  view().setDrawing(Drawing::Cpu);
  ASSERT_TRUE(drawn() && still());
  for (const bool minimised : {false, true})
    for (const Drawing drawing : {Drawing::OpenGl, Drawing::Cpu}) {
      if (minimised)
        window.showMinimized();
      else
        window.hide();
      pass(50);
      view().setDrawing(drawing);
      session.setEnvironmentAngle(session.environmentAngle() + 40);
      pass(50);
      EXPECT_EQ(isGl(), drawing == Drawing::OpenGl);
      window.showNormal();
      ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
      ASSERT_TRUE(drawn() && still());
      const QImage seen = picture();
      CpuCanvas other(context(), nullptr);
      other.resize(view().size());
      EXPECT_LT(difference(seen, other.grabPicture()), 0.02) << minimised << ' ' << int(drawing);
    }
  view().setDrawing(Drawing::Automatic);
}

TEST_F(CanvasSwitchTest, BothDrawThePatch) {
  if (GlCanvas::support() == GlSupport::None) GTEST_SKIP() << "no OpenGL 4.5 here";
  Recipe recipe = smallScene();
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.heightmap = "builtin:bins";
  recipe.patch.grid = 16;
  recipe.rtt.texels = 8, recipe.rtt.views = 3, recipe.rtt.rays = 64, recipe.rtt.supersamples = 1;
  recipe.synthesis.vertices = 2000, recipe.synthesis.scale = 1;
  recipe.idmap.size = 128, recipe.atlas.size = 256;
  recipe.method.name = "biscale";
  window.resize(640, 480);
  openAndSettle(recipe);
  ASSERT_TRUE(waitFor([this] { return session.jobs().idle() && session.relighter().shownPatch(); }));
  view().setDrawing(Drawing::Cpu);
  ASSERT_TRUE(drawn() && still());
  const QImage cpu = picture();
  view().setDrawing(Drawing::OpenGl);
  ASSERT_TRUE(isGl() && drawn() && still());
  const QImage patched = picture();
  EXPECT_LT(difference(cpu, patched), 0.02);
  // With transfer kept where the picture is drawn, as on a graphics card.
  auto& canvas = dynamic_cast<GlCanvas&>(view().canvas());
  canvas.setKeepsTransfer(true);
  ASSERT_TRUE(waitFor([&] { return canvas.transferKept() && still(); }, 10000));
  EXPECT_LT(difference(patched, picture()), 0.002);
  const auto differs = [&] { return waitFor([&] { return difference(patched, picture()) > 0.02; }, 10000); };
  session.setEnvironmentAngle(session.environmentAngle() + 90);
  EXPECT_TRUE(differs()) << "the light turns over it";
  session.setEnvironmentAngle(session.environmentAngle() - 90);
  session.document().set(QStringLiteral("method.name"), QStringLiteral("auto"));
  EXPECT_TRUE(differs()) << "it was to be seen";
  EXPECT_TRUE(isGl()) << "hiding the patch is no matter of who draws";
  view().setDrawing(Drawing::Automatic);
}

// A widget that moves to another window gets another context there; everything is uploaded again.
TEST_F(CanvasSwitchTest, ANewContextShowsTheSamePicture) {
  if (GlCanvas::support() == GlSupport::None) GTEST_SKIP() << "no OpenGL 4.5 here";
  openAndSettle();
  session.layers().setValues(
      std::vector<float>(session.relighter().scene()->mesh.vertexCount(), 0.5f));  // an overlay, too
  QWidget first, second;
  for (QWidget* host : {&first, &second}) {
    host->resize(300, 200);
    host->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(host));
  }
  auto* canvas = new GlCanvas(context(), &first);
  QString problem;
  QObject::connect(canvas, &GlCanvas::failed, [&](const QString& text) { problem = text; });
  canvas->resize(300, 200);
  canvas->setThorough(true);
  canvas->show();
  ASSERT_TRUE(waitFor([&] { return canvas->settled(); }, 20000));
  const QImage before = canvas->grabPicture();
  const QOpenGLContext* old = canvas->context();
  for (QWidget* host : {&second, &first}) {
    canvas->setParent(host);
    canvas->show();
    const quint64 frames = canvas->frames();
    ASSERT_TRUE(waitFor([&] { return canvas->frames() > frames && canvas->settled(); }, 20000));
    EXPECT_EQ(problem.toStdString(), "");
    EXPECT_LT(difference(before, canvas->grabPicture()), 0.0005);
  }
  EXPECT_NE(canvas->context(), old) << "it was the same context all the time";
  QImage black(before.size(), before.format());
  black.fill(Qt::black);
  EXPECT_GT(difference(before, black), 0.5) << "there is something to see";
}

}  // namespace
}  // namespace prt::ui
