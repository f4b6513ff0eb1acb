// Wavefront OBJ through tinyobjloader's callbacks, behind the checks of obj_text.h.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/obj_text.h"
#include "libprt/mesh/side_file.h"
#include "libprt/mesh/text_scanner.h"

#include <istream>
#include <map>
#include <sstream>

// Compiled in with double coordinates, under a name of its own: the symbols of the library's float build
// are called the same.
#define tinyobj prt_tinyobj_double
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace prt {
namespace {

/// Names and diffuse colours of a material library; everything else in it is of no use here.
std::string namesAndColors(std::string_view text) {
  TextScanner lines(text, "mtl");
  std::ostringstream kept;
  while (!lines.atEnd()) {
    const std::string_view keyword = lines.wordOnLine();
    if (keyword == "newmtl") {
      kept << "newmtl " << lines.restOfLine().substr(0, 1024) << '\n';
    } else if (keyword == "Kd") {
      double color[3];
      bool valid = true;
      for (double& c : color) {
        const auto value = parseNumber(lines.wordOnLine());
        valid = valid && value && *value >= 0 && *value <= 1e6;
        c = value.value_or(0);
      }
      if (valid) kept << "Kd " << color[0] << ' ' << color[1] << ' ' << color[2] << '\n';
      lines.skipLine();
    } else {
      lines.skipLine();
    }
  }
  return kept.str();
}

/// Opens material libraries in the model's folder only.
class LocalMaterials : public tinyobj::MaterialReader {
 public:
  explicit LocalMaterials(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* indices, std::string* warning, std::string* error) override {
    const auto bytes = readSideFile(folder_, name, std::size_t{16} << 20);
    if (!bytes) return false;
    std::istringstream kept(namesAndColors(toUtf8(*bytes)));
    tinyobj::LoadMtl(indices, materials, &kept, warning, error);
    return !materials->empty();
  }

 private:
  std::filesystem::path folder_;
};

std::string trimmed(std::string text) {
  const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1).substr(0, 256);
}

/// Index of a name in a list that grows.
template <class Make>
std::uint32_t indexOf(std::map<std::string, std::uint32_t>& known, const std::string& name, Make make) {
  const auto [it, isNew] = known.try_emplace(name, std::uint32_t(known.size()));
  if (isNew) make();
  return it->second;
}

/// Receives the parser's callbacks.
struct SoupBuilder {
  PolygonSoup soup;
  std::vector<tinyobj::material_t> library;
  std::map<std::string, std::uint32_t> materialIndex, groupIndex;
  std::uint32_t material = kNoIndex, group = kNoIndex;
  bool hasNormals = false, hasUvs = false;

  /// OBJ counts from 1, and from the end with negative numbers; 0 names nothing.
  static std::uint32_t resolved(int index, std::size_t count) {
    if (index > 0) return std::uint32_t(index) - 1;
    if (index < 0 && std::size_t(-std::int64_t(index)) <= count)
      return std::uint32_t(std::int64_t(count) + index);
    return kNoIndex;
  }
  void addFace(const tinyobj::index_t* corners, int count) {
    for (int i = 0; i < count; ++i) {
      const tinyobj::index_t& c = corners[i];
      soup.cornerVertex.push_back(resolved(c.vertex_index, soup.positions.size()));
      soup.cornerNormal.push_back(resolved(c.normal_index, soup.normals.size()));
      soup.cornerUv.push_back(resolved(c.texcoord_index, soup.uv.size()));
      hasNormals = hasNormals || soup.cornerNormal.back() != kNoIndex;
      hasUvs = hasUvs || soup.cornerUv.back() != kNoIndex;
    }
    soup.endFace();
    soup.faceMaterial.push_back(material);
    soup.faceGroup.push_back(group);
  }
  void useMaterial(const std::string& name, int id) {
    material = indexOf(materialIndex, trimmed(name), [&] {
      SoupMaterial made{.name = trimmed(name)};
      if (id >= 0 && std::size_t(id) < library.size()) {
        const auto& kd = library[std::size_t(id)].diffuse;
        made.baseColor = Rgb(kd[0], kd[1], kd[2]);
        made.hasColor = true;
      }
      soup.materials.push_back(std::move(made));
    });
  }
  void useGroup(const std::string& name) {
    group = indexOf(groupIndex, trimmed(name), [&] { soup.groups.push_back(trimmed(name)); });
  }
};

SoupBuilder& builder(void* user) {
  return *static_cast<SoupBuilder*>(user);
}

tinyobj::callback_t callbacks() {
  tinyobj::callback_t c;
  c.vertex_cb = [](void* user, double x, double y, double z, double) {
    builder(user).soup.positions.push_back({x, y, z});
  };
  c.normal_cb = [](void* user, double x, double y, double z) {
    builder(user).soup.normals.push_back(Vec3(x, y, z));
  };
  c.texcoord_cb = [](void* user, double u, double v, double) { builder(user).soup.uv.push_back(Vec2(u, v)); };
  c.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    builder(user).addFace(corners, count);
  };
  c.usemtl_cb = [](void* user, const char* name, int id) { builder(user).useMaterial(name, id); };
  c.mtllib_cb = [](void* user, const tinyobj::material_t* materials, int count) {
    builder(user).library.assign(materials, materials + count);
  };
  c.group_cb = [](void* user, const char** names, int count) {
    std::string joined;
    for (int i = 0; i < count; ++i) joined += (i ? " " : "") + std::string(names[i]);
    builder(user).useGroup(joined);
  };
  c.object_cb = [](void* user, const char* name) { builder(user).useGroup(name); };
  return c;
}

}  // namespace

PolygonSoup parseObj(std::string_view bytes, const MeshSource& source, Job& job) {
  const std::string text = toUtf8(bytes);
  ObjText checked(text, source.name, job);
  std::istream stream(&checked);
  SoupBuilder built;
  LocalMaterials materials(source.folder);
  std::string warning, error;
  tinyobj::LoadObjWithCallback(stream, callbacks(), &built, &materials, &warning, &error);
  checked.rethrow();
  if (!error.empty()) throw FileError(error, source.name, "export the file again");

  PolygonSoup& soup = built.soup;
  soup.source = source.name;
  if (!built.hasNormals) soup.cornerNormal.clear();
  if (!built.hasUvs) soup.cornerUv.clear();
  if (soup.materials.empty()) soup.faceMaterial.clear();
  if (soup.groups.empty()) soup.faceGroup.clear();
  if (checked.ignoredElements() > 0)
    soup.notes.push_back(std::to_string(checked.ignoredElements()) +
                         " points, lines or curves were left out");
  return std::move(soup);
}

}  // namespace prt
