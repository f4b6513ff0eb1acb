#include "app/cli/progress_bar.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace prt::cli {
namespace {

int terminalWidth() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string scaled(double value, double step, const char* const* prefixes, int count) {
  int i = 0;
  while (std::abs(value) >= step && i + 1 < count) value /= step, ++i;
  const int decimals = i == 0 ? 0 : value < 10 ? 2 : value < 100 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, prefixes[i]);
}

}  // namespace

std::string shortNumber(double value) {
  static const char* const prefixes[] = {"", "k", "M", "G", "T"};
  std::string text = scaled(value, 1000, prefixes, 5);
  if (text.back() == ' ') text.pop_back();
  return text;
}

std::string byteCount(double bytes) {
  static const char* const prefixes[] = {"bytes", "KB", "MB", "GB", "TB"};
  return scaled(bytes, 1024, prefixes, 5);
}

std::string shortTime(double seconds) {
  const auto s = long(std::ceil(seconds));
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

std::string progressLine(const Progress& p, int width) {
  std::string tail;
  if (p.total > 0) tail += fmt::format(" {:3.0f} %", 100 * std::min(1.0, p.fraction()));
  if (p.seconds > 0.5 && p.done > 0 && !p.unit.empty()) {
    const std::string rate = p.unit == "bytes" ? byteCount(p.rate()) : shortNumber(p.rate()) + " " + p.unit;
    tail += "  " + rate + "/s";
  }
  if (p.seconds > 0.5 && p.secondsLeft() >= 0) tail += "  " + shortTime(p.secondsLeft()) + " left";
  const int room = std::min(30, width - int(p.phase.size() + tail.size()) - 5);
  std::string bar;
  if (room >= 5 && p.total > 0) {
    const int full = std::clamp(int(p.fraction() * room), 0, room);
    bar = "  [" + std::string(std::size_t(full), '#') + std::string(std::size_t(room - full), '-') + "]";
  }
  return (p.phase + bar + tail).substr(0, std::size_t(std::max(0, width)));
}

void ProgressBar::operator()(const Progress& progress) const {
  const bool over = progress.total > 0 && progress.done >= progress.total;
  const std::string line = over ? "" : progressLine(progress, terminalWidth() - 1);
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
}

}  // namespace prt::cli
