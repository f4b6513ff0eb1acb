#pragma once
// Files that a model names.

#include <filesystem>
#include <optional>
#include <string>

namespace prt {

/// The bytes of a file when it lies in `folder` or below it (symbolic links followed), is a regular file
/// and has at most `limit` bytes; nothing otherwise, or when the folder is empty.
std::optional<std::string> readSideFile(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t limit);

}  // namespace prt
