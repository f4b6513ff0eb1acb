#pragma once
// What happened, newest at the bottom.

#include "ui/model/log.h"

#include <QPlainTextEdit>

namespace prt::ui {

class LogDock : public QPlainTextEdit {
  Q_OBJECT
 public:
  explicit LogDock(Log& log, QWidget* parent = nullptr);

 private:
  void append(const LogEntry& entry);
};

}  // namespace prt::ui
