#include "libprt/mesh/obj_text.h"

#include "libprt/core/error.h"
#include "libprt/mesh/text_scanner.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace prt {
namespace {

constexpr std::size_t kBlock = 1 << 16;

void appendUtf8(std::string& out, std::uint32_t c) {
  if (c < 0x80) {
    out += char(c);
  } else if (c < 0x800) {
    out += char(0xc0 | (c >> 6));
    out += char(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    out += char(0xe0 | (c >> 12));
    out += char(0x80 | ((c >> 6) & 0x3f));
    out += char(0x80 | (c & 0x3f));
  } else {
    out += char(0xf0 | (c >> 18));
    out += char(0x80 | ((c >> 12) & 0x3f));
    out += char(0x80 | ((c >> 6) & 0x3f));
    out += char(0x80 | (c & 0x3f));
  }
}

std::string fromUtf16(std::string_view bytes, bool bigEndian) {
  const auto unit = [&](std::size_t i) {
    const auto a = std::uint8_t(bytes[i]), b = std::uint8_t(bytes[i + 1]);
    return std::uint32_t(bigEndian ? a << 8 | b : b << 8 | a);
  };
  std::string out;
  out.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xd800 && c < 0xdc00 && i + 3 < bytes.size()) {
      const std::uint32_t low = unit(i + 2);
      if (low >= 0xdc00 && low < 0xe000) {
        c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
        i += 2;
      }
    }
    appendUtf8(out, c >= 0xd800 && c < 0xe000 ? '?' : c);
  }
  return out;
}

/// Splits the first word off a line.
std::string_view firstWord(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
  std::size_t end = begin;
  while (end < line.size() && line[end] != ' ' && line[end] != '\t') ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

}  // namespace

std::string toUtf8(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return i < bytes.size() ? std::uint8_t(bytes[i]) : 1; };
  if (at(0) == 0xef && at(1) == 0xbb && at(2) == 0xbf) return std::string(bytes.substr(3));
  if (at(0) == 0xfe && at(1) == 0xff) return fromUtf16(bytes.substr(2), true);
  if (at(0) == 0xff && at(1) == 0xfe) return fromUtf16(bytes.substr(2), false);
  if (bytes.size() >= 4 && at(0) == 0 && at(1) != 0 && at(2) == 0 && at(3) != 0)
    return fromUtf16(bytes, true);
  if (bytes.size() >= 4 && at(0) != 0 && at(1) == 0 && at(2) != 0 && at(3) == 0)
    return fromUtf16(bytes, false);
  return std::string(bytes);
}

ObjText::ObjText(std::string_view text, std::string name, Job& job)
    : text_(text), name_(std::move(name)), job_(job) {}

void ObjText::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

void ObjText::fail(const std::string& problem) const {
  throw FileError(problem, name_ + ", line " + std::to_string(line_), "export the file again");
}

ObjText::int_type ObjText::underflow() {
  if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
  block_.clear();
  try {
    if (!failure_) fillBlock();
  } catch (...) {
    failure_ = std::current_exception();
    block_.clear();
  }
  setg(block_.data(), block_.data(), block_.data() + block_.size());
  return block_.empty() ? traits_type::eof() : traits_type::to_int_type(block_[0]);
}

void ObjText::fillBlock() {
  job_.checkCancelled();
  while (block_.size() < kBlock && position_ < text_.size()) checkedLine(logicalLine());
  job_.progress(double(position_), double(text_.size()));
}

/// The next line with those that continue it.
std::string_view ObjText::logicalLine() {
  line_ = nextLine_;
  joined_.clear();
  while (true) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", position_), text_.size());
    const std::string_view line = text_.substr(position_, end - position_);
    position_ = end;
    if (position_ < text_.size()) {
      const bool pair =
          text_[position_] == '\r' && position_ + 1 < text_.size() && text_[position_ + 1] == '\n';
      position_ += pair ? 2 : 1;
    }
    ++nextLine_;
    const bool continues = !line.empty() && line.back() == '\\';
    if (!continues && joined_.empty()) return line;
    joined_ += continues ? line.substr(0, line.size() - 1) : line;
    joined_ += ' ';
    if (!continues || position_ >= text_.size()) return joined_;
  }
}

void ObjText::checkedLine(std::string_view line) {
  const std::string_view keyword = firstWord(line);
  if (keyword.empty() || keyword[0] == '#') return;
  if (line.find('\0') != std::string_view::npos || keyword.find('\0') != std::string_view::npos)
    fail("the file holds binary data, not OBJ text");
  if (keyword == "v") {
    numbers(keyword, line, 3, 3);
  } else if (keyword == "vn") {
    numbers(keyword, line, 3, 3);
  } else if (keyword == "vt") {
    numbers(keyword, line, 1, 2);
  } else if (keyword == "f" || keyword == "fo") {
    face(line);
  } else if (keyword == "g" || keyword == "o" || keyword == "usemtl" || keyword == "mtllib") {
    block_.append(keyword).append(line.empty() ? " " : line).append("\n");
  } else if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "curv2" ||
             keyword == "surf") {
    ++ignoredElements_;
  }
}

/// Numbers that follow a keyword; what comes after `atMost` (colours, weights) is left out.
void ObjText::numbers(std::string_view keyword, std::string_view rest, int atLeast, int atMost) {
  block_.append(keyword);
  for (int i = 0; i < atMost; ++i) {
    const std::string_view word = firstWord(rest);
    if (word.empty() && i >= atLeast) break;
    if (word.empty()) fail(inQuotes(keyword) + " needs " + std::to_string(atLeast) + " numbers");
    const auto value = parseNumber(word);
    if (!value) fail(inQuotes(word) + " is not a number");
    block_ += ' ';
    if (std::isfinite(*value))
      block_.append(word);
    else
      block_.append(*value < 0 ? "-9e999" : "9e999");  // which the parser reads as infinite
  }
  block_ += '\n';
}

/// Corners a, a/b, a//c or a/b/c; an index that fits no int becomes 0, which names nothing.
void ObjText::face(std::string_view rest) {
  block_ += "f";
  for (std::string_view word = firstWord(rest); !word.empty(); word = firstWord(rest)) {
    if (word[0] == '#') break;
    block_ += ' ';
    std::string_view corner = word;
    for (int part = 0;; ++part) {
      const std::size_t slash = corner.find('/');
      const std::string_view digits = corner.substr(0, slash);
      const auto index = parseInteger(digits);
      const bool mayBeEmpty = digits.empty() && part > 0;
      const bool overlong = !index && digits.find_first_not_of("+-0123456789") == std::string_view::npos;
      if (part > 2 || (!index && !mayBeEmpty && (!overlong || digits.empty())))
        fail(inQuotes(word) + " is not a corner of a face");
      const bool fits = index && std::abs(*index) <= std::numeric_limits<int>::max();
      block_ += fits ? std::to_string(*index) : digits.empty() ? "" : "0";
      if (slash == std::string_view::npos) break;
      block_ += '/';
      corner.remove_prefix(slash + 1);
    }
  }
  block_ += '\n';
}

}  // namespace prt
