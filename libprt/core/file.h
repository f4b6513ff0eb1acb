#pragma once
// Whole files: read with a limit, written so that nothing half-written is ever left behind. Every writer
// of libprt goes through AtomicFile. All throw FileError with the path.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace prt {

class Job;

/// Contents of a file. Throws FileError when it is missing, a folder, unreadable, or larger than `maxBytes`.
/// A job, when given, can cancel a long read.
std::vector<std::byte> readFile(const std::filesystem::path& path,
                                std::size_t maxBytes = std::size_t(4) << 30, Job* job = nullptr);

/// Replaces a file in one step: write to path(), which lies beside the target, then commit(). Until then,
/// and whatever happens before, the target stays as it was; without commit() the temporary file is removed.
/// A link is followed: what it points to is replaced.
class AtomicFile {
 public:
  /// Throws FileError when the target's folder does not exist or cannot be written to, or the target is
  /// something else than a regular file.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  /// Brings the data to the disk and puts the file in its place.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
};

void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

}  // namespace prt
