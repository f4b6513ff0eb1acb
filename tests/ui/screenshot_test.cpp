// prt-studio --screenshot: pictures for the docs.

#include "tests/ui/studio_process.h"

#include <QImage>

namespace prt::ui {
namespace {

using test::smallScene;

QString s(const char* text) {
  return QString::fromUtf8(text);
}

class Screenshot : public test::StudioProcess {
 protected:
  QString take(const char* name, const QStringList& more = {}, const QString& size = s("1000x700")) {
    const QString file = folder.filePath(s(name));
    start(QStringList{writeScene(smallScene()), s("--screenshot"), file, s("--size"), size} + more);
    EXPECT_EQ(end(), 0) << output.toStdString();
    return file;
  }
  static QByteArray bytes(const QString& path) {
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly));
    return file.readAll();
  }
};

TEST_F(Screenshot, IsOfTheSizeAndShowsTheScene) {
  const QImage image(take("a.png"));
  ASSERT_EQ(image.size(), QSize(1000, 700));
  const QColor middle = image.pixelColor(500, 350);
  EXPECT_GT(middle.red(), middle.blue()) << "the vase";
}

TEST_F(Screenshot, IsTheSameBytesTwice) {
  const QByteArray first = bytes(take("a.png")), second = bytes(take("b.png"));
  EXPECT_GT(first.size(), 10000);
  EXPECT_TRUE(first == second);
}

TEST_F(Screenshot, ShowsWhatLiesOverThePicture) {
  // Under an overcast sky the upper left corner of the view would be bright: there stands the method, on its
  // veil.
  Recipe recipe = smallScene();
  recipe.lights = {LightRecipe{.kind = LightKind::Environment, .path = "builtin:overcast"}};
  const QString file = folder.filePath(s("a.png"));
  start({writeScene(recipe), s("--screenshot"), file, s("--size"), s("1000x700")});
  ASSERT_EQ(end(), 0) << output.toStdString();
  const QImage image(file);
  int dark = 0, legible = 0;
  for (int y = 40; y < 110; ++y)
    for (int x = 244; x < 420; ++x) {
      dark += image.pixelColor(x, y).lightness() < 70;
      legible += image.pixelColor(x, y).lightness() > 150;
    }
  EXPECT_GT(dark, 2000) << "the veil";
  EXPECT_GT(legible, 100) << "the text, or the sky around it";
}

TEST_F(Screenshot, BringsADockToTheFront) {
  const QImage jobs(take("jobs.png")), log(take("log.png", {s("--dock"), s("log")}));
  ASSERT_EQ(jobs.size(), log.size());
  const QRect lowerLeft(0, jobs.height() * 2 / 3, 230, jobs.height() / 3 - 30);
  EXPECT_NE(jobs.copy(lowerLeft), log.copy(lowerLeft));
  const QRect view(400, 200, 300, 300);
  EXPECT_EQ(jobs.copy(view), log.copy(view));
  EXPECT_EQ(bytes(take("again.png", {s("--dock"), s("log")})), bytes(folder.filePath(s("log.png"))))
      << "no times in it";
}

TEST_F(Screenshot, KnowsBothThemes) {
  const QImage dark(take("dark.png", {s("--theme"), s("dark")})),
      light(take("light.png", {s("--theme"), s("light")}));
  EXPECT_LT(dark.pixelColor(200, 10).lightness(), 60);
  EXPECT_GT(light.pixelColor(200, 10).lightness(), 200);
}

TEST_F(Screenshot, IsSharpOnScaledDisplays) {
  for (const char* scale : {"1.25", "1.5", "2"}) {
    setEnvironment("QT_SCALE_FACTOR", s(scale));
    const QImage image(take("scaled.png", {}, s("700x450")));
    EXPECT_EQ(image.size(), QSize(qRound(700 * s(scale).toDouble()), qRound(450 * s(scale).toDouble())))
        << scale;
  }
}

TEST_F(Screenshot, WrongNamesAreToldWithThoseThatThereAre) {
  start({s("--screenshot"), folder.filePath(s("x.png")), s("--dock"), s("nothing")});
  EXPECT_EQ(end(), 2);
  EXPECT_TRUE(output.contains(s("there is no dock 'nothing'")) && output.contains(s("transfer")))
      << output.toStdString();
  output.clear();
  start({s("--theme"), s("pink")});
  EXPECT_EQ(end(), 2);
  EXPECT_TRUE(output.contains(s("dark or light"))) << output.toStdString();
}

}  // namespace
}  // namespace prt::ui
