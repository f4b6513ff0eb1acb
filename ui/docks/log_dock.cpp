#include "ui/docks/log_dock.h"

#include "ui/widgets/theme.h"

namespace prt::ui {

LogDock::LogDock(Log& log, QWidget* parent) : QPlainTextEdit(parent) {
  setReadOnly(true);
  setFrameShape(QFrame::NoFrame);
  setMaximumBlockCount(1000);
  for (const LogEntry& entry : log.entries()) append(entry);
  connect(&log, &Log::added, this, &LogDock::append);
}

void LogDock::append(const LogEntry& entry) {
  const Theme& t = theme();
  const QColor color = entry.severity == Severity::Error ? t.failed : (entry.severity == Severity::Warning ? t.stale : t.text);
  appendHtml(QStringLiteral("<span style='color:%1'>%2</span>&nbsp; <span style='color:%3'>%4</span>")
                 .arg(t.muted.name(), entry.time.toString(QStringLiteral("HH:mm:ss")), color.name(),
                      entry.text.toHtmlEscaped()));
}

}  // namespace prt::ui
