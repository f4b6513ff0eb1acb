#pragma once
// Whole files into memory, and the files beside them that they name.

#include "libprt/core/job.h"

#include <filesystem>
#include <optional>
#include <string>

namespace prt {

/// The bytes of a regular file below 4 GiB. Throws FileError.
std::string readFileBytes(const std::filesystem::path& path, Job& job);

/// The bytes of a file that a model names, when it lies in `folder` or below it (symbolic links followed),
/// is a regular file and has at most `limit` bytes; nothing otherwise, or when the folder is empty.
std::optional<std::string> readSideFile(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t limit);

}  // namespace prt
