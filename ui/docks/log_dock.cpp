#include "ui/docks/log_dock.h"

#include "ui/widgets/theme.h"

#include <QEvent>

namespace prt::ui {

LogDock::LogDock(Log& log, QWidget* parent) : QPlainTextEdit(parent), log_(log) {
  setReadOnly(true);
  setFrameShape(QFrame::NoFrame);
  setMaximumBlockCount(1000);
  showAll();
  connect(&log, &Log::added, this, &LogDock::append);
}

void LogDock::showAll() {
  clear();
  for (const LogEntry& entry : log_.entries()) append(entry);
}

// The colours are in the text: another theme writes it anew.
void LogDock::changeEvent(QEvent* event) {
  QPlainTextEdit::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) showAll();
}

void LogDock::append(const LogEntry& entry) {
  const Theme& t = theme();
  const QColor color =
      entry.severity == Severity::Error ? t.failed : (entry.severity == Severity::Warning ? t.stale : t.text);
  const QString time = entry.time.isValid() ? entry.time.toString(QStringLiteral("HH:mm:ss")) : QString();
  appendHtml(QStringLiteral("<span style='color:%1'>%2</span>&nbsp; <span style='color:%3'>%4</span>")
                 .arg(t.muted.name(), time, color.name(), entry.text.toHtmlEscaped()));
}

}  // namespace prt::ui
