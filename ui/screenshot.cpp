#include "ui/screenshot.h"

#include "ui/main_window.h"
#include "ui/model/chart_editor.h"
#include "ui/model/field_editor.h"
#include "ui/model/id_view.h"
#include "ui/model/layer_editor.h"
#include "ui/model/session.h"
#include "ui/model/wish_editor.h"
#include "ui/viewport/viewport.h"
#include "ui/window/command_palette.h"
#include "ui/window/keys_overlay.h"

#include <QApplication>
#include <QTimer>

#include <cstdio>

namespace prt::ui {

namespace {
constexpr int kPollMilliseconds = 50;
constexpr int kCalm = 4;  // polls in a row with nothing left to do: layouts and queued signals have settled
}  // namespace

int takeScreenshot(QApplication& application, MainWindow& window, Session& session,
                   const ScreenshotOptions& options) {
  QString problem;
  QObject::connect(&session, &Session::message, &window, [&](Severity severity, const QString& text, Place) {
    if (severity == Severity::Error && problem.isEmpty()) problem = text;
  });
  window.setPictureMode(true);
  if (!options.dock.isEmpty()) window.bringToFront(options.dock);
  session.field().setShown(options.shown == u"field");
  session.wishes().setShown(options.shown == u"wishes");
  session.patchLayers().setShown(options.shown == u"layers");
  session.ids().setShown(options.shown == u"ids");
  QTimer poll;
  int calm = 0;
  bool cut = !options.autoCut;
  QObject::connect(&poll, &QTimer::timeout, &window, [&] {
    if (!cut && session.charts().ready() && session.charts().settled()) {
      cut = true;
      session.charts().autoCut();
    }
    const bool done = cut && session.field().settled() && session.wishes().settled() &&
                      session.patchLayers().settled() && session.settled() && session.bakes().fresh() &&
                      window.viewport().canvas().settled();
    calm = done ? calm + 1 : 0;
    if (calm >= kCalm || !problem.isEmpty()) QApplication::exit();
  });
  poll.start(kPollMilliseconds);
  application.exec();
  if (options.sheet == u"palette") window.commandPalette().open();
  if (options.sheet == u"keys") window.keys().open();
  if (problem.isEmpty() && !window.grab().save(options.file))
    problem = QStringLiteral("%1: cannot be written").arg(options.file);
  if (problem.isEmpty()) return 0;
  std::fprintf(stderr, "prt-studio: %s\n", qPrintable(problem));
  return 1;
}

}  // namespace prt::ui
