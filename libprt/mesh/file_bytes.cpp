#include "libprt/mesh/file_bytes.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace prt {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLimit = (std::size_t{1} << 32) - 1;  // indices into a file's elements fit 32 bits
constexpr std::size_t kChunk = std::size_t{8} << 20;

}  // namespace

std::string readFileBytes(const fs::path& path, Job& job) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FileError("there is no such file", path.string(), "check the path");
  if (!fs::is_regular_file(status)) throw FileError("is not a file", path.string(), "check the path");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw FileError("cannot be read: " + error.message(), path.string(), "check its permissions");
  if (size > kLimit) throw FileError("is larger than 4 GiB", path.string(), "split or simplify the mesh");

  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(std::string("cannot be opened: ") + std::strerror(errno), path.string(), "check its permissions");
  job.begin("read", double(size), "bytes");
  std::string bytes;
  bytes.resize(std::size_t(size));
  for (std::size_t at = 0; at < bytes.size();) {
    job.checkCancelled();
    const std::size_t count = std::min(kChunk, bytes.size() - at);
    file.read(bytes.data() + at, std::streamsize(count));
    at += std::size_t(file.gcount());
    job.advance(double(file.gcount()));
    if (std::size_t(file.gcount()) < count) throw FileError("ends too early while it is read", path.string(), "copy it again");
  }
  return bytes;
}

std::optional<std::string> readSideFile(const fs::path& folder, const std::string& name, std::size_t limit) {
  if (folder.empty() || name.empty() || name.find('\0') != std::string::npos) return {};
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return {};
  const fs::path path = fs::canonical(root / name, error);
  if (error || !fs::is_regular_file(path, error)) return {};
  const auto [rootEnd, pathEnd] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  if (rootEnd != root.end()) return {};
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > limit) return {};
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::size_t(size), '\0');
  file.read(bytes.data(), std::streamsize(size));
  if (std::uintmax_t(file.gcount()) != size) return {};
  return bytes;
}

}  // namespace prt
