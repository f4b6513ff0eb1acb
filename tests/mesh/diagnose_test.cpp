#include "libprt/mesh/diagnose.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace prt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PolygonSoup soupOf(std::vector<DVec3> positions, std::vector<std::vector<std::uint32_t>> faces) {
  PolygonSoup soup;
  soup.positions = std::move(positions);
  for (const auto& face : faces) {
    soup.cornerVertex.insert(soup.cornerVertex.end(), face.begin(), face.end());
    soup.endFace();
  }
  return soup;
}

MeshReport reportOf(const PolygonSoup& soup) {
  Job job;
  return diagnose(soup, job);
}

/// Corners of a cube, 1 long, number = x + 2 y + 4 z.
std::vector<DVec3> cubeCorners(DVec3 low = DVec3(0), double size = 1) {
  std::vector<DVec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(low + size * DVec3(i & 1, (i >> 1) & 1, i >> 2));
  return corners;
}

const std::vector<std::vector<std::uint32_t>> kCubeFaces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

TEST(Diagnose, ACubeIsClean) {
  const MeshReport report = reportOf(soupOf(cubeCorners(), kCubeFaces));
  EXPECT_TRUE(report.clean());
  EXPECT_TRUE(report.closed());
  EXPECT_EQ(report.euler, 2);
  EXPECT_EQ(report.edges, 12u);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.high, DVec3(1));
}

TEST(Diagnose, NothingIsNotClean) {
  EXPECT_FALSE(reportOf({}).clean());
  EXPECT_FALSE(reportOf({}).closed());
}

TEST(Diagnose, GeneratedMeshesMatchTheirTopology) {
  Job job;
  EXPECT_EQ(diagnose(makeTorus(), job).euler, 0);
  EXPECT_TRUE(diagnose(makeTorus(), job).clean());
  EXPECT_TRUE(diagnose(makeBox({.cells = 3}), job).clean()) << "creases are no duplicates";
  EXPECT_EQ(diagnose(makePlane(), job).holes.count, 1u);
  EXPECT_EQ(diagnose(makePlane(), job).euler, 1);
}

TEST(Diagnose, FindsDuplicateVertices) {
  auto corners = cubeCorners();
  corners.push_back(corners[3]);
  auto faces = kCubeFaces;
  faces[0] = {0, 2, 8, 1};
  const MeshReport report = reportOf(soupOf(corners, faces));
  EXPECT_THAT(report.duplicateVertices.first, ElementsAre(8));
  EXPECT_TRUE(report.closed()) << "positions count, not indices";
  EXPECT_EQ(report.euler, 2);
}

TEST(Diagnose, ZerosOfBothSignsAreOnePosition) {
  EXPECT_EQ(reportOf(soupOf({{0, 0, 0}, {-0.0, 0, 0}}, {})).duplicateVertices.count, 1u);
}

TEST(Diagnose, FindsDegenerateFaces) {
  const MeshReport report =
      reportOf(soupOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 1, 0}},
                      {{0, 1, 3}, {0, 1, 2}, {0, 0, 1}, {0, 3, 4}, {0, 1}, {}, {0, 1, 0, 1}}));
  EXPECT_THAT(report.degenerateFaces.first, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(report.triangles, 2u) << "the collinear one spans three positions";
}

TEST(Diagnose, SmallTrianglesAreNotDegenerate) {
  EXPECT_EQ(
      reportOf(soupOf({{5, 5, 5}, {5 + 1e-9, 5, 5}, {5, 5 + 1e-9, 5}}, {{0, 1, 2}})).degenerateFaces.count,
      0u);
}

TEST(Diagnose, FindsDuplicateFacesInAnyOrder) {
  auto faces = kCubeFaces;
  faces.push_back({3, 1, 0, 2});
  faces.push_back({1, 3, 2, 0});
  const MeshReport report = reportOf(soupOf(cubeCorners(), faces));
  EXPECT_THAT(report.duplicateFaces.first, ElementsAre(6, 7));
  EXPECT_EQ(report.nonManifoldEdges.count, 4u);
}

TEST(Diagnose, FindsNonManifoldEdges) {
  const MeshReport report = reportOf(
      soupOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_THAT(report.nonManifoldEdges.first, ElementsAre(0));
  EXPECT_EQ(report.nonManifoldVertices.count, 0u);
  EXPECT_EQ(report.boundaryEdges, 6u);
}

TEST(Diagnose, FindsNonManifoldVertices) {
  const MeshReport report =
      reportOf(soupOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_THAT(report.nonManifoldVertices.first, ElementsAre(0));
  EXPECT_EQ(report.components, 1u) << "they share a position";
  EXPECT_EQ(report.holes.count, 2u) << "two triangles, two rims";
}

TEST(Diagnose, CountsHolesByLoop) {
  auto faces = kCubeFaces;
  faces.erase(faces.begin() + 5);
  faces.erase(faces.begin() + 4);
  const MeshReport report = reportOf(soupOf(cubeCorners(), faces));
  EXPECT_EQ(report.holes.count, 2u);
  EXPECT_EQ(report.boundaryEdges, 8u);
}

TEST(Diagnose, FindsUnreferencedAndNonFiniteVertices) {
  auto corners = cubeCorners();
  corners.push_back({9, 9, 9});
  corners.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  corners.push_back({0, std::numeric_limits<double>::infinity(), 0});
  auto faces = kCubeFaces;
  faces.push_back({0, 1, 10});
  const MeshReport report = reportOf(soupOf(corners, faces));
  EXPECT_THAT(report.unreferencedVertices.first, ElementsAre(8, 9));
  EXPECT_THAT(report.nonFiniteVertices.first, ElementsAre(9, 10));
  EXPECT_EQ(report.high, DVec3(1)) << "bounds are those of usable faces";
}

TEST(Diagnose, FindsIndicesOutOfRange) {
  auto faces = kCubeFaces;
  faces.push_back({0, 1, 8});
  faces.push_back({kNoIndex, 1, 2});
  EXPECT_THAT(reportOf(soupOf(cubeCorners(), faces)).outOfRangeFaces.first, ElementsAre(6, 7));
}

TEST(Diagnose, FindsFlippedFaces) {
  auto faces = kCubeFaces;
  std::reverse(faces[2].begin(), faces[2].end());
  EXPECT_EQ(reportOf(soupOf(cubeCorners(), faces)).flippedEdges.count, 4u);
}

TEST(Diagnose, FindsInsideOutSolids) {
  auto faces = kCubeFaces;
  for (auto& face : faces) std::reverse(face.begin(), face.end());
  const MeshReport report = reportOf(soupOf(cubeCorners(), faces));
  EXPECT_THAT(report.insideOut.first, ElementsAre(0));
  EXPECT_EQ(report.flippedEdges.count, 0u);
}

TEST(Diagnose, ACavityIsNotInsideOut) {
  auto corners = cubeCorners(DVec3(0), 3), inner = cubeCorners(DVec3(1), 1);
  corners.insert(corners.end(), inner.begin(), inner.end());
  auto faces = kCubeFaces;
  for (auto face : kCubeFaces) {
    std::reverse(face.begin(), face.end());
    for (std::uint32_t& v : face) v += 8;
    faces.push_back(face);
  }
  const MeshReport report = reportOf(soupOf(corners, faces));
  EXPECT_TRUE(report.clean()) << toText(report);
  EXPECT_EQ(report.closedSurfaces, 2u);
}

TEST(Diagnose, ListsTheFirstFewOnly) {
  PolygonSoup soup;
  for (int i = 0; i < 1000; ++i) soup.positions.push_back(DVec3(i));
  const MeshReport report = reportOf(soup);
  EXPECT_EQ(report.unreferencedVertices.count, 1000u);
  EXPECT_EQ(report.unreferencedVertices.first.size(), Defect::kListed);
}

TEST(Diagnose, TextIsOneLine) {
  auto faces = kCubeFaces;
  faces.pop_back();
  EXPECT_EQ(toText(reportOf(soupOf(cubeCorners(), faces))),
            "8 vertices, 5 faces, 1 component, open; 1 hole (4 boundary edges)");
  EXPECT_EQ(toText(reportOf(soupOf(cubeCorners(), kCubeFaces))),
            "8 vertices, 6 faces, 1 component, closed; no defects");
}

TEST(Diagnose, JsonHasEveryDefect) {
  auto faces = kCubeFaces;
  faces.push_back({0, 1, 99});
  const nlohmann::json json = toJson(reportOf(soupOf(cubeCorners(), faces)));
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["euler"], 2);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["defects"]["out_of_range_faces"]["count"], 1);
  EXPECT_EQ(json["defects"]["out_of_range_faces"]["first"][0], 6);
  EXPECT_EQ(json["defects"].size(), 11u);
}

TEST(Diagnose, CanBeCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(diagnose(makePlane(), job), Cancelled);
}

}  // namespace
}  // namespace prt
