// prt-studio as a user starts it: a process of its own, with keys and mouse from the X server (xdotool).

#include "tests/ui/studio_process.h"
#include "tests/ui/wait.h"

#include <QImage>
#include <QStandardPaths>

namespace prt::ui {
namespace {

using test::pass;
using test::smallScene;
using test::waitFor;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

using test::StudioProcess;

TEST_F(StudioProcess, FillsTheViewportOnScaledDisplays) {
  setEnvironment("QT_SCALE_FACTOR", s("2"));
  Recipe recipe = smallScene();
  recipe.lights = {LightRecipe{.kind = LightKind::Environment, .path = "builtin:overcast"}};
  const QString file = folder.filePath(s("shot.png"));
  start({writeScene(recipe), s("--screenshot"), file, s("--size"), s("700x450")});
  ASSERT_EQ(end(), 0) << output.toStdString();
  const QImage image(file);
  ASSERT_EQ(image.size(), QSize(1400, 900));
  // The overcast sky shows at the viewport's edge, below the method's veil, far from the panels' grey.
  const QColor inside = image.pixelColor(2 * 242, 2 * 96);
  EXPECT_GT(inside.lightness(), 90);
}

TEST_F(StudioProcess, WrongUsageAndMissingFilesEndWithAMessage) {
  start({s("a"), s("b")});
  EXPECT_EQ(end(), 2);
  EXPECT_TRUE(output.contains(s("one input")));
  output.clear();
  start({s("--size"), s("large")});
  EXPECT_EQ(end(), 2);
  start({s("/nowhere/missing.obj"), s("--screenshot"), folder.filePath(s("x.png"))});
  EXPECT_EQ(end(), 1);
  EXPECT_TRUE(output.contains(s("missing.obj"))) << output.toStdString();
}

TEST_F(StudioProcess, HelpShowsAnExample) {
  start({s("--help")});
  EXPECT_EQ(end(), 0);
  EXPECT_TRUE(output.contains(s("Example")));
}

TEST_F(StudioProcess, MouseAndKeysFromTheXServerWorkAndClosingDuringABakeIsClean) {
  if (QStandardPaths::findExecutable(s("xdotool")).isEmpty()) GTEST_SKIP() << "needs xdotool";
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;  // still baking when it is closed
  start({writeScene(recipe), s("--reset-ui")});
  const QString window = findWindow();
  ASSERT_FALSE(window.isEmpty()) << "no window";
  EXPECT_EQ(
      xdotool({s("search"), s("--onlyvisible"), s("--classname"), s("^prt-studio$")}).section(u'\n', 0, 0),
      window)
      << "task bars find the desktop file by it";
  pass(3000);  // read, light, first preview
  // The title shows an edited document once the environment has been turned.
  turnEnvironment(window);
  EXPECT_TRUE(waitFor(
      [&] {
        return xdotool({s("getwindowname"), window}).contains(s(" *"));
      },
      10000))
      << xdotool({s("getwindowname"), window}).toStdString();
  EXPECT_EQ(studio.state(), QProcess::Running);
  xdotool({s("windowfocus"), s("--sync"), window, s("key"), s("ctrl+q")});
  pass(500);  // it asks about the edit
  EXPECT_EQ(studio.state(), QProcess::Running);
  xdotool({s("key"), s("alt+d")});  // don't save
  EXPECT_EQ(end(10000), 0) << output.toStdString();
}

}  // namespace
}  // namespace prt::ui
