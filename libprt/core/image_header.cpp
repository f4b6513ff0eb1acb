#include "libprt/core/image_header.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

namespace prt {
namespace {

/// Takes bytes from the front; once something does not fit it stays failed and gives zeros.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> rest) : rest_(rest) {}

  bool failed() const { return failed_; }
  bool atEnd() const { return !failed_ && rest_.empty(); }
  std::span<const std::byte> take(std::size_t count) {
    if (failed_ || count > rest_.size()) {
      failed_ = true;
      return {};
    }
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  std::uint32_t bigEndian(int count) {
    std::uint32_t value = 0;
    for (std::byte b : take(count)) value = value << 8 | std::uint32_t(b);
    return value;
  }
  std::int32_t littleEndian() {
    std::int32_t value = 0;
    const auto bytes = take(4);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), 4);
    return value;
  }
  /// Text up to a zero byte, at most 255 characters.
  std::string name() {
    const auto zero =
        std::find(rest_.begin(), rest_.begin() + std::min<std::size_t>(rest_.size(), 256), std::byte(0));
    if (zero == rest_.end() || zero - rest_.begin() == 256) failed_ = true;
    if (failed_) return {};
    const auto text = take(std::size_t(zero - rest_.begin()));
    take(1);
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }

 private:
  std::span<const std::byte> rest_;
  bool failed_ = false;
};

/// The checksum of PNG chunks (CRC-32 of ISO 3309). libpng would print a line about each wrong one.
std::uint32_t crc32(std::span<const std::byte> bytes) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      table[i] = i;
      for (int bit = 0; bit < 8; ++bit) table[i] = (table[i] >> 1) ^ (table[i] & 1 ? 0xedb88320u : 0);
    }
    return table;
  }();
  std::uint32_t crc = ~0u;
  for (std::byte b : bytes) crc = kTable[(crc ^ std::uint32_t(b)) & 0xff] ^ (crc >> 8);
  return ~crc;
}

/// Beyond every limit, and far from overflow when two are multiplied or many added.
constexpr std::int64_t kFar = std::int64_t(1) << 31;

/// Whether an EXR attribute of a known type is as long as the file says. OpenEXR reads such a type by its own
/// rules, whatever the length: with another one it would take what follows for something else, and believe
/// lengths of gigabytes there.
bool fitsItsType(const std::string& type, Bytes value, std::size_t size) {
  static const std::map<std::string_view, std::size_t> kSizes{{"box2f", 16},
                                                              {"box2i", 16},
                                                              {"chromaticities", 32},
                                                              {"compression", 1},
                                                              {"deepImageState", 1},
                                                              {"double", 8},
                                                              {"envmap", 1},
                                                              {"float", 4},
                                                              {"int", 4},
                                                              {"keycode", 28},
                                                              {"lineOrder", 1},
                                                              {"m33d", 72},
                                                              {"m33f", 36},
                                                              {"m44d", 128},
                                                              {"m44f", 64},
                                                              {"rational", 8},
                                                              {"tiledesc", 9},
                                                              {"timecode", 8},
                                                              {"v2d", 16},
                                                              {"v2f", 8},
                                                              {"v2i", 8},
                                                              {"v3d", 24},
                                                              {"v3f", 12},
                                                              {"v3i", 12}};
  if (const auto known = kSizes.find(type); known != kSizes.end()) return size == known->second;
  if (type == "chlist") {
    while (!value.name().empty()) value.take(16);
    return value.atEnd();
  }
  if (type == "preview") {
    const std::uint64_t width = std::uint32_t(value.littleEndian()),
                        height = std::uint32_t(value.littleEndian());
    return size >= 8 && width * height == (size - 8) / 4 && size % 4 == 0;
  }
  if (type == "stringvector")
    while (!value.failed() && !value.atEnd()) value.take(std::uint32_t(value.littleEndian()));
  return !value.failed();
}

/// The attributes of one part of an EXR that say how large it is.
struct ExrPart {
  std::int64_t width = 0, height = 0;
  std::uint32_t tileWidth = 0, tileHeight = 0;
  std::int64_t chunkCount = 0;
  std::size_t compression = 0;

  void read(const std::string& name, Bytes value) {
    if (name == "dataWindow") {
      const std::int64_t x0 = value.littleEndian(), y0 = value.littleEndian();
      width = std::max(width, value.littleEndian() - x0 + 1);
      height = std::max(height, value.littleEndian() - y0 + 1);
    } else if (name == "tiles") {
      tileWidth = std::uint32_t(value.littleEndian());
      tileHeight = std::uint32_t(value.littleEndian());
    } else if (name == "chunkCount") {
      chunkCount = value.littleEndian();
    } else if (name == "compression") {
      compression = value.bigEndian(1);
    }
  }
  bool tiled() const { return tileWidth > 0 && tileHeight > 0; }
  std::int64_t chunks() const {
    // Lines per chunk: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
    constexpr std::array<std::int64_t, 10> kLines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    const auto parts = [](std::int64_t size, std::int64_t part) {
      return std::min((size + part - 1) / part, kFar);
    };
    const std::int64_t counted = tiled()
                                     ? parts(width, tileWidth) * parts(height, tileHeight)
                                     : parts(height, compression < kLines.size() ? kLines[compression] : 256);
    return std::min(std::max(counted, chunkCount), kFar);
  }
};

}  // namespace

std::optional<ImageHeader> readPngHeader(std::span<const std::byte> file) {
  Bytes bytes(file);
  bytes.take(8);
  ImageHeader header;
  for (std::string_view type; type != "IEND";) {
    const std::uint32_t length = bytes.bigEndian(4);
    const auto chunk = bytes.take(std::size_t(length) + 4);  // its name, then its data
    const std::uint32_t checksum = bytes.bigEndian(4);
    if (bytes.failed() || checksum != crc32(chunk)) return {};
    Bytes data(chunk);
    const auto name = data.take(4);
    type = {reinterpret_cast<const char*>(name.data()), 4};
    if (type != "IHDR" || header.width != 0) continue;
    header.width = data.bigEndian(4);
    header.height = data.bigEndian(4);
  }
  return header;
}

std::optional<ImageHeader> readJpegHeader(std::span<const std::byte> file) {
  Bytes bytes(file);
  bytes.take(2);
  while (!bytes.failed()) {
    if (bytes.bigEndian(1) != 0xff) return {};
    std::uint32_t marker = 0xff;
    while (marker == 0xff && !bytes.failed()) marker = bytes.bigEndian(1);  // fill bytes
    const std::uint32_t length = bytes.bigEndian(2);
    if (length < 2) return {};
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (!frame) {
      bytes.take(length - 2);
      continue;
    }
    ImageHeader header;
    bytes.take(1);
    header.height = bytes.bigEndian(2);
    header.width = bytes.bigEndian(2);
    if (!bytes.failed()) return header;
  }
  return {};
}

std::optional<ImageHeader> readExrHeader(std::span<const std::byte> file) {
  Bytes bytes(file);
  bytes.take(4);
  const bool manyParts = bytes.littleEndian() & 0x1000;
  ImageHeader header;
  for (bool more = true; more; more = manyParts) {
    std::string name = bytes.name();
    if (manyParts && name.empty()) break;
    ExrPart part;
    for (; !name.empty(); name = bytes.name()) {
      const std::string type = bytes.name();
      const std::int32_t size = bytes.littleEndian();
      if (size < 0) return {};
      const auto value = bytes.take(std::size_t(size));
      if (bytes.failed() || !fitsItsType(type, Bytes(value), value.size())) return {};
      part.read(name, Bytes(value));
    }
    if (bytes.failed() || part.width <= 0 || part.height <= 0) return {};
    header.width = std::max(header.width, part.width);
    header.height = std::max(header.height, part.height);
    header.chunks += part.chunks();
    header.chunkPixels = std::max(header.chunkPixels, std::min<std::int64_t>(part.tileWidth, kFar) *
                                                          std::min<std::int64_t>(part.tileHeight, kFar));
  }
  if (bytes.failed() || header.width == 0) return {};
  return header;
}

}  // namespace prt
