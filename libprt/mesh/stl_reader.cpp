// Stereolithography files, ascii and binary. Which of the two is told by the size that a binary header
// implies, since many binary files begin with "solid" too. Facet normals are ignored: winding says the same.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/text_scanner.h"

#include <algorithm>
#include <cstring>

namespace prt {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;

template <class T>
T littleEndian(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

PolygonSoup parseBinary(std::string_view bytes, std::size_t facets, Job& job) {
  PolygonSoup soup;
  soup.positions.reserve(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    if (f % 4096 == 0) job.checkCancelled();
    const char* facet = bytes.data() + kHeader + kFacet * f;
    for (int corner = 0; corner < 3; ++corner) {
      const char* p = facet + 12 * (corner + 1);
      soup.cornerVertex.push_back(std::uint32_t(soup.positions.size()));
      soup.positions.push_back(
          {littleEndian<float>(p), littleEndian<float>(p + 4), littleEndian<float>(p + 8)});
    }
    soup.endFace();
  }
  return soup;
}

void expect(TextScanner& text, std::string_view word) {
  if (lowerCase(text.word()) != word) text.fail(inQuotes(word) + " is missing");
}

/// facet normal x y z / outer loop / vertex x y z ... / endloop / endfacet, after the word "facet".
void parseFacet(TextScanner& text, PolygonSoup& soup) {
  expect(text, "normal");
  for (int i = 0; i < 3; ++i)
    if (text.word().empty()) text.fail("the file ends inside a facet");
  expect(text, "outer");
  expect(text, "loop");
  for (std::string word = lowerCase(text.word()); word != "endloop"; word = lowerCase(text.word())) {
    if (word != "vertex") text.fail("'vertex' or 'endloop' is missing");
    DVec3 p;
    for (int i = 0; i < 3; ++i) p[i] = text.number();
    soup.cornerVertex.push_back(std::uint32_t(soup.positions.size()));
    soup.positions.push_back(p);
  }
  soup.endFace();
  expect(text, "endfacet");
}

PolygonSoup parseAscii(std::string_view bytes, const MeshSource& source, Job& job) {
  PolygonSoup soup;
  TextScanner text(bytes, source.name);
  while (!text.atEnd()) {
    expect(text, "solid");
    soup.groups.emplace_back(text.restOfLine().substr(0, 256));
    for (std::string word = lowerCase(text.word()); word != "endsolid"; word = lowerCase(text.word())) {
      if (word != "facet") text.fail("'facet' or 'endsolid' is missing");
      if (soup.faceCount() % 1024 == 0) job.checkCancelled();
      parseFacet(text, soup);
      soup.faceGroup.push_back(std::uint32_t(soup.groups.size() - 1));
    }
    text.skipLine();
  }
  return soup;
}

}  // namespace

PolygonSoup parseStl(std::string_view bytes, const MeshSource& source, Job& job) {
  PolygonSoup soup;
  const std::size_t held = bytes.size() >= kHeader ? (bytes.size() - kHeader) / kFacet : 0;
  const std::size_t promised = bytes.size() >= kHeader ? littleEndian<std::uint32_t>(bytes.data() + 80) : 0;
  const bool exact = bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * promised;
  const std::string start = lowerCase(bytes.substr(0, std::min<std::size_t>(bytes.size(), 1024)));
  const bool looksAscii =
      TextScanner(start, source.name).word() == "solid" && start.find('\0') == std::string::npos && !exact;
  if (looksAscii) {
    soup = parseAscii(bytes, source, job);
  } else {
    if (bytes.size() < kHeader)
      throw FileError("too short for an STL file", source.name, "export the file again");
    if (promised > held)
      throw FileError("holds " + std::to_string(held) + " of " + std::to_string(promised) + " facets",
                      source.name, "the file is cut off; copy or export it again");
    soup = parseBinary(bytes, promised, job);
    if (!exact) soup.notes.emplace_back("bytes after the last facet were ignored");
  }
  soup.source = source.name;
  return soup;
}

}  // namespace prt
