#include "tests/mesh/parse.h"
#include "tests/support/temporary_folder.h"

#include "libprt/mesh/gltf_container.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>

namespace prt {
namespace {

using Json = nlohmann::json;
using test::raw;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refused(std::string_view bytes, const std::filesystem::path& folder = {}) {
  return test::refusal(parseGltf, bytes, folder);
}

template <class T>
std::string rawAll(std::initializer_list<T> values) {
  std::string bytes;
  for (T value : values) bytes += raw(value);
  return bytes;
}

/// A buffer with a triangle's positions at 0 (36 bytes), indices 0 1 2 as bytes at 36, padding to 40.
std::string triangleBuffer() {
  return rawAll<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + rawAll<std::uint8_t>({0, 1, 2, 0});
}

Json triangle(const std::string& buffer = triangleBuffer()) {
  return {
      {"asset", {{"version", "2.0"}}},
      {"buffers",
       {{{"byteLength", buffer.size()},
         {"uri", "data:application/octet-stream;base64," + encodeBase64(buffer)}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}},
        {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 4}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}}}},
      {"meshes", {{{"name", "tri"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"scenes", {{{"nodes", {0}}}}},
      {"scene", 0}};
}

PolygonSoup read(const Json& json) {
  return test::parsed(parseGltf, json.dump());
}

std::string glb(const Json& json, std::string binary) {
  std::string text = json.dump();
  while (text.size() % 4) text += ' ';
  while (binary.size() % 4) binary += '\0';
  return "glTF" + raw<std::uint32_t>(2) + raw(std::uint32_t(28 + text.size() + binary.size())) +
         raw(std::uint32_t(text.size())) + "JSON" + text + raw(std::uint32_t(binary.size())) +
         std::string("BIN\0", 4) + binary;
}

TEST(GltfReader, ReadsATriangle) {
  const PolygonSoup soup = read(triangle());
  EXPECT_THAT(soup.positions, ElementsAre(DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_EQ(soup.unit, "metres");
  EXPECT_THAT(soup.groups, ElementsAre("tri"));
}

TEST(GltfReader, ReadsGlb) {
  Json json = triangle();
  json["buffers"][0].erase("uri");
  EXPECT_THAT(test::parsed(parseGltf, glb(json, triangleBuffer())).cornerVertex, ElementsAre(0, 1, 2));
}

TEST(GltfReader, ReadsBuffersInItsFolderOnly) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "model/sub dir");
  for (const char* name : {"model/a.bin", "model/sub dir/b.bin", "outside.bin"})
    std::ofstream(folder / name, std::ios::binary) << triangleBuffer();
  const auto with = [&](const std::string& uri) {
    Json json = triangle();
    json["buffers"][0]["uri"] = uri;
    return json.dump();
  };
  EXPECT_EQ(test::parsed(parseGltf, with("a.bin"), folder / "model").faceCount(), 1u);
  EXPECT_EQ(test::parsed(parseGltf, with("sub%20dir/b.bin"), folder / "model").faceCount(), 1u);
  EXPECT_THAT(refused(with("../outside.bin"), folder / "model"), HasSubstr("not in the model's folder"));
  EXPECT_THAT(refused(with("/etc/passwd"), folder / "model"), HasSubstr("not in the model's folder"));
  EXPECT_THAT(refused(with("a.bin")), HasSubstr("not in the model's folder"));
}

TEST(GltfReader, NodesMoveTurnAndScale) {
  Json json = triangle();
  json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                   {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"scale", {2, 1, 1}}}};
  const PolygonSoup soup = read(json);  // +90 degrees about z, after scaling x by two, before moving
  EXPECT_NEAR(distance(soup.positions[1], DVec3(10, 2, 0)), 0, 1e-12);
  EXPECT_NEAR(distance(soup.positions[2], DVec3(9, 0, 0)), 0, 1e-12);
}

TEST(GltfReader, MatricesAreColumnMajorAndMirrorsKeepTheFront) {
  Json json = triangle();
  json["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const PolygonSoup soup = read(json);
  EXPECT_EQ(soup.positions[1], DVec3(4, 6, 7));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, 2, 1));
}

TEST(GltfReader, NormalsFollowUnevenScale) {
  std::string buffer = triangleBuffer();
  for (int i = 0; i < 3; ++i) buffer += rawAll<float>({std::sqrt(0.5f), std::sqrt(0.5f), 0});
  Json json = triangle(buffer);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 36}});
  json["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
  json["nodes"][0]["scale"] = {2, 1, 1};
  const PolygonSoup soup = read(json);
  EXPECT_LT(distance(soup.normals[0], normalize(Vec3(0.5f, 1, 0))), 1e-6f);
  json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_LT(distance(read(json).normals[0], normalize(Vec3(-1, 1, 0))), 1e-6f);
}

TEST(GltfReader, TextureCoordinatesAreTurnedUpAndNormalised) {
  std::string buffer = triangleBuffer() + rawAll<std::uint16_t>({0, 0, 65535, 0, 0, 65535});
  Json json = triangle(buffer);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 12}});
  json["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5123}, {"normalized", true}, {"count", 3}, {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  EXPECT_THAT(read(json).uv, ElementsAre(Vec2(0, 1), Vec2(1, 1), Vec2(0, 0)));
}

TEST(GltfReader, StripsFansAndMissingIndices) {
  const std::string buffer = rawAll<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const auto corners = [&](int mode) {
    Json json = triangle(buffer);
    json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 48}}};
    json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}};
    json["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", 0}}}, {"mode", mode}}};
    return read(json);
  };
  EXPECT_THAT(corners(5).cornerVertex, ElementsAre(0, 1, 2, 2, 1, 3));
  EXPECT_THAT(corners(6).cornerVertex, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(corners(4).cornerVertex, ElementsAre(0, 1, 2));
  EXPECT_THAT(corners(4).notes, ElementsAre(HasSubstr("incomplete")));
  EXPECT_THAT(corners(1).notes, ElementsAre(HasSubstr("points or lines")));
}

TEST(GltfReader, InstancesRepeatAMesh) {
  Json json = triangle();
  json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
  json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(read(json).faceCount(), 2u);
  json["scene"] = 7;
  EXPECT_EQ(read(json).faceCount(), 2u) << "falls back to the first scene";
  json.erase("scenes");
  EXPECT_EQ(read(json).faceCount(), 2u) << "falls back to the nodes without parents";
  json.erase("nodes");
  EXPECT_EQ(read(json).faceCount(), 1u) << "falls back to the meshes";
}

TEST(GltfReader, CyclesEnd) {
  Json json = triangle();
  json["nodes"] = {{{"mesh", 0}, {"children", {1, 99, -1}}}, {{"mesh", 0}, {"children", {0, 1}}}};
  EXPECT_EQ(read(json).faceCount(), 2u);
}

TEST(GltfReader, SmallFilesMustNotUnfoldIntoGiants) {
  std::string buffer;
  for (int i = 0; i < 3000; ++i) buffer += raw(0.0f);
  Json json = triangle(buffer);
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 12000}}};
  json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 1000}, {"type", "VEC3"}}};
  json["meshes"][0]["primitives"] = Json::array();
  for (int i = 0; i < 200; ++i)
    json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  json["nodes"] = Json::array();
  json["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 400; ++i) {
    json["nodes"].push_back({{"mesh", 0}});
    json["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_THAT(refused(json.dump()), HasSubstr("unfold"));
}

TEST(GltfReader, SparseAccessorsReplaceElements) {
  const std::string buffer = triangleBuffer() + rawAll<std::uint16_t>({1, 0}) + rawAll<float>({7, 8, 9});
  Json json = triangle(buffer);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 2}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 12}});
  Json sparse{{"count", 1},
              {"indices", {{"bufferView", 2}, {"componentType", 5123}}},
              {"values", {{"bufferView", 3}}}};
  json["accessors"][0]["sparse"] = sparse;
  EXPECT_EQ(read(json).positions[1], DVec3(7, 8, 9));
  json["accessors"][0].erase("bufferView");
  EXPECT_EQ(read(json).positions[2], DVec3(0)) << "zeros where nothing is given";
  json["accessors"][0]["count"] = 1;
  EXPECT_THAT(refused(json.dump()), HasSubstr("does not exist"));
  json["accessors"][0]["sparse"]["count"] = -1;
  EXPECT_THAT(refused(json.dump()), HasSubstr("negative"));
}

TEST(GltfReader, MaterialsHaveTheirBaseColour) {
  Json json = triangle();
  json["materials"] = {{{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}}}},
                       {{"name", "plain"}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  const PolygonSoup soup = read(json);
  EXPECT_EQ(soup.materials[0].baseColor, Rgb(1, 0.5f, 0));
  EXPECT_EQ(soup.materials[1].baseColor, Rgb(1));
  EXPECT_THAT(soup.faceMaterial, ElementsAre(0));
}

TEST(GltfReader, ImagesAndExtrasAreIgnored) {
  Json json = triangle();
  json["images"] = {{{"uri", "file:///etc/passwd"}}, 17, {{"bufferView", 99}}};
  json["textures"] = "nonsense";
  json["extras"] = {{"deep", {1, 2, 3}}};
  EXPECT_EQ(read(json).faceCount(), 1u);
}

/// What reading ends in when one thing in the triangle file is changed.
std::string refusedWith(const std::function<void(Json&)>& change) {
  Json json = triangle();
  change(json);
  return refused(json.dump());
}

TEST(GltfReader, EveryReferenceIsChecked) {
  EXPECT_THAT(refusedWith([](Json& j) { j["bufferViews"][0]["byteLength"] = 41; }),
              HasSubstr("beyond its buffer"));
  EXPECT_THAT(refusedWith([](Json& j) { j["bufferViews"][0]["byteOffset"] = 18446744073709551615u; }),
              HasSubstr("beyond its buffer"));
  EXPECT_THAT(refusedWith([](Json& j) { j["bufferViews"][0]["buffer"] = 3; }),
              HasSubstr("buffer that does not exist"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][0]["count"] = 4; }), HasSubstr("beyond buffer view"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][0]["count"] = 9007199254740993; }),
              HasSubstr("impossible count"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][0]["byteOffset"] = 18446744073709551610u; }),
              HasSubstr("beyond buffer view"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][0]["type"] = "VEC2"; }), HasSubstr("wrong type"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][0].erase("bufferView"); }), HasSubstr("no data"));
  EXPECT_THAT(refusedWith([](Json& j) { j["accessors"][1]["bufferView"] = 9; }), HasSubstr("bufferView"));
  EXPECT_THAT(refusedWith([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 5; }),
              HasSubstr("accessor that does not exist"));
  EXPECT_THAT(refusedWith([](Json& j) { j["buffers"][0]["byteLength"] = 4000000000u; }),
              HasSubstr("holds 40 of 4000000000"));
  EXPECT_THAT(refusedWith([](Json& j) { j["buffers"][0]["byteLength"] = -1; }), HasSubstr("no length"));
  EXPECT_THAT(refusedWith([](Json& j) { j["buffers"][0]["uri"] = "data:text/plain,hello"; }),
              HasSubstr("not base64"));
  EXPECT_THAT(refusedWith([](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
              HasSubstr("KHR_draco_mesh_compression"));
  EXPECT_THAT(refusedWith([](Json& j) { j["asset"].erase("version"); }), HasSubstr("asset"));
}

TEST(GltfReader, IndicesThatNameNothingAreKept) {
  std::string buffer = triangleBuffer();
  buffer[37] = char(200);
  const PolygonSoup soup = read(triangle(buffer));
  EXPECT_THAT(soup.cornerVertex, ElementsAre(0, kNoIndex, 2));
}

TEST(GltfReader, RefusesBrokenShells) {
  EXPECT_THAT(refused("{"), HasSubstr("JSON is broken"));
  EXPECT_THAT(refused("[]"), HasSubstr("not an object"));
  EXPECT_THAT(refused(std::string(100000, '[')), HasSubstr("nested too deeply"));
  EXPECT_THAT(refused("glTF"), HasSubstr("too short"));
  Json json = triangle();
  json["buffers"][0].erase("uri");
  std::string file = glb(json, triangleBuffer());
  EXPECT_THAT(refused(file.substr(0, file.size() - 8)), HasSubstr("cut off"));
  EXPECT_THAT(refused(glb(json, "")), HasSubstr("holds 0 of 40"));
  file[4] = 1;
  EXPECT_THAT(refused(file), HasSubstr("version 1"));
}

TEST(Base64, UndoesItself) {
  for (int size = 0; size < 20; ++size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += char(i * 37 + size);
    EXPECT_EQ(decodeBase64(encodeBase64(bytes)), bytes);
  }
  EXPECT_EQ(encodeBase64("light"), "bGlnaHQ=");
  EXPECT_EQ(decodeBase64("b*"), "");
}

}  // namespace
}  // namespace prt
