// prt-studio: opens what it is given, or the built-in default scene.

#include "ui/bench.h"
#include "ui/main_window.h"
#include "ui/model/error_estimate.h"
#include "ui/model/session.h"
#include "ui/screenshot.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/theme.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QSettings>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>

namespace {

struct Options {
  QString what = QStringLiteral("scene:default");
  bool resetUi = false;
  QString theme;  // empty: as it was last time
  prt::ui::ScreenshotOptions screenshot;
  prt::ui::ErrorShown errors = prt::ui::ErrorShown::Off;
  QSize size{1440, 900};
  bool bench = false;
  bool benchCharts = false;
  int frames = 90;
};

// Ends the program itself for --help, --version and wrong usage.
Options parse(const QApplication& application) {
  QCommandLineParser parser;
  parser.setApplicationDescription(QStringLiteral(
      "Authors and relights objects whose light transport is baked.\n\nExample: prt-studio bunny.obj"));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(
      QStringLiteral("INPUT"),
      QStringLiteral("mesh, project (.prt), recipe (.json), or scene:NAME; without one the default scene"),
      QStringLiteral("[INPUT]"));
  parser.addOptions(
      {{QStringLiteral("reset-ui"), QStringLiteral("start with the default window layout")},
       {QStringLiteral("screenshot"), QStringLiteral("bake, write a picture of the window to FILE and end"),
        QStringLiteral("FILE")},
       {QStringLiteral("dock"),
        QStringLiteral("dock that the picture shows in front: scene, light, jobs ..."),
        QStringLiteral("NAME")},
       {QStringLiteral("auto-cut"),
        QStringLiteral("cut charts before the picture is taken; with --dock charts")},
       {QStringLiteral("show"),
        QStringLiteral(
            "what the picture shows on the model: field, wishes, layers or ids; with --dock synthesis"),
        QStringLiteral("NAME")},
       {QStringLiteral("sheet"), QStringLiteral("what the picture shows over the window: palette or keys"),
        QStringLiteral("NAME")},
       {QStringLiteral("errors"),
        QStringLiteral("lay an error over the surface: total, noise, interpolation or truncation"),
        QStringLiteral("NAME")},
       {QStringLiteral("theme"), QStringLiteral("dark or light; kept when chosen from the menu"),
        QStringLiteral("NAME")},
       {QStringLiteral("size"), QStringLiteral("size of the window, 1440x900 by default"),
        QStringLiteral("WxH")},
       {QStringLiteral("bench"),
        QStringLiteral("measure how fast the window follows the hand, print it as JSON and end")},
       {QStringLiteral("bench-charts"),
        QStringLiteral("the same of cutting charts and dragging their corners")},
       {QStringLiteral("frames"), QStringLiteral("of each part of the bench, 90 by default"),
        QStringLiteral("N"), QStringLiteral("90")}});
  parser.process(application);

  const auto wrong = [](const QString& what) {
    std::fprintf(stderr, "prt-studio: %s (see --help)\n", qPrintable(what));
    std::exit(2);
  };
  Options options;
  if (parser.positionalArguments().size() > 1) wrong(QStringLiteral("one input at most"));
  if (!parser.positionalArguments().isEmpty()) options.what = parser.positionalArguments().first();
  options.resetUi = parser.isSet(QStringLiteral("reset-ui"));
  options.screenshot.file = parser.value(QStringLiteral("screenshot"));
  options.screenshot.dock = parser.value(QStringLiteral("dock"));
  options.screenshot.autoCut = parser.isSet(QStringLiteral("auto-cut"));
  options.screenshot.shown = parser.value(QStringLiteral("show"));
  if (parser.isSet(QStringLiteral("show")) && options.screenshot.shown != u"field" &&
      options.screenshot.shown != u"wishes" && options.screenshot.shown != u"layers" &&
      options.screenshot.shown != u"ids")
    wrong(QStringLiteral("--show takes field, wishes, layers or ids"));
  options.screenshot.sheet = parser.value(QStringLiteral("sheet"));
  if (parser.isSet(QStringLiteral("sheet")) && options.screenshot.sheet != u"palette" &&
      options.screenshot.sheet != u"keys")
    wrong(QStringLiteral("--sheet takes palette or keys"));
  options.theme = parser.value(QStringLiteral("theme"));
  if (parser.isSet(QStringLiteral("theme")) && !prt::ui::themeNamed(options.theme))
    wrong(QStringLiteral("--theme takes dark or light"));
  options.benchCharts = parser.isSet(QStringLiteral("bench-charts"));
  options.bench = options.benchCharts || parser.isSet(QStringLiteral("bench"));
  options.frames = parser.value(QStringLiteral("frames")).toInt();
  if (options.frames < 1 || options.frames > 100000)
    wrong(QStringLiteral("--frames takes a number from 1 to 100000"));
  if (parser.isSet(QStringLiteral("errors"))) {
    const QStringList names{QStringLiteral("total"), QStringLiteral("noise"), QStringLiteral("interpolation"),
                            QStringLiteral("truncation")};
    const auto index = names.indexOf(parser.value(QStringLiteral("errors")));
    if (index < 0) wrong(QStringLiteral("--errors takes ") + names.join(QStringLiteral(", ")));
    options.errors = prt::ui::ErrorShown(int(prt::ui::ErrorShown::Total) + int(index));
  }
  if (parser.isSet(QStringLiteral("size"))) {
    const QStringList sides = parser.value(QStringLiteral("size")).split(u'x');
    bool width = false, height = false;
    if (sides.size() == 2) options.size = QSize(sides[0].toInt(&width), sides[1].toInt(&height));
    if (!width || !height || options.size.width() < 640 || options.size.height() < 400 ||
        options.size.width() > 8192 || options.size.height() > 8192)
      wrong(QStringLiteral("--size takes WIDTHxHEIGHT between 640x400 and 8192x8192"));
  }
  return options;
}

// A picture for the docs does not depend on how the window was left.
const prt::ui::Theme& themeOf(const Options& options) {
  using namespace prt::ui;
  const bool kept = options.theme.isEmpty() && options.screenshot.file.isEmpty();
  const Theme* chosen =
      themeNamed(kept ? QSettings().value(QStringLiteral("theme")).toString() : options.theme);
  return chosen ? *chosen : darkTheme();
}

bool asksForHelp(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](std::string_view argument) {
    return argument == "-h" || argument == "--help" || argument == "--help-all" || argument == "-v" ||
           argument == "--version";
  });
}

// Help needs no display; all else does. Qt would end the program with a page about its plugins.
void lookForDisplay(int argc, char** argv) {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
    if (!qEnvironmentVariableIsEmpty(name)) return;
  if (asksForHelp(argc, argv)) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
  } else {
    std::fputs(
        "prt-studio: there is no display; start it in a desktop session, or use prt, the command line\n",
        stderr);
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
#ifdef Q_OS_LINUX
  lookForDisplay(argc, argv);
#endif
  prt::ui::GlCanvas::requestFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("prt-studio"));
  QApplication::setOrganizationName(QStringLiteral("PRT Studio"));
  QApplication::setApplicationVersion(QStringLiteral(PRT_VERSION));
  const Options options = parse(application);
  QApplication::setDesktopFileName(QStringLiteral("prt-studio"));
  QApplication::setWindowIcon(prt::ui::applicationIcon());
  prt::ui::applyTheme(application, themeOf(options));

  prt::ui::Session session;
  const bool picture = !options.screenshot.file.isEmpty();
  prt::ui::MainWindow window(session, options.resetUi || picture || options.bench);
  if (!options.screenshot.dock.isEmpty() && !window.dockNames().contains(options.screenshot.dock)) {
    std::fprintf(stderr, "prt-studio: there is no dock '%s'; there are %s\n",
                 qPrintable(options.screenshot.dock),
                 qPrintable(window.dockNames().join(QStringLiteral(", "))));
    return 2;
  }
  if (picture) window.resize(options.size);
  window.show();
  if (options.bench)
    return prt::ui::runBench(window, session, {options.what, options.frames, options.benchCharts});
  session.open(options.what);
  session.errors().show(options.errors);
  if (picture) return prt::ui::takeScreenshot(application, window, session, options.screenshot);
  window.offerRecovery();
  return QApplication::exec();
}
