#include "libprt/project/backups.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr int kMost = 99;  // whatever is asked for, the search for old ones ends

}  // namespace

fs::path backupFile(const fs::path& project, int n) {
  return project.parent_path() /
         (project.stem().string() + ".backup" + std::to_string(n) + project.extension().string());
}

void keepBackup(const fs::path& project, int count) {
  std::error_code error;
  for (int n = kMost; n > std::max(count, 0); --n) fs::remove(backupFile(project, n), error);
  if (count <= 0 || !fs::exists(project, error)) return;
  if (fs::equivalent(project, backupFile(project, 1), error)) return;
  // From the oldest on: whenever this is interrupted, every save is still there under some name.
  for (int n = std::min(count, kMost); n > 1; --n)
    if (fs::exists(backupFile(project, n - 1), error))
      fs::rename(backupFile(project, n - 1), backupFile(project, n), error);
  fs::create_hard_link(project, backupFile(project, 1), error);
  if (error) fs::copy_file(project, backupFile(project, 1), error);  // a file system without links
}

std::vector<fs::path> backupsOf(const fs::path& project) {
  std::vector<fs::path> found;
  std::error_code error;
  for (int n = 1; n <= kMost; ++n)
    if (fs::exists(backupFile(project, n), error)) found.push_back(backupFile(project, n));
  return found;
}

}  // namespace prt
