#include "libprt/core/error.h"

#include <utility>

namespace prt {
namespace {

std::string oneLine(const std::string& what, const std::string& where, const std::string& fix) {
  std::string line = where.empty() ? what : where + ": " + what;
  if (!fix.empty()) line += " (" + fix + ")";
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return line;
}

}  // namespace

Error::Error(std::string what, std::string where, std::string fix)
    : std::runtime_error(oneLine(what, where, fix)),
      what_(std::move(what)),
      where_(std::move(where)),
      fix_(std::move(fix)) {}

}  // namespace prt
