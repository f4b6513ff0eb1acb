#include "tests/mesh/parse.h"

#include <gmock/gmock.h>

namespace prt {
namespace {

using test::raw;
using testing::ElementsAre;
using testing::HasSubstr;

PolygonSoup stl(std::string_view bytes) {
  return test::parsed(parseStl, bytes);
}
std::string refused(std::string_view bytes) {
  return test::refusal(parseStl, bytes);
}

std::string binaryStl(std::string start, std::uint32_t promised, std::uint32_t held) {
  start.resize(80, ' ');
  std::string bytes = start + raw(promised);
  for (std::uint32_t f = 0; f < held; ++f) {
    for (float x : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, float(f), 1.0f, 0.0f, float(f), 0.0f, 1.0f, float(f)})
      bytes += raw(x);
    bytes += raw<std::uint16_t>(0);
  }
  return bytes;
}

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

TEST(StlReader, ReadsBinary) {
  const PolygonSoup soup = stl(binaryStl("made by hand", 2, 2));
  EXPECT_EQ(soup.faceCount(), 2u);
  EXPECT_EQ(soup.positions[4], DVec3(1, 0, 1));
  EXPECT_TRUE(soup.cornerNormal.empty()) << "facet normals would make every edge a crease";
}

TEST(StlReader, BinaryMayBeginWithSolid) {
  EXPECT_EQ(stl(binaryStl("solid but binary", 3, 3)).faceCount(), 3u);
}

TEST(StlReader, ReadsAscii) {
  const PolygonSoup soup =
      stl("solid part one\n" + kFacet + kFacet + "endsolid part one\nSOLID\n" + kFacet + "ENDSOLID\n");
  EXPECT_EQ(soup.faceCount(), 3u);
  EXPECT_THAT(soup.groups, ElementsAre("part one", ""));
  EXPECT_THAT(soup.faceGroup, ElementsAre(0, 0, 1));
  EXPECT_EQ(soup.positions[2], DVec3(0, 1, 0));
}

TEST(StlReader, SparesTrailingBytes) {
  const PolygonSoup soup = stl(binaryStl("x", 2, 3));
  EXPECT_EQ(soup.faceCount(), 2u);
  EXPECT_THAT(soup.notes, ElementsAre(HasSubstr("after the last facet")));
}

TEST(StlReader, RefusesTheRest) {
  EXPECT_THAT(refused("x"), HasSubstr("too short"));
  EXPECT_THAT(refused(binaryStl("x", 5, 2)), HasSubstr("holds 2 of 5 facets"));
  EXPECT_THAT(refused(binaryStl("x", 0xffffffffu, 1)), HasSubstr("holds 1 of 4294967295"));
  EXPECT_THAT(refused("solid\nfacet normal 0 0 1\n outer loop\n vertex 0 0\n"), HasSubstr("ends where"));
  EXPECT_THAT(refused("solid\n" + kFacet), HasSubstr("'facet' or 'endsolid'"));
  EXPECT_THAT(refused("solid\nfacet normal 0 0 1 outer loop vertex 0 0 z"), HasSubstr("'z' is not a number"));
  EXPECT_THAT(refused("solid\nfacet oops"), HasSubstr("'normal' is missing"));
}

}  // namespace
}  // namespace prt
