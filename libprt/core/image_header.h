#pragma once
// Private to the image reader: what a file's header promises, read before any decoder sees the file.
// The decoders take memory for what a header promises, gigabytes for a few damaged bytes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace prt {

struct ImageHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::int64_t chunks = 0;       ///< EXR: entries of the chunk table, 8 bytes each in the file
  std::int64_t chunkPixels = 0;  ///< EXR: pixels of the largest tile
};

/// Each returns nothing when the header is damaged beyond what the decoder could make sense of. The spans
/// hold the whole file.

/// Nothing too when a chunk is longer than the file or its checksum wrong, or the closing one is missing.
std::optional<ImageHeader> readPngHeader(std::span<const std::byte> file);
std::optional<ImageHeader> readJpegHeader(std::span<const std::byte> file);
/// Of several parts the largest of everything, and all of their chunks.
std::optional<ImageHeader> readExrHeader(std::span<const std::byte> file);

}  // namespace prt
