#include "libprt/project/products.h"

#include "libprt/core/error.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace prt {
namespace {

using nlohmann::json;

template <class V>
Array rows(const std::vector<V>& vectors) {
  using T = typename V::value_type;
  static_assert(sizeof(V) == std::size_t(V::length()) * sizeof(T));
  const T* first = vectors.empty() ? nullptr : &vectors[0][0];
  return Array::from<T>(std::span(first, vectors.size() * std::size_t(V::length())), {std::int64_t(vectors.size()), V::length()});
}

/// The reverse; the array must be [N, length of V].
template <class V>
std::vector<V> vectors(const ProductData& data, const std::string& name) {
  using T = typename V::value_type;
  const Array& array = data.array(name, dtypeOf<T>(), 2);
  if (array.shape[1] != V::length()) throw FileError("array '" + name + "' has another shape than it must", "project", "bake again");
  std::vector<V> out(std::size_t(array.shape[0]));
  if (!out.empty()) std::memcpy(out.data(), array.bytes.data(), array.bytes.size());
  return out;
}

void requireIndices(const std::vector<UVec3>& triangles, std::size_t count, const std::string& name) {
  for (const UVec3& t : triangles)
    if (t.x >= count || t.y >= count || t.z >= count)
      throw FileError("array '" + name + "' points outside the mesh", "project", "bake again");
}

std::string arrayName(const char* what, std::size_t object) { return std::string(what) + "." + std::to_string(object); }

TriMesh loadTriMesh(const ProductData& data, std::size_t object) {
  TriMesh mesh;
  mesh.positions = vectors<Vec3>(data, arrayName("positions", object));
  mesh.normals = vectors<Vec3>(data, arrayName("normals", object));
  mesh.triangles = vectors<UVec3>(data, arrayName("triangles", object));
  mesh.uv = vectors<Vec2>(data, arrayName("uv", object));
  mesh.uvTriangles = vectors<UVec3>(data, arrayName("uvTriangles", object));
  requireIndices(mesh.triangles, mesh.positions.size(), "triangles");
  requireIndices(mesh.uvTriangles, mesh.uv.size(), "uvTriangles");
  const bool uvFits = mesh.uv.empty() ? mesh.uvTriangles.empty() : mesh.uvTriangles.size() == mesh.triangles.size();
  if (mesh.normals.size() != mesh.positions.size() || !uvFits)
    throw FileError("the arrays of a mesh do not fit together", "project", "bake again");
  return mesh;
}

json metaOf(const ProductData& data) {
  json meta = json::parse(data.meta, nullptr, false);
  if (!meta.is_object()) throw FileError("a product has no description", "project", "bake again");
  return meta;
}

}  // namespace

ProductData MeshProduct::save() const {
  json meta{{"objects", json::array()}};
  ProductData data;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    meta["objects"].push_back(json::parse(reports[i]));
    data.arrays[arrayName("positions", i)] = rows(meshes[i]->positions);
    data.arrays[arrayName("normals", i)] = rows(meshes[i]->normals);
    data.arrays[arrayName("triangles", i)] = rows(meshes[i]->triangles);
    data.arrays[arrayName("uv", i)] = rows(meshes[i]->uv);
    data.arrays[arrayName("uvTriangles", i)] = rows(meshes[i]->uvTriangles);
  }
  data.meta = meta.dump();
  return data;
}

ProductPtr MeshProduct::load(ProductData data) {
  const json meta = metaOf(data);
  if (!meta.contains("objects") || !meta["objects"].is_array())
    throw FileError("the list of meshes is missing", "project", "bake again");
  auto product = std::make_shared<MeshProduct>();
  for (std::size_t i = 0; i < meta["objects"].size(); ++i) {
    product->meshes.push_back(std::make_shared<TriMesh>(loadTriMesh(data, i)));
    product->reports.push_back(meta["objects"][i].dump());
  }
  return product;
}

std::string MeshProduct::repairText(std::size_t object) const {
  return json::parse(reports[object]).value("text", "nothing to repair");
}

Scene withMaterials(Scene scene, const Recipe& recipe) {
  if (scene.materials.size() != recipe.objects.size())
    throw ValueError("the scene has another number of objects than the recipe", "objects", "bake again");
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    scene.materials[i] = recipe.objects[i].material;
    scene.names[i] = recipe.objects[i].name;
  }
  return scene;
}

}  // namespace prt
