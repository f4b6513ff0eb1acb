#include "tests/fuzz/mesh_harness.h"
#include "tests/fuzz/written.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return prt::fuzz::fuzzMesh(prt::parseGltf, data, size);
}

namespace {

/// Two instances of a strip and of a sparse accessor, as small as JSON goes.
constexpr char kRich[] =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1,2],"scale":[1,2,-1]},)"
    R"({"mesh":0,"rotation":[0,0,0,1],"translation":[1,2,3]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":2},"indices":1,"mode":5,"material":0}]}],)"
    R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)"
    R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},)"
    R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"},)"
    R"({"bufferView":0,"byteOffset":4,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3,"byteStride":0}],)"
    R"("buffers":[{"byteLength":39,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]})";

}  // namespace

const prt::fuzz::Target prt::fuzz::target{
    .name = "gltf",
    .seeds =
        [] {
          return joined(joined(writtenSeeds(".glb"), writtenSeeds(".gltf")), {kRich, kRich});
        },
    .words = {"\"sparse\":", "\"mode\":6,", "\"children\":[0],", "\"byteStride\":4,", "null", "[", "{",
              "\"uri\":\"a.bin\",", "18446744073709551615", "\"extensionsRequired\":[\"x\"],", "-1"},
    .runs = 30000,
    .memoryPerByte = 64 * 1024};  // instances may repeat a mesh, see gltf_reader.cpp
