#include "libprt/project/project_disk.h"

#include "libprt/project/project_schema.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
  return std::error_code(error, std::generic_category()).message();
}

void syncPath(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), flags);
  const int failed = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  if (failed)
    throw FileError("cannot be flushed to disk: " + reason(failed), path.string(), "check the disk");
}

}  // namespace

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

fs::path savingFile(const fs::path& file) {
  return file.string() + ".saving";
}

std::unique_ptr<Database> openChecked(const fs::path& file, Database::Mode mode) {
  auto database = std::make_unique<Database>(file, mode);
  database->execute("PRAGMA cell_size_check = ON");
  checkSchema(*database);
  return database;
}

std::string checksumIn(Database& database) {
  return readProjectRow(database).checksum;
}

void syncFile(const fs::path& file) {
  syncPath(file, O_RDONLY);
}

void replaceFile(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0)
    throw FileError("cannot be replaced: " + reason(errno), to.string(),
                    "check its permissions and those of its folder");
}

void syncFolderOf(const fs::path& file) {
  syncPath(folderOf(file), O_RDONLY | O_DIRECTORY);
}

}  // namespace prt
