#include "tests/mesh/parse.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace prt {
namespace {

using test::raw;
using testing::ElementsAre;
using testing::HasSubstr;

PolygonSoup ply(std::string_view bytes) {
  return test::parsed(parsePly, bytes);
}
std::string refused(std::string_view bytes) {
  return test::refusal(parsePly, bytes);
}

std::string header(const std::string& format, const std::string& lines) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\n" + lines + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

TEST(PlyReader, ReadsAscii) {
  const PolygonSoup soup = ply(header("ascii", "element vertex 3\n" + kXyz + "element face 1\n" + kFaces) +
                               "0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n");
  EXPECT_THAT(soup.positions, ElementsAre(DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0.5)));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
}

/// One vertex of every scalar type in a row, then a face.
std::string everyType(bool bigEndian) {
  const std::string types[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  std::string lines = "element vertex 1\n";
  for (std::size_t i = 0; i < 8; ++i) lines += "property " + types[i] + " p" + std::to_string(i) + "\n";
  lines += kXyz + "element face 1\nproperty list ushort uint vertex_index\n";
  const auto ordered = [&](std::string bytes) {
    if (bigEndian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  std::string body = ordered(raw<std::int8_t>(-1)) + ordered(raw<std::uint8_t>(2)) +
                     ordered(raw<std::int16_t>(-3)) + ordered(raw<std::uint16_t>(4)) +
                     ordered(raw<std::int32_t>(-5)) + ordered(raw<std::uint32_t>(6)) +
                     ordered(raw<float>(7)) + ordered(raw<double>(8));
  for (float x : {1.5f, -2.5f, 1e-3f}) body += ordered(raw(x));
  body += ordered(raw<std::uint16_t>(3));
  for (std::uint32_t i : {0u, 70000u, 0u}) body += ordered(raw(i));
  return header(bigEndian ? "binary_big_endian" : "binary_little_endian", lines) + body;
}

TEST(PlyReader, ReadsBothByteOrdersAndEveryType) {
  for (bool big : {false, true}) {
    const PolygonSoup soup = ply(everyType(big));
    ASSERT_EQ(soup.positions.size(), 1u);
    EXPECT_EQ(soup.positions[0], DVec3(1.5f, -2.5f, 1e-3f));
    EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 70000, 0));
  }
}

TEST(PlyReader, DoublesStayDoubles) {
  const PolygonSoup soup =
      ply(header("ascii", "element vertex 1\nproperty double x\nproperty double y\nproperty double z\n") +
          "601234.5678 0 0\n");
  EXPECT_EQ(soup.positions[0].x, 601234.5678);
}

TEST(PlyReader, ReadsNormalsAndUvs) {
  const PolygonSoup soup =
      ply(header("ascii", "element vertex 3\n" + kXyz +
                              "property float nx\nproperty float ny\nproperty float nz\nproperty float "
                              "s\nproperty float t\nelement face 1\n" +
                              kFaces) +
          "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n3 2 1 0\n");
  EXPECT_EQ(soup.normals[0], Vec3(0, 0, 1));
  EXPECT_EQ(soup.uv[2], Vec2(0, 1));
  EXPECT_THAT(soup.cornerNormal, ElementsAre(2, 1, 0));
  EXPECT_THAT(soup.cornerUv, ElementsAre(2, 1, 0));
}

TEST(PlyReader, SkipsElementsAndListsThatItDoesNotUse) {
  const PolygonSoup soup =
      ply(header("ascii",
                 "element camera 2\nproperty float a\nproperty list uchar float b\nelement vertex "
                 "3\nproperty list uchar int neighbours\n" +
                     kXyz + "element face 1\nproperty uchar flag\n" + kFaces +
                     "property list uchar float texcoord\nelement nothing 9999999999\n") +
          "1 2 5 5\n1 0\n2 7 7 0 0 0\n0 1 0 0\n1 9 0 1 0\n4 3 0 1 2 6 0 0 1 0 0 1\n");
  EXPECT_EQ(soup.positions[1], DVec3(1, 0, 0));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
}

TEST(PlyReader, UnrollsTriangleStrips) {
  const PolygonSoup soup =
      ply(header("ascii", "element vertex 4\n" + kXyz +
                              "element tristrips 1\nproperty list int int vertex_indices\n") +
          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n");
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2, 2, 1, 3, 3, 2, 1));
}

TEST(PlyReader, IndicesThatNameNothingAreKept) {
  const PolygonSoup soup =
      ply(header("ascii", "element vertex 1\n" + kXyz +
                              "element face 2\nproperty list uchar double vertex_indices\n") +
          "0 0 0\n3 0 -1 0\n3 0 1e300 nan\n");
  EXPECT_EQ(soup.cornerVertex[1], kNoIndex);
  EXPECT_EQ(soup.cornerVertex[4], kNoIndex);
  EXPECT_EQ(soup.cornerVertex[5], kNoIndex);
}

TEST(PlyReader, CountsThatTheFileCannotHoldAreRefusedAtOnce) {
  EXPECT_THAT(refused(header("ascii", "element vertex 4000000000\n" + kXyz) + "0 0 0\n"),
              HasSubstr("promises 4000000000"));
  EXPECT_THAT(
      refused(header("binary_little_endian", "element vertex 9223372036854775807\n" + kXyz) + raw(1.0f)),
      HasSubstr("more than the file holds"));
  EXPECT_THAT(
      refused(header("binary_little_endian", "element vertex 0\n" + kXyz +
                                                 "element face 1\nproperty list uint int vertex_indices\n") +
              raw<std::uint32_t>(0xffffffffu)),
      HasSubstr("longer than the rest"));
  EXPECT_THAT(refused(header("ascii", "element vertex 1\n" + kXyz +
                                          "element face 1\nproperty list int int vertex_indices\n") +
                      "0 0 0\n-3 0 0 0\n"),
              HasSubstr("impossible length"));
}

TEST(PlyReader, RefusesBrokenHeadersAndBodies) {
  EXPECT_THAT(refused("plx\n"), HasSubstr("begins with 'ply'"));
  EXPECT_THAT(refused("ply\nformat ascii 1.0\nelement vertex 1\n"), HasSubstr("header does not end"));
  EXPECT_THAT(refused("ply\nformat binary_middle_endian 1.0\nend_header\n"), HasSubstr("format is none of"));
  EXPECT_THAT(refused("ply\nelement vertex 0\nend_header\n"), HasSubstr("no format"));
  EXPECT_THAT(refused(header("ascii", "property float x\n")), HasSubstr("before any element"));
  EXPECT_THAT(refused(header("ascii", "element vertex -1\n")), HasSubstr("no count"));
  EXPECT_THAT(refused(header("ascii", "element vertex 1\nproperty real x\n")), HasSubstr("type"));
  EXPECT_THAT(refused(header("ascii", "element vertex 1\nproperty list float int x\n")),
              HasSubstr("not whole"));
  EXPECT_THAT(refused(header("ascii", "surprise\n")), HasSubstr("unknown line"));
  EXPECT_THAT(refused(header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "0 0\n"),
              HasSubstr("lack one of x, y, z"));
  EXPECT_THAT(refused(header("ascii", "element vertex 1\n" + kXyz) + "0 q 0\n"),
              HasSubstr("line 9: a value is not a number"));
  EXPECT_THAT(refused(header("ascii", "element vertex 2\n" + kXyz) + "0 0 0\n0 0 \n"),
              HasSubstr("ends inside"));
  const std::string cut = everyType(false);
  EXPECT_THAT(refused(cut.substr(0, cut.size() - 1)),
              testing::AnyOf(HasSubstr("ends inside"), HasSubstr("longer than")));
}

}  // namespace
}  // namespace prt
