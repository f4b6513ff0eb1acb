#include "libprt/core/memory.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

namespace prt {
namespace {

namespace fs = std::filesystem;

/// The number after `key` in a file of "key number" lines; with an empty key, the file's first number.
std::optional<std::uint64_t> numberIn(const fs::path& path, const std::string& key) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  if (key.empty()) return file >> value ? std::optional(value) : std::nullopt;
  for (std::string word; file >> word;)
    if (word == key && file >> value) return value;
  return {};
}

/// What a control group (version 2) and those around it leave; pages that only cache files can be dropped.
std::uint64_t leftByControlGroups() {
  std::uint64_t left = std::numeric_limits<std::uint64_t>::max();
  std::ifstream own("/proc/self/cgroup");
  std::string line;
  while (std::getline(own, line) && !line.starts_with("0::")) {
  }
  if (!line.starts_with("0::/")) return left;
  const fs::path root = "/sys/fs/cgroup";
  for (fs::path group = root / line.substr(4);; group = group.parent_path()) {
    const auto limit = numberIn(group / "memory.max", ""), used = numberIn(group / "memory.current", "");
    if (limit && used) {
      const std::uint64_t kept =
          *used - std::min(*used, numberIn(group / "memory.stat", "inactive_file").value_or(0));
      left = std::min(left, *limit - std::min(*limit, kept));
    }
    if (group.string().size() <= root.string().size()) return left;
  }
}

std::string gigabytes(std::size_t bytes) {
  std::array<char, 32> text;
  const double value = double(bytes);
  if (value >= 1e8)
    std::snprintf(text.data(), text.size(), "%.1f GB", value / 1e9);
  else
    std::snprintf(text.data(), text.size(), "%.1f MB", value / 1e6);
  return text.data();
}

}  // namespace

std::size_t availableMemory() {
  const std::uint64_t machine = numberIn("/proc/meminfo", "MemAvailable:").value_or(std::uint64_t(4) << 20)
                                << 10;
  return std::size_t(std::min(machine, leftByControlGroups()));
}

void requireMemory(std::size_t bytes, const std::string& what, const std::string& fix) {
  const std::size_t available = availableMemory();
  if (bytes <= available) return;
  throw ResourceError(
      what + " needs " + gigabytes(bytes) + " of memory, " + gigabytes(available) + " are available", "",
      fix);
}

}  // namespace prt
