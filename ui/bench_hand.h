#pragma once
// A hand for benches: sends mouse events to the studio's window and waits for what they do.

#include <QEvent>
#include <QPoint>
#include <QString>

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>

class QWidget;

namespace prt::ui {

class MainWindow;
class Session;

class BenchHand {
 public:
  /// From here on an error that the session reports ends the wait that it happens in.
  BenchHand(MainWindow& window, Session& session);

  MainWindow& window() { return window_; }
  Session& session() { return session_; }

  /// Lets events happen until it is done. Throws ResourceError when the session reports an error, or after
  /// `seconds`.
  void waitFor(const std::function<bool()>& done, double seconds = kPatience);
  /// Lets events happen for a while.
  void pass(double milliseconds);

  void send(QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);
  /// Left button, in the middle.
  void click(const QWidget& widget);

  /// One edit of the recipe.
  void edit(std::initializer_list<std::pair<const char*, std::string>> values);

 private:
  static constexpr double kPatience = 300;  // seconds for anything to be read or baked

  MainWindow& window_;
  Session& session_;
  QString problem_;
};

}  // namespace prt::ui
