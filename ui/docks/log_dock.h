#pragma once
// What happened, newest at the bottom.

#include "ui/model/log.h"

#include <QPlainTextEdit>

namespace prt::ui {

class LogDock : public QPlainTextEdit {
  Q_OBJECT
 public:
  explicit LogDock(Log& log, QWidget* parent = nullptr);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void showAll();
  void append(const LogEntry& entry);

  Log& log_;
};

}  // namespace prt::ui
