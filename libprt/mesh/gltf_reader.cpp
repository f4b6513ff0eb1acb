// glTF 2.0 through tinygltf, which reads the structure; buffers come from gltf_container.h, and every
// accessor is checked here, which tinygltf leaves to its callers.

#include "libprt/core/error.h"
#include "libprt/mesh/gltf_component.h"
#include "libprt/mesh/gltf_container.h"
#include "libprt/mesh/mesh_reader.h"

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>

// Compiled in without file access and image codecs, under a name of its own beside other builds of it.
#define tinygltf prt_tinygltf
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace prt {
namespace {

using DMat4 = glm::dmat4;
using DMat3 = glm::dmat3;

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const MeshSource& source, Job& job)
      : source_(source),
        job_(job),
        container_(openGltf(bytes, source, job)),
        cornerLimit_((1u << 16) + 128 * bytes.size()) {
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    const auto length =
        unsigned(std::min<std::size_t>(container_.json.size(), std::numeric_limits<unsigned>::max()));
    if (!parser.LoadASCIIFromString(&model_, &error, &warning, container_.json.c_str(), length, ""))
      fail(error.empty() ? "is not a glTF 2.0 file" : error);
  }

  PolygonSoup read() {
    soup_.source = source_.name;
    soup_.unit = "metres";
    readMaterials();
    readScene();
    for (const auto& [what, count] : leftOut_) soup_.notes.push_back(std::to_string(count) + " " + what);
    if (!hasNormals_) soup_.cornerNormal.clear();
    if (!hasUvs_) soup_.cornerUv.clear();
    if (soup_.materials.empty()) soup_.faceMaterial.clear();
    return std::move(soup_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw FileError(problem, source_.name, "export the file again");
  }

  void readMaterials() {
    for (const auto& material : model_.materials) {
      SoupMaterial made{.name = material.name.substr(0, 256), .baseColor = Rgb(1), .hasColor = true};
      const auto& factor = material.pbrMetallicRoughness.baseColorFactor;
      for (std::size_t i = 0; i < 3 && i < factor.size(); ++i) {
        const bool sane = std::isfinite(factor[i]) && factor[i] >= 0;
        made.baseColor[int(i)] = sane ? float(std::min(factor[i], 1e6)) : 1.0f;
      }
      soup_.materials.push_back(std::move(made));
    }
  }

  /// Walks the nodes of the scene, each at most once: a proper file's nodes form trees.
  void readScene() {
    struct Visit {
      int node;
      DMat4 toScene;
    };
    std::vector<Visit> stack;
    for (int root : rootNodes()) stack.push_back({root, DMat4(1)});
    std::reverse(stack.begin(), stack.end());
    std::vector<bool> visited(model_.nodes.size(), false);
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      if (visit.node < 0 || std::size_t(visit.node) >= model_.nodes.size() ||
          visited[std::size_t(visit.node)])
        continue;
      visited[std::size_t(visit.node)] = true;
      const tinygltf::Node& node = model_.nodes[std::size_t(visit.node)];
      const DMat4 toScene = visit.toScene * localTransform(node);
      if (node.mesh >= 0 && std::size_t(node.mesh) < model_.meshes.size())
        readMesh(model_.meshes[std::size_t(node.mesh)], node.name, toScene);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        stack.push_back({*child, toScene});
    }
    if (model_.nodes.empty())
      for (const auto& mesh : model_.meshes) readMesh(mesh, mesh.name, DMat4(1));
  }

  /// The default scene's roots, else the first's, else every node that is nobody's child.
  std::vector<int> rootNodes() const {
    if (!model_.scenes.empty()) {
      const bool valid = model_.defaultScene >= 0 && std::size_t(model_.defaultScene) < model_.scenes.size();
      return model_.scenes[valid ? std::size_t(model_.defaultScene) : 0].nodes;
    }
    std::vector<bool> isChild(model_.nodes.size(), false);
    for (const auto& node : model_.nodes)
      for (int child : node.children)
        if (child >= 0 && std::size_t(child) < isChild.size()) isChild[std::size_t(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
      if (!isChild[i]) roots.push_back(int(i));
    return roots;
  }

  static DMat4 localTransform(const tinygltf::Node& node) {
    DMat4 matrix(1);
    if (node.matrix.size() == 16) {
      for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[std::size_t(i)];
      return matrix;
    }
    if (node.rotation.size() == 4) {
      const auto& r = node.rotation;
      matrix = glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
    }
    if (node.scale.size() == 3)
      for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[std::size_t(i)];
    if (node.translation.size() == 3)
      for (int i = 0; i < 3; ++i) matrix[3][i] = node.translation[std::size_t(i)];
    return matrix;
  }

  void readMesh(const tinygltf::Mesh& mesh, const std::string& name, const DMat4& toScene) {
    soup_.groups.push_back((name.empty() ? mesh.name : name).substr(0, 256));
    for (const auto& primitive : mesh.primitives) {
      job_.checkCancelled();
      readPrimitive(primitive, toScene);
    }
  }

  void readPrimitive(const tinygltf::Primitive& primitive, const DMat4& toScene) {
    const int mode = primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      leaveOut("primitives of points or lines were left out");
      return;
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      leaveOut("primitives without positions were left out");
      return;
    }
    const std::size_t firstVertex = soup_.positions.size();
    const std::size_t vertices = readPositions(position->second, toScene);
    const std::uint32_t firstNormal = readNormals(primitive, vertices, toScene);
    const std::uint32_t firstUv = readUvs(primitive, vertices);
    const bool mirrored = glm::determinant(DMat3(toScene)) < 0;
    const std::vector<std::uint32_t> corners = primitiveCorners(primitive, vertices);
    const auto corner = [&](std::uint32_t index) {
      const bool valid = index < vertices;
      soup_.cornerVertex.push_back(valid ? std::uint32_t(firstVertex) + index : kNoIndex);
      soup_.cornerNormal.push_back(valid && firstNormal != kNoIndex ? firstNormal + index : kNoIndex);
      soup_.cornerUv.push_back(valid && firstUv != kNoIndex ? firstUv + index : kNoIndex);
    };
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      corner(a);
      corner(mirrored ? c : b);
      corner(mirrored ? b : c);
      soup_.endFace();
      const bool known = primitive.material >= 0 && std::size_t(primitive.material) < soup_.materials.size();
      soup_.faceMaterial.push_back(known ? std::uint32_t(primitive.material) : kNoIndex);
      soup_.faceGroup.push_back(std::uint32_t(soup_.groups.size() - 1));
    };
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
        face(corners[0], corners[i + 1], corners[i + 2]);
      else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1)
        face(corners[i + 1], corners[i], corners[i + 2]);
      else
        face(corners[i], corners[i + 1], corners[i + 2]);
    }
    if (step == 3 && corners.size() % 3 != 0) leaveOut("primitives end in an incomplete triangle");
  }

  std::size_t readPositions(int accessor, const DMat4& toScene) {
    const std::vector<double> values = numbers(accessor, 3);
    const std::size_t count = values.size() / 3;
    spend(count);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec4 p(values[3 * i], values[3 * i + 1], values[3 * i + 2], 1);
      soup_.positions.push_back(DVec3(toScene * p));
    }
    return count;
  }

  std::uint32_t readNormals(const tinygltf::Primitive& primitive, std::size_t vertices,
                            const DMat4& toScene) {
    const auto found = primitive.attributes.find("NORMAL");
    if (found == primitive.attributes.end()) return kNoIndex;
    const std::vector<double> values = numbers(found->second, 3);
    if (values.size() != 3 * vertices) fail("a primitive has not as many normals as positions");
    const auto first = std::uint32_t(soup_.normals.size());
    const DMat3 cofactors = cofactorMatrix(DMat3(toScene));
    for (std::size_t i = 0; i < vertices; ++i) {
      const DVec3 n = cofactors * DVec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
      const double size = length(n);
      soup_.normals.push_back(size > 0 ? Vec3(n / size) : Vec3(0));
    }
    hasNormals_ = true;
    return first;
  }

  /// Carries normals: the inverse transpose up to a positive factor, without the division.
  static DMat3 cofactorMatrix(const DMat3& m) {
    const DMat3 cofactors(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
  }

  std::uint32_t readUvs(const tinygltf::Primitive& primitive, std::size_t vertices) {
    const auto found = primitive.attributes.find("TEXCOORD_0");
    if (found == primitive.attributes.end()) return kNoIndex;
    const std::vector<double> values = numbers(found->second, 2);
    if (values.size() != 2 * vertices) fail("a primitive has not as many texture coordinates as positions");
    const auto first = std::uint32_t(soup_.uv.size());
    for (std::size_t i = 0; i < vertices; ++i) soup_.uv.push_back(Vec2(values[2 * i], 1 - values[2 * i + 1]));
    hasUvs_ = true;
    return first;
  }

  std::vector<std::uint32_t> primitiveCorners(const tinygltf::Primitive& primitive, std::size_t vertices) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
      corners.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) corners[i] = std::uint32_t(i);
    } else {
      for (double value : numbers(primitive.indices, 1))
        corners.push_back(value >= 0 && value < double(kNoIndex) ? std::uint32_t(value) : kNoIndex);
    }
    spend(primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners.size() : 3 * corners.size());
    return corners;
  }

  /// Instances may repeat a mesh; a small file must not unfold into a giant.
  void spend(std::size_t corners) {
    corners_ += corners;
    if (corners_ > cornerLimit_) fail("its instances unfold into more than the file's size can justify");
  }

  /// All values of an accessor, `components` per element, sparse substitution and normalisation done.
  std::vector<double> numbers(int index, int components) {
    if (index < 0 || std::size_t(index) >= model_.accessors.size())
      fail("names an accessor that does not exist");
    const tinygltf::Accessor& accessor = model_.accessors[std::size_t(index)];
    if (tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)) != components)
      fail("accessor " + std::to_string(index) + " has the wrong type");
    if (accessor.count > cornerLimit_) fail("accessor " + std::to_string(index) + " has an impossible count");
    std::vector<double> values(accessor.count * std::size_t(components), 0.0);
    if (accessor.bufferView >= 0) {
      const Block block = elements(accessor.bufferView, accessor.byteOffset, accessor.count,
                                   accessor.componentType, components);
      for (std::size_t i = 0; i < accessor.count; ++i)
        readElement(block, i, accessor, components, values.data() + i * components);
    } else if (!accessor.sparse.isSparse) {
      fail("accessor " + std::to_string(index) + " has no data");
    }
    if (accessor.sparse.isSparse) applySparse(accessor, components, values);
    return values;
  }

  void applySparse(const tinygltf::Accessor& accessor, int components, std::vector<double>& values) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
      fail("a sparse accessor has a negative size");
    const auto count = std::size_t(sparse.count);
    const Block places = elements(sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count,
                                  sparse.indices.componentType, 1);
    const Block replacements = elements(sparse.values.bufferView, std::size_t(sparse.values.byteOffset),
                                        count, accessor.componentType, components);
    for (std::size_t i = 0; i < count; ++i) {
      const double place =
          readComponent(places.bytes.data() + i * places.stride, sparse.indices.componentType, false);
      if (!(place >= 0 && place < double(accessor.count)))
        fail("a sparse accessor replaces an element that does not exist");
      readElement(replacements, i, accessor, components, values.data() + std::size_t(place) * components);
    }
  }

  struct Block {
    std::string_view bytes;
    std::size_t stride = 0;
  };

  /// The checked bytes of `count` elements in a buffer view.
  Block elements(int viewIndex, std::size_t offset, std::size_t count, int componentType, int components) {
    if (viewIndex < 0 || std::size_t(viewIndex) >= model_.bufferViews.size())
      fail("names a buffer view that does not exist");
    const tinygltf::BufferView& view = model_.bufferViews[std::size_t(viewIndex)];
    if (view.buffer < 0 || std::size_t(view.buffer) >= container_.buffers.size())
      fail("names a buffer that does not exist");
    const std::string_view buffer = container_.buffers[std::size_t(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
      fail("buffer view " + std::to_string(viewIndex) + " reaches beyond its buffer");
    const std::string_view bytes = buffer.substr(view.byteOffset, view.byteLength);
    const std::size_t elementSize = componentSize(componentType) * std::size_t(components);
    if (elementSize == 0) fail("an accessor has an unknown component type");
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : elementSize;
    if (count == 0) return {{}, stride};
    const bool fits = offset <= bytes.size() && elementSize <= bytes.size() - offset &&
                      count - 1 <= (bytes.size() - offset - elementSize) / stride;
    if (!fits) fail("an accessor reaches beyond buffer view " + std::to_string(viewIndex));
    return {bytes.substr(offset), stride};
  }

  static void readElement(const Block& block, std::size_t i, const tinygltf::Accessor& accessor,
                          int components, double* out) {
    const char* p = block.bytes.data() + i * block.stride;
    for (int k = 0; k < components; ++k)
      out[k] = readComponent(p + std::size_t(k) * componentSize(accessor.componentType),
                             accessor.componentType, accessor.normalized);
  }

  void leaveOut(const char* what) {
    for (auto& [known, count] : leftOut_)
      if (known == what) {
        ++count;
        return;
      }
    leftOut_.emplace_back(what, 1);
  }

  const MeshSource& source_;
  Job& job_;
  GltfContainer container_;
  tinygltf::Model model_;
  PolygonSoup soup_;
  std::vector<std::pair<std::string, std::size_t>> leftOut_;
  bool hasNormals_ = false, hasUvs_ = false;
  std::size_t corners_ = 0, cornerLimit_;
};

}  // namespace

PolygonSoup parseGltf(std::string_view bytes, const MeshSource& source, Job& job) {
  return GltfReader(bytes, source, job).read();
}

}  // namespace prt
