// Polygon File Format (Turk 1994): ascii and binary of both byte orders. Elements "vertex", "face" and
// "tristrips" are used, all others are skipped by their declared layout.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/text_scanner.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace prt {
namespace {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t sizeOf(PlyType type) {
  static constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[int(type)];
}

PlyType typeFrom(std::string_view name, const TextScanner& text) {
  static constexpr std::pair<std::string_view, PlyType> names[] = {
      {"char", PlyType::i8},    {"int8", PlyType::i8},     {"uchar", PlyType::u8},
      {"uint8", PlyType::u8},   {"short", PlyType::i16},   {"int16", PlyType::i16},
      {"ushort", PlyType::u16}, {"uint16", PlyType::u16},  {"int", PlyType::i32},
      {"int32", PlyType::i32},  {"uint", PlyType::u32},    {"uint32", PlyType::u32},
      {"float", PlyType::f32},  {"float32", PlyType::f32}, {"double", PlyType::f64},
      {"float64", PlyType::f64}};
  for (const auto& [known, type] : names)
    if (name == known) return type;
  text.fail("a property has a type that PLY does not know");
}

struct Property {
  std::string name;
  PlyType type = PlyType::f32;
  bool isList = false;
  PlyType countType = PlyType::u8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  /// Fewest bytes that one row can take.
  std::size_t smallestRow(bool ascii) const {
    std::size_t bytes = 0;
    for (const Property& p : properties) bytes += ascii ? 2 : sizeOf(p.isList ? p.countType : p.type);
    return bytes;
  }
  int find(std::initializer_list<std::string_view> names) const {
    for (std::string_view wanted : names)
      for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == wanted) return int(i);
    return -1;
  }
};

enum class Encoding { ascii, little, big };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes up to and with its last line
  int lines = 0;
};

Encoding encodingFrom(std::string_view name, const TextScanner& text) {
  if (name == "ascii") return Encoding::ascii;
  if (name == "binary_little_endian") return Encoding::little;
  if (name == "binary_big_endian") return Encoding::big;
  text.fail("the format is none of ascii, binary_little_endian, binary_big_endian");
}

Property readProperty(TextScanner& text) {
  Property property;
  std::string_view word = text.wordOnLine();
  if (word == "list") {
    property.isList = true;
    property.countType = typeFrom(text.wordOnLine(), text);
    if (property.countType == PlyType::f32 || property.countType == PlyType::f64)
      text.fail("a list counts its items with a number that is not whole");
    word = text.wordOnLine();
  }
  property.type = typeFrom(word, text);
  property.name = text.wordOnLine();
  return property;
}

Header readHeader(std::string_view bytes, const std::string& name) {
  TextScanner text(bytes, name);
  Header header;
  if (text.word() != "ply") text.fail("a PLY file begins with 'ply'");
  bool hasFormat = false;
  for (std::string_view word = text.word(); word != "end_header"; word = text.word()) {
    if (word == "format") {
      header.encoding = encodingFrom(text.wordOnLine(), text);
      hasFormat = true;
    } else if (word == "element") {
      Element element{.name = std::string(text.wordOnLine()), .properties = {}};
      const auto count = parseInteger(text.wordOnLine());
      if (!count || *count < 0) text.fail("an element has no count");
      element.count = std::size_t(*count);
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("a property stands before any element");
      header.elements.back().properties.push_back(readProperty(text));
    } else if (word.empty()) {
      text.fail("the header does not end");
    } else if (word != "comment" && word != "obj_info") {
      text.fail("the header holds an unknown line");
    }
    text.skipLine();
  }
  text.skipLine();
  if (!hasFormat) text.fail("the header names no format");
  header.size = text.position();
  header.lines = text.line() - 1;
  return header;
}

/// Values of the body, one after the other, whatever the encoding.
class Body {
 public:
  Body(std::string_view bytes, const Header& header, const std::string& name)
      : encoding_(header.encoding), name_(name), bytes_(bytes), lines_(header.lines), text_(bytes, name) {}

  std::size_t remaining() const {
    return encoding_ == Encoding::ascii ? text_.remaining() : bytes_.size() - at_;
  }

  double value(PlyType type) {
    if (encoding_ == Encoding::ascii) return asciiValue();
    if (remaining() < sizeOf(type)) fail("the file ends inside an element");
    const char* p = bytes_.data() + at_;
    at_ += sizeOf(type);
    switch (type) {
      case PlyType::i8:
        return raw<std::int8_t>(p);
      case PlyType::u8:
        return raw<std::uint8_t>(p);
      case PlyType::i16:
        return raw<std::int16_t>(p);
      case PlyType::u16:
        return raw<std::uint16_t>(p);
      case PlyType::i32:
        return raw<std::int32_t>(p);
      case PlyType::u32:
        return raw<std::uint32_t>(p);
      case PlyType::f32:
        return raw<float>(p);
      default:
        return raw<double>(p);
    }
  }

  /// The item count of a list, checked against what the file still holds.
  std::size_t listCount(const Property& list) {
    const double count = value(list.countType);
    const std::size_t itemBytes = encoding_ == Encoding::ascii ? 1 : sizeOf(list.type);
    if (!(count >= 0) || count != std::floor(count)) fail("a list has an impossible length");
    if (count > double(remaining() / itemBytes)) fail("a list is longer than the rest of the file");
    return std::size_t(count);
  }

  void skip(const Property& property) {
    const std::size_t count = property.isList ? listCount(property) : 1;
    for (std::size_t i = 0; i < count; ++i) value(property.type);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    const std::string where = encoding_ == Encoding::ascii ? ", line " + std::to_string(lines_ + text_.line())
                                                           : ", byte " + std::to_string(at_) + " of the body";
    throw FileError(problem, name_ + where, "export the file again");
  }

 private:
  double asciiValue() {
    const std::string_view word = text_.word();
    if (word.empty()) fail("the file ends inside an element");
    const auto number = parseNumber(word);
    if (!number) fail("a value is not a number");
    return *number;
  }

  template <class T>
  double raw(const char* p) const {
    char copy[sizeof(T)];
    std::memcpy(copy, p, sizeof(T));
    if ((encoding_ == Encoding::little) != (std::endian::native == std::endian::little))
      std::reverse(copy, copy + sizeof(T));
    return double(std::bit_cast<T>(copy));
  }

  Encoding encoding_;
  const std::string& name_;
  std::string_view bytes_;
  int lines_;
  std::size_t at_ = 0;
  TextScanner text_;
};

std::uint32_t indexFrom(double value) {
  return value >= 0 && value < double(kNoIndex) ? std::uint32_t(value) : kNoIndex;
}

void readVertices(const Element& element, Body& body, PolygonSoup& soup, Job& job) {
  const int x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
  const int nx = element.find({"nx", "normal_x"}), ny = element.find({"ny", "normal_y"}),
            nz = element.find({"nz", "normal_z"});
  const int u = element.find({"s", "u", "texture_u", "texture_s"}),
            v = element.find({"t", "v", "texture_v", "texture_t"});
  const auto isScalar = [&](int property) { return property >= 0 && !element.properties[property].isList; };
  if (!isScalar(x) || !isScalar(y) || !isScalar(z)) body.fail("the vertices lack one of x, y, z");
  const bool normals = isScalar(nx) && isScalar(ny) && isScalar(nz), uvs = isScalar(u) && isScalar(v);

  std::vector<double> row(element.properties.size());
  for (std::size_t i = 0; i < element.count; ++i) {
    if (i % 4096 == 0) job.checkCancelled();
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (element.properties[k].isList)
        body.skip(element.properties[k]);
      else
        row[k] = body.value(element.properties[k].type);
    }
    soup.positions.push_back({row[x], row[y], row[z]});
    if (normals) soup.normals.push_back(Vec3(row[nx], row[ny], row[nz]));
    if (uvs) soup.uv.push_back(Vec2(row[u], row[v]));
  }
}

void readFaces(const Element& element, Body& body, PolygonSoup& soup, Job& job) {
  const int indices = element.find({"vertex_indices", "vertex_index"});
  if (indices < 0 || !element.properties[indices].isList)
    body.fail("the faces have no list of vertex indices");
  for (std::size_t i = 0; i < element.count; ++i) {
    if (i % 4096 == 0) job.checkCancelled();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      if (int(k) != indices) {
        body.skip(property);
        continue;
      }
      const std::size_t corners = body.listCount(property);
      for (std::size_t c = 0; c < corners; ++c)
        soup.cornerVertex.push_back(indexFrom(body.value(property.type)));
      soup.endFace();
    }
  }
}

/// Triangle strips, each ended by -1, every second triangle turned over.
void readStrips(const Element& element, Body& body, PolygonSoup& soup, Job& job) {
  const int indices = element.find({"vertex_indices", "vertex_index"});
  if (indices < 0 || !element.properties[indices].isList)
    body.fail("the strips have no list of vertex indices");
  for (std::size_t i = 0; i < element.count; ++i)
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      if (int(k) != indices) {
        body.skip(property);
        continue;
      }
      const std::size_t items = body.listCount(property);
      std::uint32_t last[2] = {0, 0};
      std::size_t run = 0;
      for (std::size_t c = 0; c < items; ++c) {
        if (c % 4096 == 0) job.checkCancelled();
        const double value = body.value(property.type);
        if (value == -1) {
          run = 0;
          continue;
        }
        const std::uint32_t index = indexFrom(value);
        if (run >= 2) {
          const bool odd = run % 2 == 1;
          soup.cornerVertex.insert(soup.cornerVertex.end(), {last[odd ? 1 : 0], last[odd ? 0 : 1], index});
          soup.endFace();
        }
        last[0] = last[1];
        last[1] = index;
        ++run;
      }
    }
}

}  // namespace

PolygonSoup parsePly(std::string_view bytes, const MeshSource& source, Job& job) {
  const Header header = readHeader(bytes, source.name);
  const bool ascii = header.encoding == Encoding::ascii;
  Body body(bytes.substr(header.size), header, source.name);
  PolygonSoup soup;
  soup.source = source.name;
  for (const Element& element : header.elements) {
    const std::size_t smallest = element.smallestRow(ascii);
    if (smallest == 0) continue;
    if (element.count > (body.remaining() + 1) / smallest)
      body.fail("the header promises " + std::to_string(element.count) + " of '" +
                element.name.substr(0, 40) + "', more than the file holds");
    if (element.name == "vertex" && soup.positions.empty()) {
      readVertices(element, body, soup, job);
    } else if (element.name == "face") {
      readFaces(element, body, soup, job);
    } else if (element.name == "tristrips") {
      readStrips(element, body, soup, job);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        if (i % 4096 == 0) job.checkCancelled();
        for (const Property& property : element.properties) body.skip(property);
      }
    }
  }
  if (!soup.normals.empty()) soup.cornerNormal = soup.cornerVertex;
  if (!soup.uv.empty()) soup.cornerUv = soup.cornerVertex;
  return soup;
}

}  // namespace prt
