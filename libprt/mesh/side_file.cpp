#include "libprt/mesh/side_file.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"

#include <algorithm>

namespace prt {

std::optional<std::string> readSideFile(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t limit) {
  if (folder.empty() || name.empty() || name.find('\0') != std::string::npos) return {};
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder, error);
  if (error) return {};
  const std::filesystem::path path = std::filesystem::canonical(root / name, error);
  if (error) return {};
  const auto [rootEnd, pathEnd] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  if (rootEnd != root.end()) return {};
  try {
    const std::vector<std::byte> bytes = readFile(path, limit);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace prt
