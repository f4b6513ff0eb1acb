#include "libprt/mesh/repair.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_writer.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <random>

namespace prt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RepairedMesh repaired(const PolygonSoup& soup, const RepairOptions& options = {}) {
  Job job;
  return repair(soup, options, job);
}

double volumeOf(const TriMesh& mesh) {
  double sum = 0;
  for (const UVec3& t : mesh.triangles)
    sum += dot(DVec3(mesh.positions[t.x]), cross(DVec3(mesh.positions[t.y]), DVec3(mesh.positions[t.z]))) / 6;
  return sum;
}

double areaOf(const TriMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) sum += 0.5 * length(mesh.areaNormal(f));
  return sum;
}

/// A soup whose every face has its own three vertices.
PolygonSoup shattered(const TriMesh& mesh) {
  PolygonSoup soup;
  for (const UVec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      soup.cornerVertex.push_back(std::uint32_t(soup.positions.size()));
      soup.positions.push_back(DVec3(mesh.positions[t[i]]));
    }
    soup.endFace();
  }
  return soup;
}

PolygonSoup withoutNormals(const TriMesh& mesh) {
  PolygonSoup soup = toSoup(mesh);
  soup.normals.clear();
  soup.cornerNormal.clear();
  return soup;
}

void reverseFace(PolygonSoup& soup, std::size_t f) {
  std::reverse(soup.cornerVertex.begin() + soup.faceStart[f],
               soup.cornerVertex.begin() + soup.faceStart[f + 1]);
}

TEST(Repair, LeavesCleanMeshesAlone) {
  for (const char* name : {"vase", "bird", "box", "plane", "torus"}) {
    const TriMesh mesh = makeBuiltinMesh(name);
    const RepairedMesh result = repaired(toSoup(mesh));
    EXPECT_EQ(result.mesh.positions, mesh.positions) << name;
    EXPECT_EQ(result.mesh.triangles, mesh.triangles) << name;
    EXPECT_EQ(result.mesh.uvTriangles.size(), mesh.uvTriangles.size()) << name;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
      ASSERT_LT(distance(result.mesh.normals[v], mesh.normals[v]), 1e-6f);
    EXPECT_FALSE(result.report.changedAnything()) << name << ": " << toText(result.report);
    EXPECT_EQ(toText(result.report), "nothing to repair");
  }
}

TEST(Repair, WeldsShatteredMeshes) {
  const TriMesh sphere = makeIcosphere({.subdivisions = 3});
  const RepairedMesh result = repaired(shattered(sphere));
  EXPECT_EQ(result.mesh.vertexCount(), sphere.vertexCount());
  EXPECT_EQ(result.report.weldedVertices, 3 * sphere.triangleCount() - sphere.vertexCount());
  EXPECT_TRUE(result.report.after.clean());
}

TEST(Repair, KeepsVerticesApartWhenAsked) {
  const TriMesh sphere = makeIcosphere({.subdivisions = 1});
  const RepairedMesh result = repaired(shattered(sphere), {.weld = false});
  EXPECT_EQ(result.mesh.vertexCount(), 3 * sphere.triangleCount());
  EXPECT_EQ(result.report.weldedVertices, 0u);
}

TEST(Repair, TurnsFlippedFacesBack) {
  const TriMesh bird = makeBird({.cellsAlong = 64, .relaxations = 2});
  PolygonSoup soup = withoutNormals(bird);
  std::mt19937 random(1);
  std::size_t flipped = 0;
  for (std::size_t f = 0; f < soup.faceCount(); ++f)
    if (random() % 3 == 0) reverseFace(soup, f), ++flipped;
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.report.flippedTriangles, flipped);
  EXPECT_NEAR(volumeOf(result.mesh), volumeOf(bird), 1e-6);
  EXPECT_TRUE(result.report.after.clean());
  EXPECT_GT(result.report.before.flippedEdges.count, 0u);
}

TEST(Repair, TurnsInsideOutSolids) {
  const TriMesh torus = makeTorus();
  PolygonSoup soup = withoutNormals(torus);
  for (std::size_t f = 0; f < soup.faceCount(); ++f) reverseFace(soup, f);
  EXPECT_GT(volumeOf(repaired(soup).mesh), 0);
  EXPECT_LT(volumeOf(repaired(soup, {.orientation = Orientation::consistent}).mesh), 0)
      << "as most of it was";
  EXPECT_LT(volumeOf(repaired(soup, {.orientation = Orientation::keep}).mesh), 0);
}

TEST(Repair, TurnsNormalsWithTheirFaces) {
  PolygonSoup soup = toSoup(makeTorus());
  for (std::size_t f = 0; f < soup.faceCount(); ++f) {
    reverseFace(soup, f);
    std::reverse(soup.cornerNormal.begin() + soup.faceStart[f],
                 soup.cornerNormal.begin() + soup.faceStart[f + 1]);
  }
  for (Vec3& n : soup.normals) n = -n;  // wholly inside out, normals too
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.report.keptNormals, 3 * result.mesh.triangleCount());
  for (std::size_t f = 0; f < result.mesh.triangleCount(); ++f)
    for (int i = 0; i < 3; ++i)
      ASSERT_GT(dot(result.mesh.areaNormal(f), result.mesh.normals[result.mesh.triangles[f][i]]), 0);
}

TEST(Repair, NormalsTellTheFrontOfOpenSurfaces) {
  PolygonSoup soup = toSoup(makePlane());
  for (std::size_t f = 0; f < soup.faceCount(); ++f) reverseFace(soup, f);
  const RepairedMesh result = repaired(soup);
  EXPECT_GT(result.mesh.areaNormal(0).y, 0) << "the file's normals point up";
  EXPECT_EQ(result.report.flippedTriangles, result.mesh.triangleCount());
  soup.normals.clear();
  soup.cornerNormal.clear();
  EXPECT_LT(repaired(soup).mesh.areaNormal(0).y, 0) << "without normals the winding stands";
}

TEST(Repair, KeepsTheWallsOfCavities) {
  const TriMesh outer = makeIcosphere({.radius = 2, .subdivisions = 3}),
                inner = makeIcosphere({.radius = 1, .subdivisions = 3});
  TriMesh hollow = outer;
  for (const Vec3& p : inner.positions) hollow.positions.push_back(p);
  for (const UVec3& t : inner.triangles)
    hollow.triangles.push_back(UVec3(t.x, t.z, t.y) + std::uint32_t(outer.vertexCount()));
  hollow.normals.clear();
  const RepairedMesh result = repaired(toSoup(hollow));
  EXPECT_EQ(result.report.flippedTriangles, 0u);
  EXPECT_NEAR(volumeOf(result.mesh), volumeOf(outer) - volumeOf(inner), 1e-4);
}

TEST(Repair, MoebiusBandsStayUsable) {
  PolygonSoup soup;
  const int segments = 40;
  for (int i = 0; i < segments; ++i)
    for (int side = -1; side <= 1; side += 2) {
      const double a = 2 * kPi * i / segments, r = 1 + 0.3 * side * std::cos(a / 2);
      soup.positions.push_back({r * std::cos(a), 0.3 * side * std::sin(a / 2), r * std::sin(a)});
    }
  for (std::uint32_t i = 0; i < segments; ++i) {
    const bool seam = i + 1 == segments;
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = seam ? 1 : a + 2, d = seam ? 0 : b + 2;
    soup.cornerVertex.insert(soup.cornerVertex.end(), {a, b, d, c});
    soup.endFace();
  }
  EXPECT_EQ(repaired(soup).report.after.flippedEdges.count, 1u) << "cannot be oriented";
  const RepairedMesh cut = repaired(soup, {.splitNonManifold = true});
  EXPECT_EQ(cut.report.after.flippedEdges.count, 0u);
  EXPECT_EQ(cut.report.splitVertices, 2u);
}

TEST(Repair, DropsWhatNoRendererCanUse) {
  PolygonSoup soup = withoutNormals(makeIcosphere({.subdivisions = 2}));
  const std::size_t faces = soup.faceCount();
  const std::uint32_t nan = std::uint32_t(soup.positions.size());
  soup.positions.push_back(DVec3(std::numeric_limits<double>::quiet_NaN()));
  const auto face = [&](std::vector<std::uint32_t> corners) {
    soup.cornerVertex.insert(soup.cornerVertex.end(), corners.begin(), corners.end());
    soup.endFace();
  };
  face({0, 1, 100000});
  face({0, 1, kNoIndex});
  face({0, 1, nan});
  face({0, 1, 1});
  face({0, 1});
  face({});
  face({soup.cornerVertex[1], soup.cornerVertex[2], soup.cornerVertex[0]});
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.mesh.triangleCount(), faces);
  EXPECT_EQ(result.report.droppedOutOfRange, 2u);
  EXPECT_EQ(result.report.droppedNonFinite, 1u);
  EXPECT_EQ(result.report.droppedDegenerate, 3u);
  EXPECT_EQ(result.report.droppedDuplicates, 1u);
  EXPECT_EQ(result.report.removedVertices, 1u);
  EXPECT_TRUE(result.report.after.clean());
}

TEST(Repair, DropsDegenerateFacesWhoseNumbersOverflow) {
  PolygonSoup soup = withoutNormals(makePlane({.columns = 1, .rows = 1}));
  soup.positions.push_back({0, 0, -1e39});  // finite as a double only
  soup.positions.push_back({0, 0, 1e300});
  for (std::uint32_t far : {4u, 5u}) {
    soup.cornerVertex.insert(soup.cornerVertex.end(), {0, 0, far});
    soup.endFace();
  }
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.mesh.vertexCount(), 4u);
  EXPECT_EQ(result.report.droppedDegenerate, 2u);
}

TEST(Repair, CutsPolygonsUp) {
  PolygonSoup soup;
  soup.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}};
  soup.cornerVertex = {0, 1, 2, 3, 4};
  soup.endFace();
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.25f}, {0, 1}};
  soup.cornerUv = soup.cornerVertex;
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.mesh.triangleCount(), 3u);
  EXPECT_NEAR(areaOf(result.mesh), 2.5, 1e-6);
  EXPECT_EQ(result.report.cutPolygons, 1u);
  for (std::size_t f = 0; f < 3; ++f)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(result.mesh.uv[result.mesh.uvTriangles[f][i]],
                0.5f * Vec2(result.mesh.positions[result.mesh.triangles[f][i]]));
}

TEST(Repair, SplitsWhatIsNoManifold) {
  // Two tetrahedra that share an edge, and a third that touches them in a vertex.
  PolygonSoup soup;
  soup.positions = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},  {0, 0, 1}, {0, -1, 0},
                    {0, 0, -1}, {-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}};
  for (const std::array<std::uint32_t, 4>& t :
       {std::array<std::uint32_t, 4>{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 6, 8, 7}}) {
    const auto [a, b, c, d] = t;
    for (std::uint32_t v : {a, c, b, a, b, d, b, c, d, c, a, d}) soup.cornerVertex.push_back(v);
    for (int i = 0; i < 4; ++i) soup.faceStart.push_back(soup.faceStart.back() + 3);
  }
  const RepairedMesh whole = repaired(soup), split = repaired(soup, {.splitNonManifold = true});
  EXPECT_EQ(whole.report.after.nonManifoldEdges.count, 1u);
  EXPECT_EQ(whole.report.after.nonManifoldVertices.count, 1u);
  EXPECT_EQ(whole.report.after.components, 1u);
  EXPECT_TRUE(split.report.after.clean()) << toText(split.report.after);
  EXPECT_EQ(split.report.after.components, 3u);
  EXPECT_EQ(split.report.splitVertices, 3u);
  EXPECT_GT(volumeOf(split.mesh), 0.4) << "each faces outwards";
}

TEST(Repair, UnreferencedVerticesMayStay) {
  PolygonSoup soup = withoutNormals(makePlane({.columns = 1, .rows = 1}));
  soup.positions.insert(soup.positions.begin(), DVec3(7, 7, 7));
  for (std::uint32_t& v : soup.cornerVertex) ++v;
  EXPECT_EQ(repaired(soup).mesh.vertexCount(), 4u);
  const RepairedMesh kept = repaired(soup, {.removeUnreferenced = false});
  EXPECT_EQ(kept.mesh.vertexCount(), 5u);
  EXPECT_EQ(kept.mesh.positions[0], Vec3(7));
  EXPECT_EQ(kept.report.removedVertices, 0u);
}

TEST(Repair, CreasesDoubleVertices) {
  const PolygonSoup cube = withoutNormals(makeBox());
  EXPECT_EQ(repaired(cube).mesh.vertexCount(), 8u) << "smooth unless asked";
  const RepairedMesh sharp = repaired(cube, {.creaseAngle = float(radians(45))});
  EXPECT_EQ(sharp.mesh.vertexCount(), 24u);
  EXPECT_EQ(sharp.report.creaseVertices, 16u);
  EXPECT_TRUE(sharp.report.after.clean());
  for (std::size_t f = 0; f < 12; ++f)
    EXPECT_LT(distance(sharp.mesh.normals[sharp.mesh.triangles[f].x], normalize(sharp.mesh.areaNormal(f))),
              1e-6f);
}

TEST(Repair, BadNormalsAreComputedAgain) {
  const TriMesh sphere = makeIcosphere({.subdivisions = 2});
  PolygonSoup soup = toSoup(sphere);
  soup.normals[5] = Vec3(std::numeric_limits<float>::quiet_NaN());
  soup.normals[6] = -soup.normals[6];
  const RepairedMesh result = repaired(soup);
  EXPECT_GT(result.report.computedNormals, 8u);
  for (std::size_t v = 0; v < sphere.vertexCount(); ++v)
    EXPECT_LT(distance(result.mesh.normals[v], sphere.normals[v]), 0.05f);
  EXPECT_EQ(repaired(soup, {.keepNormals = false}).report.keptNormals, 0u);
}

TEST(Repair, MissingUvsAreFilledAndCounted) {
  PolygonSoup soup = toSoup(makePlane({.columns = 1, .rows = 1}));
  soup.cornerUv[0] = kNoIndex;
  soup.uv[soup.cornerUv[1]].x = std::numeric_limits<float>::infinity();
  const RepairedMesh result = repaired(soup);
  EXPECT_GE(result.report.filledUvs, 2u);
  for (const Vec2& uv : result.mesh.uv) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
}

TEST(Repair, MaterialsFollowTheirTriangles) {
  PolygonSoup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  soup.cornerVertex = {0, 0, 1, 0, 1, 2, 3, 0, 1, 4};
  soup.faceStart = {0, 3, 7, 10};
  soup.materials = {{.name = "a"}, {.name = "b"}, {.name = "c"}};
  soup.faceMaterial = {0, 1, 2};
  const RepairedMesh result = repaired(soup, {.orientation = Orientation::keep});
  EXPECT_THAT(result.triangleMaterial, ElementsAre(1, 1, 2));
}

TEST(Repair, FarAwayMeshesAreMovedAndKeepTheirShape) {
  const TriMesh sphere = makeIcosphere({.subdivisions = 3});
  PolygonSoup soup = withoutNormals(sphere);
  const DVec3 place(601234.5, -3978000.25, 40);
  for (DVec3& p : soup.positions) p += place;
  const RepairedMesh result = repaired(soup);
  double worst = 0;
  for (std::size_t v = 0; v < sphere.vertexCount(); ++v)
    worst =
        std::max(worst, distance(DVec3(result.mesh.positions[v]) + result.report.offset, soup.positions[v]));
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(length(result.mesh.bounds().center()), 1);
  EXPECT_EQ(repaired(soup, {.recentre = false}).report.offset, DVec3(0));
}

TEST(Repair, NearbyMeshesStayWhereTheyAre) {
  PolygonSoup soup = withoutNormals(makeIcosphere());
  for (DVec3& p : soup.positions) p += DVec3(20, 0, 0);
  EXPECT_EQ(repaired(soup).report.offset, DVec3(0));
}

std::string refusal(const PolygonSoup& soup) {
  try {
    repaired(soup);
  } catch (const GeometryError& error) {
    EXPECT_FALSE(error.fix().empty());
    return error.what();
  }
  ADD_FAILURE() << "was accepted";
  return {};
}

TEST(Repair, RefusesWhatCannotBeUsed) {
  PolygonSoup soup;
  soup.source = "thing.obj";
  EXPECT_EQ(refusal(soup), "thing.obj: holds no mesh (give a mesh with triangles or polygons)");
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(refusal(soup), HasSubstr("points but no faces"));
  soup.cornerVertex = {0, 1, 2};
  soup.endFace();
  EXPECT_THAT(refusal(soup), HasSubstr("no usable face: 4 vertices, 1 face"));
  soup.cornerVertex[2] = 3;
  for (double scale : {1e-7, 1e10}) {
    PolygonSoup scaled = soup;
    for (DVec3& p : scaled.positions) p *= scale;
    EXPECT_THAT(refusal(scaled), HasSubstr("units large"));
  }
  EXPECT_EQ(repaired(soup).mesh.triangleCount(), 1u);
  EXPECT_THROW(repaired(soup, {.creaseAngle = -1}), ValueError);
}

TEST(Repair, ManyTrianglesAreNoTrouble) {
  const TriMesh sphere = makeIcosphere({.subdivisions = 7});  // 327,680 triangles
  PolygonSoup soup = shattered(sphere);
  for (std::size_t f = 0; f < soup.faceCount(); f += 7) reverseFace(soup, f);
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.mesh.vertexCount(), sphere.vertexCount());
  EXPECT_TRUE(result.report.after.clean());
}

/// Shapes on which a search per element would take quadratic time.
TEST(Repair, HostileShapesAreNoTrouble) {
  PolygonSoup soup;
  const std::uint32_t n = 100000;
  for (std::uint32_t i = 0; i < n; ++i)
    soup.positions.push_back({double(i % 317), double(i / 317), double((i * 7919) % 1009)});
  for (std::uint32_t i = 2; i < n; ++i) {  // all triangles on one edge, in both directions, each thrice
    for (std::uint32_t v : {0u, 1u, i, 1u, 0u, i, 0u, 1u, i}) soup.cornerVertex.push_back(v);
    for (int k = 0; k < 3; ++k) soup.faceStart.push_back(soup.faceStart.back() + 3);
  }
  EXPECT_EQ(repaired(soup).report.after.nonManifoldEdges.count, 1u);
  EXPECT_EQ(repaired(soup, {.splitNonManifold = true}).report.after.nonManifoldEdges.count, 0u);
}

TEST(Repair, IsTheSameEveryTime) {
  const PolygonSoup soup = shattered(makeRock({.subdivisions = 3}));
  const TriMesh one = repaired(soup).mesh, two = repaired(soup).mesh;
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.normals, two.normals);
  EXPECT_EQ(one.triangles, two.triangles);
}

TEST(Repair, CanBeCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(repair(toSoup(makePlane()), {}, job), Cancelled);
}

TEST(Repair, ReportsInTextAndJson) {
  PolygonSoup soup = shattered(makeIcosphere({.subdivisions = 0}));
  soup.unit = "metres";
  soup.notes = {"1 point was left out"};
  reverseFace(soup, 3);
  const RepairReport report = repaired(soup).report;
  EXPECT_EQ(toText(report), "welded 48 vertices, flipped 1 triangle");
  const nlohmann::json json = toJson(report);
  EXPECT_EQ(json["welded_vertices"], 48);
  EXPECT_EQ(json["flipped_triangles"], 1);
  EXPECT_EQ(json["unit"], "metres");
  EXPECT_EQ(json["notes"][0], "1 point was left out");
  EXPECT_EQ(json["before"]["defects"]["duplicate_vertices"]["count"], 48);
  EXPECT_EQ(json["after"]["closed"], true);
}

TEST(LoadMesh, ReadsAndRepairs) {
  const test::TemporaryFolder folder;
  Job job;
  writeMesh(folder / "bird.stl", makeBird({.cellsAlong = 64, .relaxations = 1}), {}, job);
  RepairReport report;
  const TriMesh mesh = loadMesh(folder / "bird.stl", {}, job, &report);
  EXPECT_TRUE(report.after.clean());
  EXPECT_GT(report.weldedVertices, mesh.vertexCount());
  EXPECT_THROW(loadMesh(folder / "none.obj", {}, job), FileError);
  EXPECT_THROW(loadMesh(folder / "bird.xyz", {}, job), FileError);
  EXPECT_THROW(loadMesh(folder.path(), {}, job), FileError);
}

}  // namespace
}  // namespace prt
