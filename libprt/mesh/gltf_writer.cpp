#include "libprt/mesh/gltf_writer.h"

#include "libprt/core/error.h"
#include "libprt/mesh/gltf_container.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace prt {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto kReplace = Json::error_handler_t::replace;  // of names that are not UTF-8
constexpr int kFloat = 5126, kUnsigned = 5125;             // component types
constexpr int kVertexData = 34962, kIndexData = 34963;     // buffer view targets

Json vectorJson(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

class Writer {
 public:
  Writer(const TriMesh& mesh, const MeshWriteOptions& options, Job& job)
      : mesh_(mesh), options_(options), job_(job), split_(splitAtSeams(mesh)) {}

  std::string bytes(bool binary) {
    Json attributes{{"POSITION", positions()}};
    if (!mesh_.normals.empty())
      attributes["NORMAL"] =
          perVertex<Vec3>("VEC3", [&](std::size_t i) { return mesh_.normals[split_.vertex[i]]; });
    if (!mesh_.uv.empty())
      attributes["TEXCOORD_0"] = perVertex<Vec2>("VEC2", [&](std::size_t i) {
        const Vec2 uv = mesh_.uv[split_.uv[i]];
        return Vec2(uv.x, 1 - uv.y);
      });
    if (!options_.colors.empty())
      attributes["COLOR_0"] =
          perVertex<Vec3>("VEC3", [&](std::size_t i) { return options_.colors[split_.vertex[i]]; });
    if (options_.vertexNumbers)
      attributes["_VERTEX"] =
          perVertex<float>("SCALAR", [&](std::size_t i) { return float(split_.vertex[i]); });
    const int indices = view(split_.triangles.data(), split_.triangles.size() * sizeof(UVec3), kIndexData);
    accessors_.push_back({{"bufferView", indices},
                          {"componentType", kUnsigned},
                          {"count", 3 * split_.triangles.size()},
                          {"type", "SCALAR"}});
    const Json primitive{{"attributes", attributes}, {"indices", accessors_.size() - 1}, {"material", 0}};
    return binary ? glb(document(primitive, {}))
                  : document(primitive, "data:application/octet-stream;base64," + encodeBase64(buffer_))
                        .dump(-1, ' ', false, kReplace);
  }

 private:
  int view(const void* data, std::size_t size, int target) {
    job_.checkCancelled();
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}, {"target", target}});
    buffer_.append(static_cast<const char*>(data), size);
    return int(views_.size()) - 1;
  }

  template <class T, class Value>
  std::size_t perVertex(const char* type, Value value) {
    std::vector<T> data;
    data.reserve(split_.vertex.size());
    for (std::size_t i = 0; i < split_.vertex.size(); ++i) data.push_back(value(i));
    const int bufferView = view(data.data(), data.size() * sizeof(T), kVertexData);
    accessors_.push_back(
        {{"bufferView", bufferView}, {"componentType", kFloat}, {"count", data.size()}, {"type", type}});
    return accessors_.size() - 1;
  }

  std::size_t positions() {
    const std::size_t accessor =
        perVertex<Vec3>("VEC3", [&](std::size_t i) { return mesh_.positions[split_.vertex[i]]; });
    Box3 box;
    for (std::uint32_t v : split_.vertex) box.extend(mesh_.positions[v]);
    accessors_[accessor]["min"] = vectorJson(box.low);
    accessors_[accessor]["max"] = vectorJson(box.high);
    return accessor;
  }

  Json material() const {
    const Rgb c = options_.colors.empty() ? options_.baseColor : Rgb(1);
    Json made{{"pbrMetallicRoughness",
               {{"baseColorFactor", {c.x, c.y, c.z, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    if (options_.unlit) made["extensions"] = {{"KHR_materials_unlit", Json::object()}};
    return made;
  }

  Json document(const Json& primitive, const std::string& uri) const {
    Json buffer{{"byteLength", buffer_.size()}};
    if (!uri.empty()) buffer["uri"] = uri;
    Json json{{"asset", {{"version", "2.0"}, {"generator", "prt " PRT_VERSION}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes", {{{"mesh", 0}, {"name", options_.name}}}},
              {"meshes", {{{"name", options_.name}, {"primitives", {primitive}}}}},
              {"materials", Json::array({material()})},
              {"accessors", accessors_},
              {"bufferViews", views_},
              {"buffers", Json::array({buffer})}};
    if (options_.unlit) json["extensionsUsed"] = {"KHR_materials_unlit"};
    return json;
  }

  std::string glb(const Json& json) const {
    std::string text = json.dump(-1, ' ', false, kReplace), binary = buffer_;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    if (text.size() + binary.size() > 0xfffffff0u)
      throw ValueError("the mesh is too large for one GLB file", options_.name,
                       "simplify it or write a .ply");
    std::string out;
    const auto word = [&](std::uint32_t value) { out.append(reinterpret_cast<const char*>(&value), 4); };
    word(0x46546c67u);  // "glTF"
    word(2);
    word(std::uint32_t(12 + 8 + text.size() + 8 + binary.size()));
    word(std::uint32_t(text.size()));
    word(0x4e4f534au);  // "JSON"
    out += text;
    word(std::uint32_t(binary.size()));
    word(0x004e4942u);  // "BIN"
    out += binary;
    return out;
  }

  const TriMesh& mesh_;
  const MeshWriteOptions& options_;
  Job& job_;
  const SeamSplit split_;
  std::string buffer_;
  Json accessors_ = Json::array(), views_ = Json::array();
};

}  // namespace

std::string gltfBytes(const TriMesh& mesh, const MeshWriteOptions& options, bool binary, Job& job) {
  return Writer(mesh, options, job).bytes(binary);
}

}  // namespace prt
