#include "tests/mesh/parse.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

namespace prt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PolygonSoup obj(std::string_view text) {
  return test::parsed(parseObj, text);
}
std::string refused(std::string_view text) {
  return test::refusal(parseObj, text);
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjReader, ReadsPositionsNormalsAndUvs) {
  const PolygonSoup soup = obj(kTriangle + "vt 0.25 0.5\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_THAT(soup.positions, ElementsAre(DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_THAT(soup.cornerUv, ElementsAre(0, 0, 0));
  EXPECT_THAT(soup.cornerNormal, ElementsAre(0, 0, 0));
  EXPECT_THAT(soup.uv, ElementsAre(Vec2(0.25f, 0.5f)));
  EXPECT_THAT(soup.normals, ElementsAre(Vec3(0, 0, 1)));
}

TEST(ObjReader, CoordinatesAreDoubles) {
  const PolygonSoup soup = obj("v 601234.5678 3978123.25 -4628.0625\n" + kTriangle + "f 1 2 3\n");
  EXPECT_NEAR(soup.positions[0].x, 601234.5678, 1e-9);
  EXPECT_EQ(soup.positions[0].y, 3978123.25);
}

TEST(ObjReader, NumbersComeOutAsWritten) {
  const PolygonSoup soup = obj("v .5 -1.25e-3 +7E2\nv 1e-310 123456789.123456789 0.1\n");
  EXPECT_THAT(soup.positions[0], DVec3(0.5, -0.00125, 700));
  EXPECT_NEAR(soup.positions[1].y, 123456789.123456789, 1e-7);
  EXPECT_NEAR(soup.positions[1].z, 0.1, 1e-16);
}

TEST(ObjReader, LeavesOutWhatIsAbsent) {
  const PolygonSoup soup = obj(kTriangle + "f 1 2 3\n");
  EXPECT_THAT(soup.cornerUv, IsEmpty());
  EXPECT_THAT(soup.cornerNormal, IsEmpty());
  EXPECT_THAT(soup.faceMaterial, IsEmpty());
  EXPECT_THAT(soup.notes, IsEmpty());
}

TEST(ObjReader, IndicesCountFromTheEndWhenNegative) {
  EXPECT_THAT(obj(kTriangle + "f -3 -2 -1\n").cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_THAT(obj(kTriangle + "f -3 -2 -1\nv 9 9 9\nf -3 -2 -1\n").cornerVertex,
              ElementsAre(0, 1, 2, 1, 2, 3));
}

TEST(ObjReader, MayNameVerticesThatComeLater) {
  EXPECT_THAT(obj("f 1 2 3\n" + kTriangle).cornerVertex, ElementsAre(0, 1, 2));
}

TEST(ObjReader, KeepsIndicesThatNameNothing) {
  const PolygonSoup soup =
      obj(kTriangle + "f 0 1 2\nf -9 1 2\nf 4294967297 1 2\nf 99999999999999999999 1 2\nf 7 1 2\n");
  ASSERT_EQ(soup.faceCount(), 5u);
  for (std::size_t f = 0; f < 5; ++f) EXPECT_GE(soup.face(f)[0], soup.positions.size()) << f;
}

TEST(ObjReader, ReadsPolygonsAndMixedCorners) {
  const PolygonSoup soup = obj(kTriangle + "v 1 1 0\nvn 0 0 1\nf 1//1 2 4//1 3/ \n");
  EXPECT_THAT(soup.faceStart, ElementsAre(0, 4));
  EXPECT_THAT(soup.cornerNormal, ElementsAre(0, kNoIndex, 0, kNoIndex));
}

TEST(ObjReader, JoinsContinuedLines) {
  EXPECT_THAT(obj("v 0 0 \\\n 0\nv 1 0 0\r\nv 0 1 0\r\nf 1 \\\r\n2 \\\n3\n").cornerVertex,
              ElementsAre(0, 1, 2));
  EXPECT_THAT(obj(kTriangle + "f 1 2 3 \\").cornerVertex, testing::Contains(2u));
}

TEST(ObjReader, ReadsAnyLineEndAndLeadingBlanks) {
  EXPECT_THAT(obj("  v 0 0 0\rv 1 0 0\r\n\tv 0 1 0\n\n f 1 2 3").cornerVertex, ElementsAre(0, 1, 2));
}

std::string utf16(const std::string& text, bool bigEndian, bool mark) {
  std::string bytes;
  const auto unit = [&](unsigned c) {
    const char high = char(c >> 8), low = char(c & 0xff);
    bytes += bigEndian ? high : low;
    bytes += bigEndian ? low : high;
  };
  if (mark) unit(0xfeff);
  for (unsigned char c : text) unit(c);
  return bytes;
}

TEST(ObjReader, ReadsUtf16AndMarks) {
  const std::string text = kTriangle + "f 1 2 3\n";
  for (bool big : {false, true})
    for (bool mark : {false, true})
      EXPECT_THAT(obj(utf16(text, big, mark)).cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_THAT(obj("\xef\xbb\xbf" + text).cornerVertex, ElementsAre(0, 1, 2));
}

TEST(ObjReader, GroupsAndMaterialsAreNamed) {
  const PolygonSoup soup =
      obj(kTriangle + "o thing\nusemtl  red \nf 1 2 3\ng a b\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 2 3\n");
  ASSERT_EQ(soup.materials.size(), 2u);
  EXPECT_EQ(soup.materials[0].name, "red");
  EXPECT_FALSE(soup.materials[0].hasColor);
  EXPECT_THAT(soup.faceMaterial, ElementsAre(0, 1, 0));
  EXPECT_THAT(soup.groups, ElementsAre("thing", "a b"));
  EXPECT_THAT(soup.faceGroup, ElementsAre(0, 1, 1));
}

TEST(ObjReader, TakesColoursFromALibraryInItsFolderOnly) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "model");
  std::ofstream(folder / "model/good.mtl") << "newmtl red\nKd 0.5 0.25 0\nmap_Kd -s 1 1 1 x.png\n";
  std::ofstream(folder / "secret.mtl") << "newmtl red\nKd 1 1 1\n";
  const auto color = [&](const std::string& library) {
    const PolygonSoup soup = test::parsed(
        parseObj, "mtllib " + library + "\n" + kTriangle + "usemtl red\nf 1 2 3\n", folder / "model");
    return soup.materials.at(0).hasColor ? soup.materials[0].baseColor : Rgb(-1);
  };
  EXPECT_EQ(color("good.mtl"), Rgb(0.5f, 0.25f, 0));
  EXPECT_EQ(color("../secret.mtl"), Rgb(-1));
  EXPECT_EQ(color((folder / "secret.mtl").string()), Rgb(-1));
  std::filesystem::create_symlink(folder / "secret.mtl", folder / "model/link.mtl");
  EXPECT_EQ(color("link.mtl"), Rgb(-1)) << "a link out of the folder";
  EXPECT_EQ(color("missing.mtl"), Rgb(-1));
}

TEST(ObjReader, NonFiniteNumbersStayNonFinite) {
  const PolygonSoup soup = obj("v nan 0 0\nv -inf 1e999 1.#IND\nf 1 1 1\n");
  EXPECT_FALSE(std::isfinite(soup.positions[0].x));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(std::isfinite(soup.positions[1][i]));
}

TEST(ObjReader, NotesWhatItLeavesOut) {
  const PolygonSoup soup = obj(kTriangle + "p 1\nl 1 2\ncurv 0 1 1 2\nf 1 2 3\n");
  EXPECT_THAT(soup.notes, ElementsAre(HasSubstr("3 points, lines or curves")));
  EXPECT_EQ(soup.faceCount(), 1u);
}

TEST(ObjReader, RefusesWhatItCannotRead) {
  EXPECT_THAT(refused("v 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(refused("v 0 0 0\nv 0 abc 0\n"), HasSubstr("line 2: 'abc' is not a number"));
  EXPECT_THAT(refused("v 0 \\\n0 \\\n0\nv 1 x 0"), HasSubstr("line 4"));
  EXPECT_THAT(refused(kTriangle + "f 1 2 x\n"), HasSubstr("'x' is not a corner"));
  EXPECT_THAT(refused(kTriangle + "f 1 2 1.5\n"), HasSubstr("corner"));
  EXPECT_THAT(refused(kTriangle + "f 1/1/1/1 2 3\n"), HasSubstr("corner"));
  EXPECT_THAT(refused(kTriangle + "f /1 2 3\n"), HasSubstr("corner"));
  EXPECT_THAT(refused("vn 1 2\n"), HasSubstr("'vn' needs 3"));
  EXPECT_THAT(refused(std::string("v 0 0 0\0\n", 9)), HasSubstr("binary"));
}

TEST(ObjReader, CanBeCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(parseObj(kTriangle, {"x", {}}, job), Cancelled);
}

}  // namespace
}  // namespace prt
