#pragma once
// A hand on the mouse: presses, moves and releases go through the window, as the window system sends them.

#include <QCoreApplication>
#include <QMouseEvent>
#include <QTest>
#include <QWidget>
#include <QWindow>

namespace prt::test {

class Pointer {
 public:
  /// All places are those of `widget`, which is shown; what was just added to it is laid out first.
  explicit Pointer(QWidget* widget) : widget_(widget) { QTest::qWait(20); }

  void press(const QPointF& at, Qt::KeyboardModifiers modifiers = {}) {
    buttons_ = Qt::LeftButton;
    send(QEvent::MouseButtonPress, at, Qt::LeftButton, modifiers);
  }
  void move(const QPointF& at, Qt::KeyboardModifiers modifiers = {}) {
    send(QEvent::MouseMove, at, Qt::NoButton, modifiers);
    QCoreApplication::processEvents();
  }
  void release(const QPointF& at, Qt::KeyboardModifiers modifiers = {}) {
    buttons_ = Qt::NoButton;
    send(QEvent::MouseButtonRelease, at, Qt::LeftButton, modifiers);
  }
  void click(const QPointF& at) {
    press(at);
    release(at);
  }
  void doubleClick(const QPointF& at) {
    click(at);
    buttons_ = Qt::LeftButton;
    send(QEvent::MouseButtonDblClick, at, Qt::LeftButton, {});
    release(at);
  }
  void drag(const QPointF& from, const QPointF& to, Qt::KeyboardModifiers modifiers = {}) {
    press(from, modifiers);
    for (int step = 1; step <= 4; ++step) move(from + (to - from) * step / 4.0, modifiers);
    release(to, modifiers);
  }

 private:
  void send(QEvent::Type type, const QPointF& at, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
    QWidget* top = widget_->window();
    const QPointF inWindow = widget_->mapTo(top, QPoint(0, 0)) + at;
    QMouseEvent event(type, inWindow, top->windowHandle()->mapToGlobal(inWindow), button, buttons_,
                      modifiers);
    QCoreApplication::sendEvent(top->windowHandle(), &event);
  }

  QWidget* widget_;
  Qt::MouseButtons buttons_ = Qt::NoButton;
};

}  // namespace prt::test
