#include "tests/mesh/parse.h"

#include <gmock/gmock.h>

#include <cmath>

namespace prt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PolygonSoup off(std::string_view text) {
  return test::parsed(parseOff, text);
}
std::string refused(std::string_view text) {
  return test::refusal(parseOff, text);
}

const std::string kThree = "0 0 0\n1 0 0\n0 1 0\n";

TEST(OffReader, ReadsPlainFiles) {
  const PolygonSoup soup = off("OFF\n# comment\n\n3 1 3 # counts\n" + kThree + "3 0 1 2\n");
  EXPECT_THAT(soup.positions, ElementsAre(DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
}

TEST(OffReader, CountsMayFollowTheKeywordAndLackTheEdges) {
  EXPECT_EQ(off("OFF 3 1\n" + kThree + "3 0 1 2\n").faceCount(), 1u);
}

TEST(OffReader, IgnoresColours) {
  const PolygonSoup soup =
      off("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 255 0 0 255\n0 1 0 0.5 0.5 0.5 1\n3 0 1 2 255 0 0\n");
  EXPECT_EQ(soup.positions[2], DVec3(0, 1, 0));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_EQ(off("OFF\n3 1 0\n0 0 0 9 9 9\n1 0 0\n0 1 0\n3 0 1 2\n").positions[1], DVec3(1, 0, 0));
}

TEST(OffReader, ReadsNormalsAndTextureCoordinates) {
  const PolygonSoup soup = off("STNOFF\n3 1 0\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n3 2 1 0\n");
  EXPECT_EQ(soup.normals[1], Vec3(0, 0, 1));
  EXPECT_EQ(soup.uv[2], Vec2(0, 1));
  EXPECT_THAT(soup.cornerNormal, ElementsAre(2, 1, 0));
}

TEST(OffReader, PolygonsAndIndicesThatNameNothing) {
  const PolygonSoup soup = off("OFF\n3 3 0\n" + kThree + "4 0 1 2 0\n0\n3 0 -1 99\n");
  EXPECT_THAT(soup.faceStart, ElementsAre(0, 4, 4, 7));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2, 0, 0, kNoIndex, kNoIndex));
}

TEST(OffReader, CommentsBeginWords) {
  EXPECT_TRUE(std::isnan(off("OFF\n1 0 0 #x\n1.#QNAN 0 0 # y\n").positions[0].x))
      << "as Microsoft's programs print it";
}

TEST(OffReader, RefusesTheRest) {
  EXPECT_THAT(refused("OFFX\n"), HasSubstr("begins with OFF"));
  EXPECT_THAT(refused("OFF BINARY\n"), HasSubstr("binary OFF"));
  EXPECT_THAT(refused("4OFF\n1 0 0\n"), HasSubstr("three-dimensional"));
  EXPECT_THAT(refused("OFF\n3\n"), HasSubstr("counts"));
  EXPECT_THAT(refused("OFF\n-3 1 0\n"), HasSubstr("counts"));
  EXPECT_THAT(refused("OFF\n4000000000 1 0\n0 0 0\n"), HasSubstr("more than the file holds"));
  EXPECT_THAT(refused("OFF\n1 0 0\n0 x 0\n"), HasSubstr("line 3: 'x'"));
  EXPECT_THAT(refused("OFF\n3 1 0\n" + kThree + "3 0 1\n"), HasSubstr("ends where"));
  EXPECT_THAT(refused("OFF\n3 1 0\n" + kThree + "2000000000 0 1\n"), HasSubstr("impossible"));
}

}  // namespace
}  // namespace prt
