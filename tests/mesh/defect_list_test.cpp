#include "libprt/mesh/defect_list.h"

#include "tests/mesh/parse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace prt {
namespace {

/// A cube of quads without its top, the front wound the wrong way, a doubled face, a face without area and a
/// lone vertex.
PolygonSoup brokenCube(DVec3 at = DVec3(0)) {
  PolygonSoup soup;
  for (int i = 0; i < 8; ++i) soup.positions.push_back(at + DVec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  soup.positions.push_back(at + DVec3(0.5, 3, 0.5));  // 8: used by nobody
  const auto face = [&](std::initializer_list<std::uint32_t> corners) {
    soup.cornerVertex.insert(soup.cornerVertex.end(), corners);
    soup.endFace();
  };
  face({0, 1, 5, 4});  // bottom
  face({6, 7, 5, 4});  // front, turned over
  face({1, 0, 2, 3});  // back
  face({0, 4, 6, 2});
  face({5, 1, 3, 7});
  face({0, 4, 6, 2});  // once more
  face({0, 1, 1});     // no area
  return soup;
}

RepairReport repaired(const PolygonSoup& soup, const RepairOptions& options = {}) {
  Job job;
  return repair(soup, options, job).report;
}

const DefectLine* find(const std::vector<DefectLine>& lines, DefectKind kind) {
  for (const DefectLine& line : lines)
    if (line.kind == kind) return &line;
  return nullptr;
}

TEST(DefectList, TellsWhatWasFoundAndWhatBecameOfIt) {
  const std::vector<DefectLine> lines = defectLines(repaired(brokenCube()));
  const auto outcome = [&](DefectKind kind) {
    const DefectLine* line = find(lines, kind);
    return line ? std::to_string(line->found) + " " + line->outcome() : "none";
  };
  EXPECT_EQ(outcome(DefectKind::Holes), "1 left open");
  EXPECT_EQ(outcome(DefectKind::DegenerateFaces), "1 dropped");
  EXPECT_EQ(outcome(DefectKind::DuplicateFaces), "1 dropped");
  EXPECT_EQ(outcome(DefectKind::UnreferencedVertices), "1 removed");
  EXPECT_EQ(outcome(DefectKind::OutOfRangeFaces), "none");
  const DefectLine* flipped = find(lines, DefectKind::FlippedEdges);
  ASSERT_TRUE(flipped);
  EXPECT_EQ(flipped->left, 0u);
  EXPECT_EQ(flipped->severity(), DefectSeverity::Mended);
  EXPECT_EQ(lines.front().kind, DefectKind::Holes) << "what is left comes first";
}

TEST(DefectList, PlacesAreThoseOfTheDefects) {
  const std::vector<DefectLine> lines = defectLines(repaired(brokenCube()));
  const DefectPlaces& hole = find(lines, DefectKind::Holes)->places;
  EXPECT_EQ(hole.shape, DefectPlaces::Edges);
  ASSERT_EQ(hole.elements(), 1u) << "one loop";
  ASSERT_EQ(hole.positions.size(), 8u) << "of four edges";
  for (const DVec3& p : hole.positions) EXPECT_EQ(p.y, 1) << "around the open top";
  const DefectPlaces& lone = find(lines, DefectKind::UnreferencedVertices)->places;
  ASSERT_EQ(lone.positions.size(), 1u);
  EXPECT_EQ(lone.positions[0], DVec3(0.5, 3, 0.5));
  const DefectPlaces& twice = find(lines, DefectKind::DuplicateFaces)->places;
  EXPECT_EQ(twice.shape, DefectPlaces::Triangles);
  EXPECT_EQ(twice.positions.size(), 6u);
  for (const DVec3& p : twice.positions) EXPECT_EQ(p.x, 0) << "the left side";
}

/// A mesh that was moved home takes the places of its defects with it.
TEST(DefectList, PlacesAreInTheFrameOfTheRepairedMesh) {
  const RepairReport report = repaired(brokenCube({4e6, 0, 0}));
  ASSERT_NE(report.offset, DVec3(0));
  for (const DefectLine& line : defectLines(report))
    for (const DVec3& p : line.places.positions) EXPECT_LT(length(p), 10) << defectKey(line.kind);
}

TEST(DefectList, PlacesAreBounded) {
  PolygonSoup soup;  // many separate triangles, all doubled
  for (std::uint32_t i = 0; i < 5000; ++i) {
    for (std::uint32_t corner = 0; corner < 6; ++corner) {
      soup.positions.emplace_back(2.0 * i + (corner % 3 == 1), corner % 3 == 2, 0);
      soup.cornerVertex.push_back(6 * i + corner);
      if (corner % 3 == 2) soup.endFace();
    }
  }
  for (const DefectLine& line : defectLines(repaired(soup))) {
    EXPECT_LE(line.places.positions.size(), DefectPlaces::kMost);
    EXPECT_EQ(line.places.starts.back(), line.places.positions.size());
    for (const std::uint32_t s : line.places.starts) EXPECT_EQ(s % line.places.shape, 0u);
    if (line.kind == DefectKind::DuplicateFaces) {
      EXPECT_EQ(line.places.elements(), DefectPlaces::kMost / 3);
    }
  }
}

TEST(DefectList, WhatIsLeftInAFileThatIsKeptAsItIsIsAWarning) {
  RepairOptions options;
  options.orientation = Orientation::keep;
  const std::vector<DefectLine> lines = defectLines(repaired(brokenCube(), options));
  const DefectLine* flipped = find(lines, DefectKind::FlippedEdges);
  ASSERT_TRUE(flipped);
  EXPECT_GT(flipped->left, 0u);
  EXPECT_EQ(flipped->severity(), DefectSeverity::Warning);
  EXPECT_EQ(flipped->places.shape, DefectPlaces::Edges);
  EXPECT_EQ(flipped->places.elements(), flipped->left);
}

TEST(DefectList, VerticesThatAreNotWeldedAreKept) {
  PolygonSoup soup = brokenCube();
  soup.positions.push_back(soup.positions[2]);
  soup.cornerVertex[10] = std::uint32_t(soup.positions.size() - 1);
  const auto lineOf = [&](bool weld) {
    RepairOptions options;
    options.weld = weld;
    return *find(defectLines(repaired(soup, options)), DefectKind::DuplicateVertices);
  };
  EXPECT_EQ(lineOf(true).outcome(), "welded");
  EXPECT_EQ(lineOf(false).outcome(), "kept");
}

TEST(DefectList, LostFacesAreAWarning) {
  PolygonSoup soup = brokenCube();
  soup.cornerVertex[0] = 77;
  const std::vector<DefectLine> lines = defectLines(repaired(soup));
  const DefectLine* lost = find(lines, DefectKind::OutOfRangeFaces);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->severity(), DefectSeverity::Warning);
  EXPECT_EQ(lost->places.positions.size(), 3u) << "the corners that there are";
}

TEST(DefectList, KeysAreNamesOfTheirKinds) {
  std::set<std::string> seen;
  for (int i = 0; i < kDefectKinds; ++i) {
    const auto kind = DefectKind(i);
    EXPECT_EQ(defectKind(defectKey(kind)), kind);
    EXPECT_TRUE(seen.insert(defectName(kind, 2)).second);
    EXPECT_GT(std::string(defectMeaning(kind)).size(), 20u);
  }
  EXPECT_FALSE(defectKind("other"));
}

}  // namespace
}  // namespace prt
