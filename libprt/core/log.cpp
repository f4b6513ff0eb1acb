#include "libprt/core/log.h"

#include "libprt/core/error.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

namespace prt {
namespace {

constexpr std::array<const char*, 5> kNames{"debug", "info", "warning", "error", "off"};

struct State {
  std::mutex mutex;  // one message at a time
  std::atomic<LogLevel> least{LogLevel::Warning};
  LogHandler handler;
  std::shared_ptr<spdlog::logger> standard;
};

State& state() {
  static State instance;
  return instance;
}

void toStderr(State& s, LogLevel level, std::string_view message) {
  if (!s.standard) {
    s.standard =
        std::make_shared<spdlog::logger>("prt", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    s.standard->set_pattern("prt: %^%l%$: %v");
    s.standard->set_level(spdlog::level::trace);
  }
  constexpr std::array kLevels{spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                               spdlog::level::err};
  s.standard->log(kLevels[std::size_t(level)], spdlog::string_view_t(message.data(), message.size()));
}

}  // namespace

void setLogHandler(LogLevel least, LogHandler handler) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  s.least = least;
  s.handler = std::move(handler);
}

void setLogLevel(LogLevel least) {
  state().least = least;
}
LogLevel logLevel() {
  return state().least;
}

std::string toString(LogLevel level) {
  return kNames[std::size_t(level)];
}

LogLevel logLevelFromString(const std::string& name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return LogLevel(i);
  throw ValueError("unknown log level '" + name + "'", "log", "use debug, info, warning, error or off");
}

void log(LogLevel level, std::string_view message) {
  State& s = state();
  if (level < s.least.load(std::memory_order_relaxed) || level >= LogLevel::Off) return;
  std::string line(message);
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  const std::lock_guard lock(s.mutex);
  if (s.handler)
    s.handler(level, line);
  else
    toStderr(s, level, line);
}

}  // namespace prt
