#include "exported.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

std::string readFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in) fail(file, "cannot be read");
  return bytes;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// The elements of an accessor whose buffer view is packed, as prt writes them.
template <class T>
std::vector<T> accessor(const Json& document, std::size_t index, const std::string& binary) {
  const Json& entry = document["accessors"][index];
  const Json& view = document["bufferViews"][entry["bufferView"].get<std::size_t>()];
  const std::size_t offset =
      view.value("byteOffset", std::size_t(0)) + entry.value("byteOffset", std::size_t(0));
  std::vector<T> values(entry["count"].get<std::size_t>());
  if (offset + values.size() * sizeof(T) > binary.size()) throw std::runtime_error("reaches past the buffer");
  std::memcpy(values.data(), binary.data() + offset, values.size() * sizeof(T));
  return values;
}

Vec3 vectorOf(const Json& list) {
  return {list[0], list[1], list[2]};
}

}  // namespace

Npy readNpy(const fs::path& file) {
  const std::string bytes = readFile(file);
  if (bytes.compare(0, 7, "\x93NUMPY\x01") != 0) fail(file, "is no .npy of version 1");
  const std::size_t header = std::uint8_t(bytes[8]) | std::size_t(std::uint8_t(bytes[9])) << 8,
                    begin = 10 + header;
  const std::string text = bytes.substr(10, header);
  const bool known = text.find("'<f4'") != std::string::npos || text.find("'<i4'") != std::string::npos;
  if (!known || text.find("False") == std::string::npos) fail(file, "is not float32 or int32 in C order");
  Npy array;
  std::size_t count = 1;
  for (const char* at = text.c_str() + text.find('(') + 1; *at != ')';) {
    char* end = nullptr;
    const std::size_t extent = std::strtoul(at, &end, 10);
    if (end == at)
      ++at;  // a comma or a space
    else
      array.shape.push_back(extent), count *= extent, at = end;
  }
  if (bytes.size() - begin != 4 * count) fail(file, "has another size than its shape");
  array.words.resize(count);
  std::memcpy(array.words.data(), bytes.data() + begin, 4 * count);
  return array;
}

// A GLB is a header of three words, then chunks of length, kind, bytes: JSON first, the buffer second.
Mesh readGlb(const fs::path& file) {
  const std::string bytes = readFile(file);
  if (bytes.size() < 28 || bytes.compare(0, 4, "glTF") != 0) fail(file, "is no .glb");
  const std::size_t jsonSize = wordAt(bytes, 12);
  const Json document = Json::parse(bytes.substr(20, jsonSize));
  const std::string binary = bytes.substr(20 + jsonSize + 8);
  const Json& primitive = document["meshes"][0]["primitives"][0];
  const Json& attributes = primitive["attributes"];
  if (!attributes.contains("_VERTEX"))
    fail(file, "has no attribute _VERTEX: export it again with --gltf and --npy");
  Mesh mesh;
  mesh.positions = accessor<Vec3>(document, attributes["POSITION"], binary);
  mesh.normals = accessor<Vec3>(document, attributes["NORMAL"], binary);
  mesh.vertex = accessor<float>(document, attributes["_VERTEX"], binary);
  mesh.indices = accessor<std::uint32_t>(document, primitive["indices"], binary);
  return mesh;
}

Exported readExported(const fs::path& gltfFolder, const fs::path& npyFolder) {
  const fs::path manifestFile = npyFolder / "manifest.json";
  const Json manifest = Json::parse(readFile(manifestFile));
  if (manifest.value("format", "") != "prt-export" || manifest.value("version", 0) != 1)
    fail(manifestFile, "is not of prt export, version 1");
  const auto array = [&](const std::string& name) {
    return manifest["files"].contains(name + ".npy") ? readNpy(npyFolder / (name + ".npy")) : Npy{};
  };
  Exported all;
  all.mesh = readGlb(gltfFolder / "scene.glb");
  all.bands = manifest["bands"];
  for (const Json& c : manifest["cameras"])
    all.cameras.push_back(
        {c["name"], vectorOf(c["eye"]), vectorOf(c["target"]), vectorOf(c["up"]), c["vfov_deg"]});
  all.albedo = array("albedo");
  all.object = array("object");
  all.light = array("light");
  all.transferDiffuse = array("transfer_diffuse");
  all.transfer = array("transfer");
  all.specular = array("specular");
  all.response = array("response");
  all.full = !all.transfer.words.empty();
  return all;
}
