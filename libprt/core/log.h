#pragma once
// Messages for the person at the program: what was repaired, assumed or skipped. Not for errors that stop a
// task (those are exceptions) and not for progress (that is Job's). By default warnings and worse go to
// stderr, one line each; a program that shows them elsewhere sets a handler.

#include <functional>
#include <string>
#include <string_view>

namespace prt {

enum class LogLevel { Debug, Info, Warning, Error, Off };

/// Gets messages of at least the level it was set with; called from any thread, one call at a time. Must not
/// throw and must not log.
using LogHandler = std::function<void(LogLevel, std::string_view message)>;

/// Replaces the handler; an empty one restores the default (stderr).
void setLogHandler(LogLevel least, LogHandler handler);
/// Changes what is let through, keeping the handler.
void setLogLevel(LogLevel least);
LogLevel logLevel();

/// "debug", "info", "warning", "error", "off"; the other way throws ValueError.
std::string toString(LogLevel level);
LogLevel logLevelFromString(const std::string& name);

/// Passes one message on; line breaks become spaces.
void log(LogLevel level, std::string_view message);
inline void logDebug(std::string_view message) {
  log(LogLevel::Debug, message);
}
inline void logInfo(std::string_view message) {
  log(LogLevel::Info, message);
}
inline void logWarning(std::string_view message) {
  log(LogLevel::Warning, message);
}
inline void logError(std::string_view message) {
  log(LogLevel::Error, message);
}

}  // namespace prt
