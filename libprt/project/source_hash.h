#pragma once
// Content hashes of the files that a recipe names, remembered while a file does not change on disk.
// Internal to project/.

#include <filesystem>
#include <string>
#include <vector>

namespace prt {

/// Hash of a file and of the files that it refers to (the buffers of a .gltf, the images of a BTF's
/// manifest). Throws FileError.
std::string hashSource(const std::filesystem::path& file);

/// The files that it refers to, as far as they are there.
std::vector<std::filesystem::path> filesBeside(const std::filesystem::path& file);

}  // namespace prt
