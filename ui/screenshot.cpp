#include "ui/screenshot.h"

#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"

#include <QApplication>
#include <QTimer>

#include <cstdio>

namespace prt::ui {

namespace {
constexpr int kPollMilliseconds = 50;
constexpr int kSettleMilliseconds = 400;  // the last frame, with smooth edges
}  // namespace

int takeScreenshot(QApplication& application, MainWindow& window, Session& session, const QString& file) {
  QString problem;
  QObject::connect(&session, &Session::message, &window, [&](Severity severity, const QString& text, Place) {
    if (severity == Severity::Error && problem.isEmpty()) problem = text;
  });
  QTimer poll;
  QObject::connect(&poll, &QTimer::timeout, &window, [&] {
    if (problem.isEmpty() && !session.settled()) return;
    poll.stop();
    QTimer::singleShot(kSettleMilliseconds, &window, [&] { QApplication::exit(problem.isEmpty() ? 0 : 1); });
  });
  poll.start(kPollMilliseconds);
  application.exec();
  if (problem.isEmpty() && !window.grab().save(file)) problem = QStringLiteral("%1: cannot be written").arg(file);
  if (problem.isEmpty()) return 0;
  std::fprintf(stderr, "prt-studio: %s\n", qPrintable(problem));
  return 1;
}

}  // namespace prt::ui
