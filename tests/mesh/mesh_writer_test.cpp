#include "libprt/mesh/mesh_writer.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/repair.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace prt {
namespace {

using testing::HasSubstr;

/// What a mesh shows, whatever the numbering: normal and texture coordinate by the positions of the side
/// that starts at the corner.
std::map<std::array<float, 6>, std::array<float, 5>> cornersOf(const TriMesh& mesh, bool normals, bool uvs) {
  std::map<std::array<float, 6>, std::array<float, 5>> corners;
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.positions[mesh.triangles[f][i]], b = mesh.positions[mesh.triangles[f][(i + 1) % 3]];
      const Vec3 n = normals ? mesh.normals[mesh.triangles[f][i]] : Vec3(0);
      const Vec2 uv = uvs ? mesh.uv[mesh.uvTriangles[f][i]] : Vec2(0);
      corners[{a.x, a.y, a.z, b.x, b.y, b.z}] = {n.x, n.y, n.z, uv.x, uv.y};
    }
  return corners;
}

/// The same sides, normals and texture coordinates; those may differ in their last bits.
bool same(const TriMesh& a, const TriMesh& b, bool normals, bool uvs) {
  const auto one = cornersOf(a, normals, uvs), two = cornersOf(b, normals, uvs);
  return one.size() == two.size() &&
         std::equal(one.begin(), one.end(), two.begin(), [](const auto& x, const auto& y) {
           bool close = x.first == y.first;
           for (std::size_t i = 0; i < 5; ++i) close = close && std::abs(x.second[i] - y.second[i]) < 2e-7f;
           return close;
         });
}

struct FormatCase {
  const char* extension;
  bool normals, uvs;
};

class MeshFormat : public testing::TestWithParam<FormatCase> {};

TEST_P(MeshFormat, GivesBackWhatWasWritten) {
  const auto [extension, normals, uvs] = GetParam();
  const test::TemporaryFolder folder;
  Job job;
  for (const char* name : {"vase", "box", "icosphere", "plane"}) {
    const TriMesh mesh = makeBuiltinMesh(name);
    const auto path = folder / (std::string(name) + extension);
    writeMesh(path, mesh, {}, job);
    const TriMesh back = loadMesh(path, {.orientation = Orientation::keep}, job);
    EXPECT_TRUE(same(back, mesh, normals, uvs && !mesh.uv.empty())) << name << extension;
    EXPECT_EQ(back.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(folder.entries(), 1) << "no temporary file is left";
    std::filesystem::remove(path);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormat,
                         testing::Values(FormatCase{".obj", true, true}, FormatCase{".ply", true, true},
                                         FormatCase{".gltf", true, true}, FormatCase{".glb", true, true},
                                         FormatCase{".off", false, false}, FormatCase{".stl", false, false}),
                         [](const auto& format) { return std::string(format.param.extension + 1); });

std::string written(const std::string& name, const TriMesh& mesh, const MeshWriteOptions& options = {}) {
  const test::TemporaryFolder folder;
  Job job;
  writeMesh(folder / name, mesh, options, job);
  const auto bytes = readFile(folder / name);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TriMesh oneTriangle() {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1f}};
  mesh.normals.assign(3, Vec3(0, 0, 1));
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(MeshWriter, ObjIsPlainText) {
  EXPECT_EQ(written("a.obj", oneTriangle(), {.name = "my\nthing"}),
            "o my thing\nv 0 0 0\nv 1 0 0\nv 0 1 0.1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//3\n");
}

TEST(MeshWriter, ColoursAreSrgbWhereProgramsExpectIt) {
  const std::vector<Rgb> colors{Rgb(0), Rgb(0.5f), Rgb(2, -1, 1)};
  const std::string off = written("a.off", oneTriangle(), {.colors = colors});
  EXPECT_THAT(off, HasSubstr("COFF\n3 1 0\n0 0 0 0 0 0 1\n1 0 0 0.7353"));
  EXPECT_THAT(off, HasSubstr("1 0 1 1\n3 0 1 2"));
  EXPECT_THAT(written("a.obj", oneTriangle(), {.colors = colors}), HasSubstr("v 0 1 0.1 1 0 1\n"));
  const std::string ply = written("a.ply", oneTriangle(), {.colors = colors});
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(std::uint8_t(ply[body + 27 + 24]), 188)
      << "second vertex, red: position and normal take 24 bytes";
  EXPECT_EQ(std::uint8_t(ply[body + 54 + 24]), 255);
  EXPECT_EQ(std::uint8_t(ply[body + 54 + 25]), 0);
}

TEST(MeshWriter, GltfIsWhatValidatorsWant) {
  const std::vector<Rgb> colors(3, Rgb(0.25f));
  const nlohmann::json json = nlohmann::json::parse(
      written("a.gltf", oneTriangle(), {.colors = colors, .name = "thing", .unlit = true}));
  EXPECT_EQ(json["asset"]["version"], "2.0");
  EXPECT_EQ(json["scenes"][0]["nodes"], nlohmann::json({0}));
  EXPECT_EQ(json["nodes"][0]["mesh"], 0);
  EXPECT_EQ(json["nodes"][0]["name"], "thing");
  EXPECT_EQ(json["extensionsUsed"], nlohmann::json({"KHR_materials_unlit"}));
  EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  const nlohmann::json& primitive = json["meshes"][0]["primitives"][0];
  const auto accessor = [&](const nlohmann::json& index) {
    return json["accessors"][index.get<std::size_t>()];
  };
  EXPECT_EQ(accessor(primitive["attributes"]["POSITION"])["max"], nlohmann::json({1.0, 1.0, 0.1f}));
  EXPECT_EQ(accessor(primitive["attributes"]["COLOR_0"])["type"], "VEC3");
  EXPECT_EQ(accessor(primitive["indices"])["count"], 3);
  for (const auto& view : json["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
}

TEST(MeshWriter, GlbChunksAreAligned) {
  for (std::size_t length = 1; length < 6; ++length) {
    const std::string glb = written("a.glb", oneTriangle(), {.name = std::string(length, 'x')});
    std::uint32_t total = 0, json = 0;
    std::memcpy(&total, glb.data() + 8, 4);
    std::memcpy(&json, glb.data() + 12, 4);
    EXPECT_EQ(total, glb.size());
    EXPECT_EQ(json % 4, 0u);
    EXPECT_EQ(glb.substr(20 + json + 4, 3), "BIN");
  }
}

TEST(MeshWriter, BinaryStlNeverBeginsWithSolid) {
  EXPECT_EQ(written("a.stl", oneTriangle(), {.name = "solid thing"}).substr(0, 5), "Solid");
  EXPECT_EQ(written("a.stl", oneTriangle()).size(), 134u);
}

TEST(MeshWriter, SeamsDoubleVertices) {
  const TriMesh sphere = makeSphere({.segments = 8, .rings = 4});
  const SeamSplit split = splitAtSeams(sphere);
  EXPECT_GT(split.vertex.size(), sphere.vertexCount());
  for (std::size_t f = 0; f < sphere.triangleCount(); ++f)
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(split.vertex[split.triangles[f][i]], sphere.triangles[f][i]);
      EXPECT_EQ(split.uv[split.triangles[f][i]], sphere.uvTriangles[f][i]);
    }
  EXPECT_EQ(splitAtSeams(makeIcosphere()).triangles, makeIcosphere().triangles);
}

TEST(MeshWriter, RefusesWhatItCannotWrite) {
  const test::TemporaryFolder folder;
  Job job;
  EXPECT_THROW(writeMesh(folder / "a.fbx", oneTriangle(), {}, job), ValueError);
  EXPECT_THROW(writeMesh(folder / "none/a.obj", oneTriangle(), {}, job), FileError);
  const std::vector<Rgb> two(2);
  EXPECT_THROW(writeMesh(folder / "a.obj", oneTriangle(), {.colors = two}, job), ValueError);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(MeshWriter, CancelledWritesLeaveNothing) {
  const test::TemporaryFolder folder;
  Job job;
  job.cancel();
  const TriMesh sphere = makeIcosphere({.subdivisions = 6});
  for (const char* extension : {".obj", ".ply", ".off", ".stl", ".glb"})
    EXPECT_THROW(writeMesh(folder / (std::string("a") + extension), sphere, {}, job), Cancelled);
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace prt
