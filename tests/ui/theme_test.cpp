// The two themes: legible, complete, and changed while the program runs.

#include "ui/widgets/theme.h"
#include "tests/ui/studio_fixture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/number_field.h"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QRegularExpression>
#include <QSettings>

namespace prt::ui {
namespace {

using test::s;

std::string nameOf(const QColor& color) {
  return color.name().toStdString();
}

class ThemeOf : public testing::TestWithParam<const Theme*> {};

TEST_P(ThemeOf, TextIsLegibleOnEverySurface) {
  const Theme& t = *GetParam();
  for (const QColor& surface : {t.window, t.panel, t.field, t.fieldHover})
    for (const QColor& text : {t.text, t.muted, t.accent, t.done, t.stale, t.failed})
      EXPECT_GE(contrast(text, surface), 4.5) << nameOf(text) << " on " << nameOf(surface);
  for (const QColor& text : {t.text, t.muted})
    EXPECT_GE(contrast(text, t.line), 4.5) << nameOf(text) << " on what is selected";
  EXPECT_GE(contrast(t.onAccent, t.accent), 4.5);
}

TEST_P(ThemeOf, SurfacesCanBeToldApart) {
  const Theme& t = *GetParam();
  EXPECT_NE(t.window, t.panel);
  EXPECT_GE(contrast(t.panel, t.field), 1.05);
  EXPECT_GE(contrast(t.line, t.panel), 1.15);
  for (const QColor& grey : {t.window, t.panel, t.field, t.fieldHover, t.line, t.text, t.muted})
    EXPECT_TRUE(grey.red() == grey.green() && grey.green() == grey.blue())
        << nameOf(grey) << " tints what is judged beside it";
}

TEST_P(ThemeOf, TheStyleSheetUsesOnlyColoursThatThereAre) {
  applyTheme(*qApp, *GetParam());
  EXPECT_FALSE(qApp->styleSheet().isEmpty());
  EXPECT_FALSE(qApp->styleSheet().contains(u'@'));
  QRegularExpressionMatchIterator pictures =
      QRegularExpression(s("url\\(([^)]*)\\)")).globalMatch(qApp->styleSheet());
  int count = 0;
  for (; pictures.hasNext(); ++count) {
    const QString file = pictures.next().captured(1);
    EXPECT_TRUE(QFile::exists(file)) << file.toStdString();
  }
  EXPECT_GT(count, 0);
  applyTheme(*qApp, darkTheme());
}

INSTANTIATE_TEST_SUITE_P(Both, ThemeOf, testing::Values(&darkTheme(), &lightTheme()),
                         [](const auto& made) { return made.param->name.toStdString(); });

TEST(Theme, TextOverPicturesIsLegibleOnWhite) {
  const Theme& t = pictureTheme();
  const QColor veil = mixed(Qt::white, QColor(pictureVeil().rgb()), pictureVeil().alphaF());
  for (const QColor& text : {t.text, t.muted, t.stale}) EXPECT_GE(contrast(text, veil), 4.5) << nameOf(text);
}

TEST(Theme, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(Qt::black, Qt::white), 21, 1e-6);
  EXPECT_NEAR(contrast(QColor(0x77, 0x77, 0x77), Qt::white), 4.48, 0.01);
}

// Mean lightness of what is drawn.
double lightnessOf(const QImage& image) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (qAlpha(image.pixel(x, y)) > 200) sum += double(image.pixelColor(x, y).lightnessF()), ++count;
  return count > 0 ? sum / count : -1;
}

TEST(Theme, EveryBuiltInIconDrawsInTheColourOfTheTheme) {
  const QStringList names = QDir(s(":/icons")).entryList({s("*.svg")});
  ASSERT_GT(names.size(), 15);
  for (const QString& name : names) {
    const QIcon each = icon(name.chopped(4));
    applyTheme(*qApp, darkTheme());
    const QImage dark = each.pixmap(16, 16).toImage();
    applyTheme(*qApp, lightTheme());
    const QImage light = each.pixmap(16, 16).toImage();
    EXPECT_GT(lightnessOf(dark), 0.5) << name.toStdString();
    EXPECT_LT(lightnessOf(light), 0.5) << name.toStdString();
    EXPECT_GE(lightnessOf(light), 0) << name.toStdString() << " is empty";
  }
  applyTheme(*qApp, darkTheme());
}

TEST(Theme, IconsAreSharpOnScaledDisplays) {
  for (const double scale : {1.0, 1.25, 1.5, 2.0}) {
    const QPixmap pixmap = icon(s("document-open")).pixmap(QSize(16, 16), scale);
    EXPECT_EQ(pixmap.width(), qRound(16 * scale)) << scale;
  }
}

using ThemeWindow = test::StudioTest;

TEST_F(ThemeWindow, TheMenuChangesItAtOnceAndKeepsIt) {
  QSettings().remove(s("theme"));
  const auto choose = [&](const char* text) {
    for (QAction* action : window.findChildren<QAction*>())
      if (action->text() == s(text)) return action->trigger();
    ADD_FAILURE() << text;
  };
  const auto corner = [&] { return window.grab().toImage().pixelColor(4, 40); };
  EXPECT_LT(corner().lightness(), 60);
  choose("&Light");
  test::pass(50);
  EXPECT_EQ(theme().name, s("light"));
  EXPECT_GT(corner().lightness(), 180);
  EXPECT_EQ(QSettings().value(s("theme")).toString(), s("light"));
  choose("&Dark");
  EXPECT_LT(corner().lightness(), 60);
  EXPECT_EQ(QSettings().value(s("theme")).toString(), s("dark"));
}

}  // namespace
}  // namespace prt::ui
