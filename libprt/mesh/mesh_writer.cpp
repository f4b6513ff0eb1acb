#include "libprt/mesh/mesh_writer.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/srgb.h"
#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/gltf_writer.h"
#include "libprt/mesh/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <numeric>

namespace prt {
namespace {

/// A file's bytes as they grow, with numbers in their shortest exact form.
class Out {
 public:
  explicit Out(Job& job) : job_(job) {}

  Out& text(std::string_view words) {
    bytes_.append(words);
    return *this;
  }
  template <class Number>
  Out& number(Number value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    bytes_.append(digits, end);
    return *this;
  }
  Out& numbers(const Vec3& v) { return text(" ").number(v.x).text(" ").number(v.y).text(" ").number(v.z); }
  template <class T>
  Out& raw(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  /// To be called once per element.
  void element() {
    if (++elements_ % 16384 == 0) job_.checkCancelled();
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Job& job_;
  std::string bytes_;
  std::size_t elements_ = 0;
};

std::string oneLine(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return name;
}

Vec3 encoded(const Rgb& linear) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = encodeSrgb(linear[i] > 0 ? std::min(linear[i], 1.0f) : 0.0f);
  return out;
}

std::uint8_t byteOf(float value) {
  return std::uint8_t(std::lround(255 * value));
}

std::string objText(const TriMesh& mesh, const MeshWriteOptions& options, Job& job) {
  Out out(job);
  out.text("o ").text(oneLine(options.name)).text("\n");
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    out.text("v").numbers(mesh.positions[v]);
    if (!options.colors.empty()) out.numbers(encoded(options.colors[v]));
    out.text("\n").element();
  }
  for (const Vec2& uv : mesh.uv) out.text("vt ").number(uv.x).text(" ").number(uv.y).text("\n").element();
  for (const Vec3& n : mesh.normals) out.text("vn").numbers(n).text("\n").element();
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    out.text("f");
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[f][i] + 1;
      out.text(" ").number(v);
      if (!mesh.uv.empty()) out.text("/").number(mesh.uvTriangles[f][i] + 1);
      if (!mesh.normals.empty()) out.text(mesh.uv.empty() ? "//" : "/").number(v);
    }
    out.text("\n").element();
  }
  return out.bytes();
}

std::string plyBytes(const TriMesh& mesh, const MeshWriteOptions& options, Job& job) {
  const SeamSplit split = splitAtSeams(mesh);
  const bool normals = !mesh.normals.empty(), uvs = !mesh.uv.empty(), colors = !options.colors.empty();
  Out out(job);
  out.text("ply\nformat binary_little_endian 1.0\nelement vertex ").number(split.vertex.size());
  out.text("\nproperty float x\nproperty float y\nproperty float z\n");
  if (normals) out.text("property float nx\nproperty float ny\nproperty float nz\n");
  if (uvs) out.text("property float s\nproperty float t\n");
  if (colors) out.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  out.text("element face ").number(split.triangles.size());
  out.text("\nproperty list uchar uint vertex_indices\nend_header\n");
  for (std::size_t i = 0; i < split.vertex.size(); ++i) {
    const std::uint32_t v = split.vertex[i];
    out.raw(mesh.positions[v]);
    if (normals) out.raw(mesh.normals[v]);
    if (uvs) out.raw(mesh.uv[split.uv[i]]);
    const Vec3 color = colors ? encoded(options.colors[v]) : Vec3(0);
    for (int k = 0; colors && k < 3; ++k) out.raw(byteOf(color[k]));
    out.element();
  }
  for (const UVec3& t : split.triangles) out.raw(std::uint8_t{3}).raw(t).element();
  return out.bytes();
}

std::string offText(const TriMesh& mesh, const MeshWriteOptions& options, Job& job) {
  Out out(job);
  out.text(options.colors.empty() ? "OFF\n" : "COFF\n");
  out.number(mesh.vertexCount()).text(" ").number(mesh.triangleCount()).text(" 0\n");
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vec3& p = mesh.positions[v];
    out.number(p.x).text(" ").number(p.y).text(" ").number(p.z);
    if (!options.colors.empty()) out.numbers(encoded(options.colors[v])).text(" 1");
    out.text("\n").element();
  }
  for (const UVec3& t : mesh.triangles)
    out.text("3 ").number(t.x).text(" ").number(t.y).text(" ").number(t.z).text("\n").element();
  return out.bytes();
}

std::string stlBytes(const TriMesh& mesh, const MeshWriteOptions& options, Job& job) {
  Out out(job);
  std::string header = options.name.substr(0, 80);
  if (header.starts_with("solid")) header[0] = 'S';  // which readers would take for an ascii file
  header.resize(80, ' ');
  out.text(header).raw(std::uint32_t(mesh.triangleCount()));
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    const Vec3 area = mesh.areaNormal(f);
    const float size = length(area);
    out.raw(size > 0 ? area / size : Vec3(0));
    for (int i = 0; i < 3; ++i) out.raw(mesh.positions[mesh.triangles[f][i]]);
    out.raw(std::uint16_t{0}).element();
  }
  return out.bytes();
}

}  // namespace

SeamSplit splitAtSeams(const TriMesh& mesh) {
  SeamSplit split;
  if (mesh.uv.empty()) {
    split.vertex.resize(mesh.vertexCount());
    std::iota(split.vertex.begin(), split.vertex.end(), 0u);
    split.triangles = mesh.triangles;
    return split;
  }
  DenseIndex<2> pairs(mesh.vertexCount());
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    UVec3 triangle;
    for (int i = 0; i < 3; ++i) triangle[i] = pairs.insert({mesh.triangles[f][i], mesh.uvTriangles[f][i]});
    split.triangles.push_back(triangle);
  }
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    split.vertex.push_back(pairs.key(i)[0]);
    split.uv.push_back(pairs.key(i)[1]);
  }
  return split;
}

void writeMesh(const std::filesystem::path& path, const TriMesh& mesh, const MeshWriteOptions& options,
               Job& job) {
  if (!options.colors.empty() && options.colors.size() != mesh.vertexCount())
    throw ValueError("there are " + std::to_string(options.colors.size()) + " colours for " +
                         std::to_string(mesh.vertexCount()) + " vertices",
                     path.string(), "give one per vertex");
  const std::string extension = lowerCase(path.extension().string());
  job.begin("write mesh", 0);
  if (extension == ".obj") return writeFile(path, objText(mesh, options, job));
  if (extension == ".ply") return writeFile(path, plyBytes(mesh, options, job));
  if (extension == ".off") return writeFile(path, offText(mesh, options, job));
  if (extension == ".stl") return writeFile(path, stlBytes(mesh, options, job));
  if (extension == ".gltf" || extension == ".glb")
    return writeFile(path, gltfBytes(mesh, options, extension == ".glb", job));
  throw ValueError(inQuotes(extension) + " is not an extension that meshes are written with", path.string(),
                   "use .obj .ply .off .stl .gltf .glb");
}

}  // namespace prt
