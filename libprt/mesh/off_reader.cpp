// Object File Format: OFF with the prefixes ST, C, N (texture coordinates, colours, normals). One vertex
// and one face per line; what follows on a line beyond what the header promises is colour and is ignored.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/text_scanner.h"

#include <algorithm>

namespace prt {
namespace {

struct OffHeader {
  bool uvs = false, colors = false, normals = false;
  std::size_t vertices = 0, faces = 0;
};

OffHeader readHeader(TextScanner& text) {
  OffHeader header;
  const std::string_view keyword = text.word();
  std::string_view rest = keyword;
  const auto take = [&](std::string_view prefix) {
    if (!rest.starts_with(prefix)) return false;
    rest.remove_prefix(prefix.size());
    return true;
  };
  header.uvs = take("ST");
  header.colors = take("C");
  header.normals = take("N");
  if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF")
    text.fail("only three-dimensional OFF files are read");
  if (rest != "OFF") text.fail("an OFF file begins with OFF, COFF, NOFF or the like");

  std::string_view first = text.wordOnLine();
  if (first == "BINARY") text.fail("binary OFF is not read");
  if (first.empty()) first = text.word();
  const auto vertices = parseInteger(first), faces = parseInteger(text.wordOnLine());
  if (!vertices || !faces || *vertices < 0 || *faces < 0)
    text.fail("the counts of vertices and faces are missing");
  text.skipLine();  // the count of edges, which nobody fills in
  header.vertices = std::size_t(*vertices);
  header.faces = std::size_t(*faces);
  // A vertex takes six bytes ("0 0 0\n"), a face two ("0\n").
  if (header.vertices > text.remaining() / 5 || header.faces > text.remaining())
    text.fail("the header promises more than the file holds");
  return header;
}

void readVertex(TextScanner& text, const OffHeader& header, PolygonSoup& soup) {
  DVec3 p;
  for (int i = 0; i < 3; ++i) p[i] = text.number();
  soup.positions.push_back(p);
  // The order on the line is position, normal, colour, texture coordinates.
  if (header.normals) {
    Vec3 n;
    for (int i = 0; i < 3; ++i) n[i] = float(text.number());
    soup.normals.push_back(n);
  }
  if (header.uvs) {
    double last[2] = {0, 0};
    for (std::string_view word = text.wordOnLine(); !word.empty(); word = text.wordOnLine()) {
      const auto value = parseNumber(word);
      if (!value) text.fail("a texture coordinate is not a number");
      last[0] = last[1];
      last[1] = *value;
    }
    soup.uv.push_back(Vec2(last[0], last[1]));
  }
  text.skipLine();
}

void readFace(TextScanner& text, PolygonSoup& soup) {
  const std::int64_t corners = text.integer();
  if (corners < 0 || std::uint64_t(corners) > text.remaining())
    text.fail("the number of corners is impossible");
  for (std::int64_t i = 0; i < corners; ++i) {
    const std::int64_t index = text.integer();
    const bool valid = index >= 0 && std::uint64_t(index) < soup.positions.size();
    soup.cornerVertex.push_back(valid ? std::uint32_t(index) : kNoIndex);
  }
  soup.endFace();
  text.skipLine();
}

}  // namespace

PolygonSoup parseOff(std::string_view bytes, const MeshSource& source, Job& job) {
  TextScanner text(bytes, source.name, '#');
  const OffHeader header = readHeader(text);
  PolygonSoup soup;
  soup.source = source.name;
  for (std::size_t i = 0; i < header.vertices; ++i) {
    if (i % 4096 == 0) job.checkCancelled();
    readVertex(text, header, soup);
  }
  for (std::size_t i = 0; i < header.faces; ++i) {
    if (i % 4096 == 0) job.checkCancelled();
    readFace(text, soup);
  }
  if (header.normals) soup.cornerNormal = soup.cornerVertex;
  if (header.uvs) soup.cornerUv = soup.cornerVertex;
  return soup;
}

}  // namespace prt
