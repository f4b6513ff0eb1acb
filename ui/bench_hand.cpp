#include "ui/bench_hand.h"

#include "libprt/core/error.h"
#include "ui/main_window.h"
#include "ui/model/session.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <QTimer>
#include <QWindow>

namespace prt::ui {

namespace {
constexpr int kWakeMilliseconds = 2;
}

BenchHand::BenchHand(MainWindow& window, Session& session) : window_(window), session_(session) {
  QObject::connect(&session, &Session::message, &window,
                   [this](Severity severity, const QString& text, Place) {
                     if (severity == Severity::Error && problem_.isEmpty()) problem_ = text;
                   });
}

void BenchHand::waitFor(const std::function<bool()>& done, double seconds) {
  QElapsedTimer timer;
  timer.start();
  QTimer awake;  // what is waited for may come without an event
  awake.start(kWakeMilliseconds);
  while (!done()) {
    if (!problem_.isEmpty()) throw ResourceError(problem_.toStdString(), "bench", {});
    if (double(timer.elapsed()) > 1000 * seconds)
      throw ResourceError("what was waited for did not come in " + std::to_string(int(seconds)) + " seconds",
                          "bench", "use a smaller scene");
    // Without a time: with one it would not wait but spin, and take a core from the work that is waited for.
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }
}

void BenchHand::pass(double milliseconds) {
  QElapsedTimer timer;
  timer.start();
  waitFor([&] { return double(timer.elapsed()) >= milliseconds; });
}

void BenchHand::send(QEvent::Type type, const QPoint& at, Qt::MouseButton button,
                     Qt::KeyboardModifiers modifiers) {
  QWindow* handle = window_.windowHandle();
  const bool move = type == QEvent::MouseMove, release = type == QEvent::MouseButtonRelease;
  QMouseEvent event(type, at, handle->mapToGlobal(QPointF(at)), move ? Qt::NoButton : button,
                    release ? Qt::NoButton : Qt::MouseButtons(button), modifiers);
  QCoreApplication::sendEvent(handle, &event);
}

void BenchHand::click(const QWidget& widget) {
  const QPoint at = widget.mapTo(&window_, widget.rect().center());
  send(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::NoModifier);
  send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoModifier);
}

void BenchHand::edit(std::initializer_list<std::pair<const char*, std::string>> values) {
  Recipe next = session_.document().recipe();
  for (const auto& [path, value] : values) setByPath(next, path, value);
  session_.document().edit(QStringLiteral("Bench"), next);
}

}  // namespace prt::ui
