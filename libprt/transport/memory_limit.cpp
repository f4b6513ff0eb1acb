#include "libprt/transport/memory_limit.h"

#include "libprt/core/error.h"

#include <fstream>
#include <sstream>

namespace prt {
namespace {

/// Bytes that new allocations can have without swapping; 0 when the system does not tell.
std::size_t availableMemory() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    std::size_t kilobytes = 0;
    if (words >> name >> kilobytes && name == "MemAvailable:") return kilobytes * 1024;
  }
  return 0;
}

std::string inMegabytes(std::size_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

}  // namespace

void requireMemory(std::size_t bytes, const std::string& what, const std::string& fix) {
  const std::size_t available = availableMemory();
  if (available != 0 && bytes > available)
    throw ResourceError("needs " + inMegabytes(bytes) + " of memory, " + inMegabytes(available) + " are free",
                        what, fix);
}

}  // namespace prt
