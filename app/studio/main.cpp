// prt-studio: opens what it is given, or the built-in default scene.

#include "libprt/core/cpu.h"
#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/screenshot.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/theme.h"

#include <QApplication>
#include <QCommandLineParser>

#include <cstdio>
#include <optional>

namespace {

struct Options {
  QString what = QStringLiteral("scene:default");
  bool resetUi = false;
  QString screenshot;
  QSize size{1440, 900};
};

// Ends the program itself for --help, --version and wrong usage.
Options parse(const QApplication& application) {
  QCommandLineParser parser;
  parser.setApplicationDescription(QStringLiteral("Authors and relights objects whose light transport is baked.\n\nExample: prt-studio bunny.obj"));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(QStringLiteral("INPUT"), QStringLiteral("mesh, project (.prt), recipe (.json), or scene:NAME; without one the default scene"), QStringLiteral("[INPUT]"));
  parser.addOptions({{QStringLiteral("reset-ui"), QStringLiteral("start with the default window layout")},
                     {QStringLiteral("screenshot"), QStringLiteral("bake, write a picture of the window to FILE and end"), QStringLiteral("FILE")},
                     {QStringLiteral("size"), QStringLiteral("size of the window, 1440x900 by default"), QStringLiteral("WxH")}});
  parser.process(application);

  const auto wrong = [](const QString& what) {
    std::fprintf(stderr, "prt-studio: %s (see --help)\n", qPrintable(what));
    std::exit(2);
  };
  Options options;
  if (parser.positionalArguments().size() > 1) wrong(QStringLiteral("one input at most"));
  if (!parser.positionalArguments().isEmpty()) options.what = parser.positionalArguments().first();
  options.resetUi = parser.isSet(QStringLiteral("reset-ui"));
  options.screenshot = parser.value(QStringLiteral("screenshot"));
  if (parser.isSet(QStringLiteral("size"))) {
    const QStringList sides = parser.value(QStringLiteral("size")).split(u'x');
    bool width = false, height = false;
    if (sides.size() == 2) options.size = QSize(sides[0].toInt(&width), sides[1].toInt(&height));
    if (!width || !height || options.size.width() < 640 || options.size.height() < 400 || options.size.width() > 8192 || options.size.height() > 8192)
      wrong(QStringLiteral("--size takes WIDTHxHEIGHT between 640x400 and 8192x8192"));
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  prt::ui::GlCanvas::requestFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("prt-studio"));
  QApplication::setOrganizationName(QStringLiteral("PRT Studio"));
  QApplication::setApplicationVersion(QStringLiteral(PRT_VERSION));
  const Options options = parse(application);
  prt::ui::applyTheme(application, prt::ui::darkTheme());

  prt::ui::Session session;
  // A picture for the docs does not depend on how the window was left.
  const bool picture = !options.screenshot.isEmpty();
  prt::ui::MainWindow window(session, options.resetUi || picture);
  if (picture) window.resize(options.size);
  window.show();
  session.open(options.what);
  if (picture) return prt::ui::takeScreenshot(application, window, session, options.screenshot);
  return QApplication::exec();
}
