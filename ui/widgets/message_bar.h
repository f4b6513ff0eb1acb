#pragma once
// A message where it arose: what happened, where, what to do; stays until it is dismissed or replaced.

#include "ui/model/log.h"

#include <QFrame>

class QLabel;

namespace prt::ui {

class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void show(Severity severity, const QString& text);
  QString text() const;

 private:
  QLabel* icon_;
  QLabel* text_;
};

}  // namespace prt::ui
