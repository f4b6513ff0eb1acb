#pragma once
// NumPy's .npy files: plain arrays for other programs. Written as version 1.0, little-endian, C order;
// read strictly: any deviation from the format is a FileError, and sizes are checked before memory is taken.

#include "libprt/core/array.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace prt {

/// Writes an array, atomically. Throws FileError when it cannot be written, ValueError when the array's
/// bytes do not match its shape.
void writeNpy(const std::filesystem::path& path, const Array& array);

/// Reads an array of one of DType's kinds in little-endian C order. Throws FileError when the file is
/// missing, damaged, of another kind, or longer or shorter than its shape says.
Array readNpy(const std::filesystem::path& path);
/// The same from memory; `name` is what errors call it.
Array readNpy(std::span<const std::byte> file, const std::string& name);

}  // namespace prt
