#pragma once
// What happened, for the log dock: one line each, newest last.

#include <QObject>
#include <QString>
#include <QTime>

#include <deque>

namespace prt::ui {

enum class Severity { Info, Warning, Error };

struct LogEntry {
  QTime time;
  Severity severity = Severity::Info;
  QString text;
};

class Log : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  const std::deque<LogEntry>& entries() const { return entries_; }
  /// Entries from now on without the time, for pictures that are the same each time.
  void setTimeless(bool timeless) { timeless_ = timeless; }
  void add(Severity severity, const QString& text) {
    entries_.push_back({timeless_ ? QTime() : QTime::currentTime(), severity, text});
    if (entries_.size() > kKept) entries_.pop_front();
    Q_EMIT added(entries_.back());
  }

 Q_SIGNALS:
  void added(const LogEntry& entry);

 private:
  static constexpr std::size_t kKept = 1000;
  std::deque<LogEntry> entries_;
  bool timeless_ = false;
};

}  // namespace prt::ui
