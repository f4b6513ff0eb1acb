// Every real mesh and every broken one, against facts measured by other parsers (the table in
// ../shared/data/README.md). "Welded" there means joined by position, as in diagnose().

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/repair.h"
#include "tests/support/shared_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace prt {
namespace {

struct Facts {
  const char* file;
  std::size_t vertices, faces, boundaryEdges, nonManifoldEdges, components, duplicateFaces, unreferenced;
  long euler;       // of closed manifolds; kUnknown otherwise
  DVec3 low, high;  // to the four digits of the table
  std::size_t repairedVertices, repairedTriangles;
};

constexpr long kUnknown = 1 << 20;

// Vertices and triangles after repair are the file's unless noted.
const Facts kFacts[] = {
    {"stanford-bunny.obj",
     35947,
     69451,
     223,
     0,
     1,
     0,
     1113,
     kUnknown,
     {-0.09469, 0.03299, -0.06187},
     {0.06101, 0.1873, 0.0588},
     34834,
     69451},
    {"bunny_3k.off",
     3485,
     6966,
     0,
     0,
     1,
     0,
     0,
     2,
     {-0.09476, 0.03299, -0.06196},
     {0.06104, 0.1874, 0.05883},
     3485,
     6966},
    {"armadillo.off",
     26002,
     52000,
     0,
     0,
     1,
     0,
     0,
     2,
     {-63.5, -54.2, -57.7},
     {63.52, 97.11, 57.72},
     26002,
     52000},
    {"xyzrgb_dragon.obj",
     14101,
     28198,
     0,
     0,
     1,
     0,
     0,
     2,
     {-98.83, -41.31, -57.21},
     {103.1, 49.32, 77.03},
     14101,
     28198},
    // 1254 of its faces lie on others; with their fins gone 45,687 are left.
    {"dragon_vrip_res3.ply",
     22998,
     47794,
     0,
     2094,
     1,
     1254,
     16,
     kUnknown,
     {-0.1077, 0.05277, -0.05005},
     {0.09598, 0.1966, 0.04083},
     22804,
     45687},
    // 24 faces lie on others: 18 pairs are fins and go altogether.
    {"happy_buddha.obj",
     49950,
     100000,
     0,
     50,
     1,
     24,
     0,
     kUnknown,
     {-0.461, -1.002, -0.3239},
     {0.3522, 0.9775, 0.4902},
     49948,
     99958},
    {"scorpion_low_resolution.obj",
     6315,
     12626,
     0,
     0,
     1,
     0,
     0,
     2,
     {-3.315, 0.06068, -3.824},
     {3.299, 6.505, 3.964},
     6315,
     12626},
    // 403 vertices lie on others.
    {"teapot.obj", 3644, 6320, 160, 0, 3, 0, 0, kUnknown, {-3, 0, -2}, {3.434, 3.15, 2}, 3241, 6320},
    // 80 triangles without area go (the table counts their edges as non-manifold, diagnose() leaves them
    // out); creases of its normals double 134 vertices.
    {"teapot_disney.obj",
     3242,
     6400,
     160,
     0,
     4,
     0,
     0,
     kUnknown,
     {-7.5, -5.029e-20, -5},
     {8.585, 7.875, 5},
     3376,
     6320},
    {"spot.obj",
     2930,
     5856,
     0,
     0,
     1,
     0,
     0,
     2,
     {-0.4716, -0.7368, -0.6689},
     {0.4716, 0.9536, 1.049},
     2930,
     5856},
    {"spot_quadrangulated.obj",
     2930,
     2928,
     0,
     0,
     1,
     0,
     0,
     2,
     {-0.4716, -0.7368, -0.6689},
     {0.4716, 0.9536, 1.049},
     2930,
     5856},
    {"mountain.obj",
     25600,
     50562,
     636,
     0,
     1,
     0,
     0,
     kUnknown,
     {-15.56, 7.056, -14.42},
     {17.43, 24.91, 18.56},
     25600,
     50562},
    {"goblet_vase.stl",
     32730,
     10910,
     0,
     0,
     1,
     0,
     0,
     2,
     {-42.43, -42.53, -10.74},
     {42.34, 42.24, 88.26},
     5457,
     10910},
    {"blackVase.ply",
     17337,
     31366,
     4540,
     2,
     27,
     0,
     0,
     kUnknown,
     {-109.1, -120, 16.67},
     {153.3, 141.6, 407.8},
     17337,
     31366},
    {"lucy.ply", 49987, 99970, 0, 0, 1, 0, 0, 2, {225.9, -388.4, -605.9}, {1156, 145.3, 991.3}, 49987, 99970},
    {"horse.ply",
     48485,
     96966,
     0,
     0,
     1,
     0,
     0,
     2,
     {-0.042, -0.09167, -0.07642},
     {0.042, 0.09167, 0.07642},
     48485,
     96966},
    {"nefertiti.obj",
     49971,
     99938,
     0,
     0,
     1,
     0,
     0,
     2,
     {-119.3, -181.3, -247.3},
     {119.4, 181.2, 247.3},
     49971,
     99938},
    {"cheese.off", 8629, 17786, 0, 0, 1, 0, 0, -264, {-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, 8629, 17786},
    {"blobby.off",
     2027,
     4050,
     0,
     0,
     1,
     0,
     0,
     2,
     {-0.4909, -0.225, -0.1986},
     {0.3207, 0.2349, 0.2001},
     2027,
     4050},
};

void expectUsable(const TriMesh& mesh) {
  ASSERT_GT(mesh.triangleCount(), 0u);
  ASSERT_EQ(mesh.normals.size(), mesh.vertexCount());
  for (const Vec3& p : mesh.positions) ASSERT_TRUE(isFinite(p));
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(length(n), 1, 1e-5);
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    for (int i = 0; i < 3; ++i) ASSERT_LT(mesh.triangles[f][i], mesh.vertexCount());
    ASSERT_GT(length(mesh.areaNormal(f)), 0);
  }
  ASSERT_EQ(mesh.uvTriangles.size(), mesh.uv.empty() ? 0 : mesh.triangleCount());
  for (const UVec3& t : mesh.uvTriangles)
    for (int i = 0; i < 3; ++i) ASSERT_LT(t[i], mesh.uv.size());
}

class RealMesh : public testing::TestWithParam<Facts> {};

TEST_P(RealMesh, HasTheFactsOfTheTable) {
  PRT_NEEDS_SHARED_DATA();
  const Facts& facts = GetParam();
  Job job;
  const MeshReport report =
      diagnose(readMesh(test::sharedData(std::string("meshes/") + facts.file), job), job);
  EXPECT_EQ(report.vertices, facts.vertices);
  EXPECT_EQ(report.faces, facts.faces);
  EXPECT_EQ(report.boundaryEdges, facts.boundaryEdges);
  EXPECT_EQ(report.nonManifoldEdges.count, facts.nonManifoldEdges);
  EXPECT_EQ(report.components, facts.components);
  EXPECT_EQ(report.duplicateFaces.count, facts.duplicateFaces);
  EXPECT_EQ(report.unreferencedVertices.count, facts.unreferenced);
  if (facts.euler != kUnknown) {
    EXPECT_EQ(report.euler, facts.euler);
    EXPECT_TRUE(report.closed());
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(report.low[i], facts.low[i], 6e-4 * std::abs(facts.low[i]));
    EXPECT_NEAR(report.high[i], facts.high[i], 6e-4 * std::abs(facts.high[i]));
  }
}

TEST_P(RealMesh, IsRepairedToAUsableMesh) {
  PRT_NEEDS_SHARED_DATA();
  const Facts& facts = GetParam();
  Job job;
  RepairReport report;
  const TriMesh mesh = loadMesh(test::sharedData(std::string("meshes/") + facts.file), {}, job, &report);
  expectUsable(mesh);
  EXPECT_EQ(mesh.vertexCount(), facts.repairedVertices);
  EXPECT_EQ(mesh.triangleCount(), facts.repairedTriangles);
  EXPECT_EQ(report.after.degenerateFaces.count + report.after.duplicateFaces.count, 0u);
  if (facts.euler != kUnknown) {
    EXPECT_TRUE(report.after.clean()) << toText(report.after);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, RealMesh, testing::ValuesIn(kFacts), [](const auto& facts) {
  std::string name = facts.param.file;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

TEST(RealMeshes, AreAllInTheTable) {
  PRT_NEEDS_SHARED_DATA();
  std::set<std::string> known;
  for (const Facts& facts : kFacts) known.insert(facts.file);
  for (const auto& entry : std::filesystem::directory_iterator(test::sharedData("meshes"))) {
    if (entry.path().extension() == ".png") continue;
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
  }
}

/// Loads every file of a folder; each ends in a usable mesh or in an Error of one line. Returns the names
/// of those that were refused.
std::set<std::string> refusedIn(const char* folder) {
  std::set<std::string> refused;
  for (const auto& entry : std::filesystem::directory_iterator(test::sharedData(folder))) {
    const std::string name = entry.path().filename().string();
    Job job;
    try {
      RepairReport report;
      const TriMesh mesh = loadMesh(entry.path(), {}, job, &report);
      expectUsable(mesh);
      EXPECT_EQ(toText(report).find('\n'), std::string::npos);
    } catch (const Error& error) {
      refused.insert(name);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_NE(error.where().find(name), std::string::npos) << "says which file";
      EXPECT_FALSE(error.fix().empty()) << name;
    }
  }
  return refused;
}

TEST(BrokenMeshes, EndInAnErrorOrARepairedMesh) {
  PRT_NEEDS_SHARED_DATA();
  EXPECT_THAT(refusedIn("badmeshes"),
              testing::UnorderedElementsAre(
                  "BoxWithInfinites.glb", "IndexOutOfRange.bin", "empty.obj", "empty.ply", "empty_0bytes.obj",
                  "empty_0bytes.ply", "invalid.off", "issue623.ply", "number_formats.obj", "obj_points.obj",
                  "ply_empty_header.ply", "points_emptyface.ply"));
}

TEST(GltfMeshes, AllLoad) {
  PRT_NEEDS_SHARED_DATA();
  EXPECT_THAT(refusedIn("gltf"), testing::IsEmpty());
}

MeshReport reportOf(const char* file) {
  Job job;
  return diagnose(readMesh(test::sharedData(file), job), job);
}

TEST(GltfMeshes, HaveTheFactsOfTheTable) {
  PRT_NEEDS_SHARED_DATA();
  struct Counts {
    const char* file;
    std::size_t vertices, faces, duplicateVertices;
    long euler;
  };
  // The truck's wheels and the engine's parts are instances: there are more faces than the file stores.
  for (const Counts& expected :
       {Counts{"BoxTextured.glb", 24, 12, 16, 2}, Counts{"cubevc.glb", 54, 48, 28, 2},
        Counts{"no_indices_3storybuilding.glb", 216, 72, 192, 18},
        Counts{"CesiumMilkTruck.glb", 2978 + 586, 2856 + 768, 1526 + 198, 24}}) {
    const MeshReport report = reportOf((std::string("gltf/") + expected.file).c_str());
    EXPECT_EQ(report.vertices, expected.vertices) << expected.file;
    EXPECT_EQ(report.faces, expected.faces) << expected.file;
    EXPECT_EQ(report.duplicateVertices.count, expected.duplicateVertices) << expected.file;
    EXPECT_EQ(report.euler, expected.euler) << expected.file;
  }
}

TEST(BrokenMeshes, AreDiagnosed) {
  PRT_NEEDS_SHARED_DATA();
  EXPECT_EQ(reportOf("badmeshes/soup.stl").components, 100u);
  EXPECT_EQ(reportOf("badmeshes/soup.stl").boundaryEdges, 300u);
  EXPECT_EQ(reportOf("badmeshes/truck.obj").components, 50u);
  EXPECT_EQ(reportOf("badmeshes/truck.obj").boundaryEdges, 1388u);
  EXPECT_EQ(reportOf("badmeshes/truck.obj").nonManifoldEdges.count, 54u);
  EXPECT_EQ(reportOf("badmeshes/elephant-with-holes.off").boundaryEdges, 1353u);
  EXPECT_EQ(reportOf("badmeshes/elephant-with-holes.off").duplicateVertices.count, 65u);
  EXPECT_EQ(reportOf("badmeshes/degtri_sliding.off").degenerateFaces.count, 4u);
  EXPECT_EQ(reportOf("badmeshes/joined_tetrahedra.obj").nonManifoldEdges.count, 3u);
  EXPECT_EQ(reportOf("badmeshes/joined_tetrahedra.obj").duplicateFaces.count, 1u);
  EXPECT_EQ(reportOf("badmeshes/IndexOutOfRange.gltf").outOfRangeFaces.count, 1u);
  EXPECT_EQ(reportOf("badmeshes/BoxWithInfinites.glb").nonFiniteVertices.count, 24u);
  EXPECT_EQ(reportOf("badmeshes/gebco7510_49cl.stl").euler, 4);
  EXPECT_EQ(reportOf("badmeshes/gebco7510_49cl.stl").components, 2u);
  EXPECT_EQ(reportOf("badmeshes/negative_indices.obj").euler, 2);
  EXPECT_EQ(reportOf("badmeshes/box_UTF16BE.obj").euler, 2);
  EXPECT_EQ(reportOf("badmeshes/nancolor.obj").nonFiniteVertices.count, 0u);
  EXPECT_EQ(reportOf("gltf/no_indices_3storybuilding.glb").duplicateFaces.count, 8u);
  EXPECT_EQ(reportOf("gltf/no_indices_3storybuilding.glb").nonManifoldEdges.count, 26u);
}

TEST(BrokenMeshes, FarAwayMeshKeepsItsShape) {
  PRT_NEEDS_SHARED_DATA();
  Job job;
  RepairReport report;
  const TriMesh mesh = loadMesh(test::sharedData("badmeshes/gebco7510_49cl.stl"), {}, job, &report);
  EXPECT_NEAR(report.offset.x, 6.015e5, 1e4);
  EXPECT_NEAR(report.offset.y, 3.978e6, 1e4);
  const Box3 box = mesh.bounds();
  EXPECT_LT(length(box.center()), 0.6f * box.diagonal());
  EXPECT_NEAR(double(box.low.x) + report.offset.x, 5.995e5, 50);
}

}  // namespace
}  // namespace prt
