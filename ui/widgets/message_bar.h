#pragma once
// A message where it arose: what happened, where, what to do; stays until it is dismissed or replaced.

#include "ui/model/log.h"

#include <QFrame>

#include <functional>

class QLabel;
class QPushButton;

namespace prt::ui {

class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void show(Severity severity, const QString& text);
  /// Adds the fix as a button to what is shown; the bar goes away when it is pressed.
  void offer(const QString& label, std::function<void()> fix);
  QString text() const;

 private:
  QLabel* icon_;
  QLabel* text_;
  QPushButton* fix_;
  std::function<void()> run_;
};

}  // namespace prt::ui
