#include "libprt/core/npy.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace prt {
namespace {

struct Descr {
  DType type;
  std::string_view text;
};

constexpr std::array<Descr, 8> kDescrs{{{DType::f16, "<f2"},
                                        {DType::f32, "<f4"},
                                        {DType::f64, "<f8"},
                                        {DType::u8, "|u1"},
                                        {DType::u16, "<u2"},
                                        {DType::u32, "<u4"},
                                        {DType::i32, "<i4"},
                                        {DType::i64, "<i8"}}};

constexpr std::string_view kMagic = "\x93NUMPY";

std::string headerOf(const Array& array) {
  std::string shape;
  for (std::int64_t extent : array.shape) shape += std::to_string(extent) + ", ";
  if (array.shape.size() > 1) shape.resize(shape.size() - 2);
  const auto descr =
      std::find_if(kDescrs.begin(), kDescrs.end(), [&](const Descr& d) { return d.type == array.dtype; });
  std::string dict =
      "{'descr': '" + std::string(descr->text) + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  const std::size_t start = kMagic.size() + 4;
  while ((start + dict.size() + 1) % 64 != 0) dict += ' ';
  dict += '\n';
  std::string header(kMagic);
  header += {1, 0, char(dict.size() & 0xff), char(dict.size() >> 8)};
  return header + dict;
}

/// The Python dictionary of the header, as far as the format uses it.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  Array parse() {
    expect("{");
    while (!accept("}")) {
      const std::string_view key = quoted();
      expect(":");
      value(key);
      if (!accept(",")) {
        expect("}");
        break;
      }
    }
    skipSpace();
    if (!rest_.empty() || !type_ || !order_ || !shape_) fail();
    return Array{*type_, *shape_, {}};
  }

 private:
  [[noreturn]] void fail() const {
    throw FileError("has a header that is not .npy's", name_, "write it again");
  }

  void skipSpace() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n"), rest_.size())); }
  bool accept(std::string_view token) {
    skipSpace();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  void expect(std::string_view token) {
    if (!accept(token)) fail();
  }
  std::string_view quoted() {
    skipSpace();
    const char quote = rest_.empty() ? 0 : rest_.front();
    const auto end = rest_.find(quote, 1);
    if ((quote != '\'' && quote != '"') || end == std::string_view::npos) fail();
    const std::string_view text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return text;
  }

  void value(std::string_view key) {
    if (key == "descr" && !type_)
      type_ = descr();
    else if (key == "fortran_order" && !order_)
      order_ = cOrder();
    else if (key == "shape" && !shape_)
      shape_ = shape();
    else
      fail();
  }
  DType descr() {
    const std::string_view text = quoted();
    for (const Descr& d : kDescrs)
      if (text == d.text) return d.type;
    throw FileError("holds elements of type '" + std::string(text) + "'", name_,
                    "write it as float16, 32 or 64, uint8, 16 or 32, int32 or 64, little-endian");
  }
  bool cOrder() {
    if (accept("True")) throw FileError("is in Fortran order", name_, "write it in C order");
    expect("False");
    return true;
  }
  std::vector<std::int64_t> shape() {
    std::vector<std::int64_t> extents;
    expect("(");
    while (!accept(")")) {
      skipSpace();
      std::int64_t extent = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), extent);
      if (error != std::errc() || extent < 0 || extents.size() == 32) fail();
      rest_.remove_prefix(std::size_t(end - rest_.data()));
      extents.push_back(extent);
      if (accept(",")) continue;
      if (extents.size() == 1) fail();  // (3) is a number in Python, (3,) a tuple
      expect(")");
      break;
    }
    return extents;
  }

  std::string_view rest_;
  const std::string& name_;
  std::optional<DType> type_;
  std::optional<bool> order_;
  std::optional<std::vector<std::int64_t>> shape_;
};

/// Bytes that the shape needs, or nothing when that is more than `most`.
std::optional<std::size_t> bytesOf(const Array& array, std::size_t most) {
  if (std::find(array.shape.begin(), array.shape.end(), 0) != array.shape.end()) return 0;
  std::size_t bytes = sizeOf(array.dtype);
  for (std::int64_t extent : array.shape) {
    if (extent < 0 || std::size_t(extent) > most / bytes) return {};
    bytes *= std::size_t(extent);
  }
  return bytes;
}

}  // namespace

void writeNpy(const std::filesystem::path& path, const Array& array) {
  if (array.shape.size() > 32 || bytesOf(array, array.bytes.size()) != array.bytes.size())
    throw ValueError("the array's bytes do not match its shape", path.string(), "");
  AtomicFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  out << headerOf(array);
  out.write(reinterpret_cast<const char*>(array.bytes.data()), std::streamsize(array.bytes.size()));
  out.close();
  if (!out)
    throw FileError("cannot write it", path.string(), "check the disk's space and the folder's permissions");
  file.commit();
}

Array readNpy(const std::filesystem::path& path) {
  return readNpy(readFile(path), path.string());
}

Array readNpy(std::span<const std::byte> file, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (!text.starts_with(kMagic) || text.size() < 10) throw FileError("is not a .npy file", name, "give one");
  const int version = text[6];
  if (version < 1 || version > 3 || text[7] != 0)
    throw FileError("has a .npy version that is not known", name, "write it as 1.0");
  const std::size_t lengthBytes = version == 1 ? 2 : 4, start = 8 + lengthBytes;
  const FileError tooShort("is cut off", name, "write it again");
  if (text.size() < start) throw tooShort;
  std::size_t length = 0;
  for (std::size_t i = 0; i < lengthBytes; ++i) length |= std::size_t(std::uint8_t(text[8 + i])) << (8 * i);
  if (length > text.size() - start) throw tooShort;
  Array array = HeaderParser(text.substr(start, length), name).parse();
  const std::span<const std::byte> data = file.subspan(start + length);
  const auto bytes = bytesOf(array, data.size());
  if (!bytes) throw tooShort;
  if (*bytes != data.size()) throw FileError("is longer than its shape says", name, "write it again");
  array.bytes.assign(data.begin(), data.end());
  return array;
}

}  // namespace prt
