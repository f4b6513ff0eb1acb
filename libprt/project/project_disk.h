#pragma once
// What project files ask of the disk. Internal to project/.

#include "libprt/project/sqlite.h"

#include <filesystem>
#include <memory>
#include <string>

namespace prt {

/// The folder that a file lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& file);

/// Where a project is written that is to replace this one.
std::filesystem::path savingFile(const std::filesystem::path& file);

/// Opens a database that is ours, or throws.
std::unique_ptr<Database> openChecked(const std::filesystem::path& file, Database::Mode mode);
/// The checksum in its project row.
std::string checksumIn(Database& database);

/// Brings a file's contents to the disk. Throws FileError.
void syncFile(const std::filesystem::path& file);
/// Renames a file over another. Throws FileError, and has done nothing then.
void replaceFile(const std::filesystem::path& from, const std::filesystem::path& to);
/// Makes what was renamed in a file's folder outlive a power cut. Throws FileError.
void syncFolderOf(const std::filesystem::path& file);

}  // namespace prt
