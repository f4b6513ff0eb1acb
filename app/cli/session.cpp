#include "app/cli/session.h"

#include "app/cli/progress_bar.h"
#include "libprt/core/log.h"
#include "libprt/core/parallel.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>

namespace prt::cli {

void Session::start() {
  setThreadCount(threads);
  setLogHandler(quiet ? LogLevel::Error : logLevelFromString(logLevel), [](LogLevel level,
                                                                           std::string_view message) {
    fmt::print(stderr, "{}prt: {}: {}\n", isatty(STDERR_FILENO) ? "\r\x1b[K" : "", toString(level), message);
  });
  const bool watched = !quiet && isatty(STDERR_FILENO) != 0;
  job_ = watched ? std::make_unique<Job>(ProgressBar(), 10) : std::make_unique<Job>();
}

void Session::say(const std::string& line) const {
  if (!json && !quiet) fmt::print("{}\n", line);
}

void Session::result(const nlohmann::json& object) const {
  if (json) fmt::print("{}\n", object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

CLI::Validator finite() {
  return {[](const std::string& text) {
            double value = 0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return number ? std::string() : "'" + text + "' is not a finite number";
          },
          "", "finite"};
}

}  // namespace prt::cli
