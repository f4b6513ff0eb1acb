// prt-studio as a user starts it: a process of its own, with keys and mouse from the X server (xdotool).

#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>


namespace prt::ui {
namespace {

using test::pass;
using test::smallScene;
using test::waitFor;

QString s(const char* text) { return QString::fromUtf8(text); }

class StudioProcess : public testing::Test {
 protected:
  StudioProcess() {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(s("HOME"), folder.path());  // settings of its own
    environment.insert(s("XDG_CONFIG_HOME"), folder.path());
    environment.insert(s("QT_QPA_PLATFORM"), s("xcb"));
    studio.setProcessEnvironment(environment);
    studio.setProcessChannelMode(QProcess::MergedChannels);
  }
  ~StudioProcess() override {
    if (studio.state() == QProcess::NotRunning) return;
    studio.kill();
    studio.waitForFinished();
  }
  static QString program() { return QCoreApplication::applicationDirPath() + s("/prt-studio"); }
  void start(const QStringList& arguments) {
    studio.start(program(), arguments);
    ASSERT_TRUE(studio.waitForStarted()) << program().toStdString();
  }
  /// Exit status; -1 when it does not end, -2 when it crashed.
  int end(int milliseconds = 90000) {
    if (!studio.waitForFinished(milliseconds)) return -1;
    output += QString::fromUtf8(studio.readAll());
    return studio.exitStatus() == QProcess::NormalExit ? studio.exitCode() : -2;
  }
  QString writeScene(const Recipe& recipe) {
    QFile file(folder.filePath(s("scene.json")));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    return file.fileName();
  }
  static QString xdotool(const QStringList& arguments) {
    QProcess tool;
    tool.start(s("xdotool"), arguments);
    tool.waitForFinished(20000);
    return QString::fromUtf8(tool.readAllStandardOutput()).trimmed();
  }

  QTemporaryDir folder;
  QProcess studio;
  QString output;
};

TEST_F(StudioProcess, WritesAPictureOfTheWindow) {
  const QString file = folder.filePath(s("shot.png"));
  start({writeScene(smallScene()), s("--screenshot"), file, s("--size"), s("1000x700")});
  ASSERT_EQ(end(), 0) << output.toStdString();
  const QImage image(file);
  ASSERT_EQ(image.size(), QSize(1000, 700));
  const QColor middle = image.pixelColor(500, 350);
  EXPECT_GT(middle.red(), middle.blue()) << "the vase";
}

TEST_F(StudioProcess, FillsTheViewportOnScaledDisplays) {
  QProcessEnvironment environment = studio.processEnvironment();
  environment.insert(s("QT_SCALE_FACTOR"), s("2"));
  studio.setProcessEnvironment(environment);
  Recipe recipe = smallScene();
  recipe.lights = {LightRecipe{.kind = LightKind::Environment, .path = "builtin:overcast"}};
  const QString file = folder.filePath(s("shot.png"));
  start({writeScene(recipe), s("--screenshot"), file, s("--size"), s("700x450")});
  ASSERT_EQ(end(), 0) << output.toStdString();
  const QImage image(file);
  ASSERT_EQ(image.size(), QSize(1400, 900));
  // The overcast sky shows in all corners of the viewport, far from the panels' grey.
  const QColor inside = image.pixelColor(image.width() / 2 + 60, 120);
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
  QString window;
  ASSERT_TRUE(waitFor([&] {
    window = xdotool({s("search"), s("--onlyvisible"), s("--name"), s("PRT Studio")}).section(u'\n', 0, 0);
    return !window.isEmpty();
  })) << "no window";
  pass(3000);  // read, light, first preview
  // The title shows an edited document once the environment has been turned.
  xdotool({s("mousemove"), s("--window"), window, s("640"), s("450")});
  xdotool({s("keydown"), s("shift"), s("mousedown"), s("1")});
  for (int x = 660; x <= 760; x += 20) xdotool({s("mousemove"), s("--window"), window, QString::number(x), s("450")});
  xdotool({s("mouseup"), s("1"), s("keyup"), s("shift")});
  EXPECT_TRUE(waitFor([&] { return xdotool({s("getwindowname"), window}).contains(s(" *")); }, 10000))
      << xdotool({s("getwindowname"), window}).toStdString();
  EXPECT_EQ(studio.state(), QProcess::Running);
  xdotool({s("windowfocus"), s("--sync"), window, s("key"), s("ctrl+q")});
  EXPECT_EQ(end(10000), 0) << output.toStdString();
}

}  // namespace
}  // namespace prt::ui
