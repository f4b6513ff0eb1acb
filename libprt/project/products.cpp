#include "libprt/project/products.h"

#include "libprt/core/error.h"
#include "libprt/project/product_rows.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace prt {
namespace {

using nlohmann::json;

template <class V>
Array rows(const std::vector<V>& vectors) {
  using T = typename V::value_type;
  static_assert(sizeof(V) == std::size_t(V::length()) * sizeof(T));
  const T* first = vectors.empty() ? nullptr : &vectors[0][0];
  return Array::from<T>(std::span(first, vectors.size() * std::size_t(V::length())),
                        {std::int64_t(vectors.size()), V::length()});
}

/// The reverse; the array must be [N, length of V].
template <class V>
std::vector<V> vectors(const ProductData& data, const std::string& name) {
  using T = typename V::value_type;
  const Array& array = data.array(name, dtypeOf<T>(), 2);
  if (array.shape[1] != V::length())
    throw FileError("array '" + name + "' has another shape than it must", "project", "bake again");
  std::vector<V> out(std::size_t(array.shape[0]));
  if (!out.empty()) std::memcpy(out.data(), array.bytes.data(), array.bytes.size());
  return out;
}

void requireIndices(const std::vector<UVec3>& triangles, std::size_t count, const std::string& name) {
  for (const UVec3& t : triangles)
    if (t.x >= count || t.y >= count || t.z >= count)
      throw FileError("array '" + name + "' points outside the mesh", "project", "bake again");
}

std::string arrayName(const char* what, std::size_t object) {
  return std::string(what) + "." + std::to_string(object);
}

TriMesh loadTriMesh(const ProductData& data, std::size_t object) {
  TriMesh mesh;
  mesh.positions = vectors<Vec3>(data, arrayName("positions", object));
  mesh.normals = vectors<Vec3>(data, arrayName("normals", object));
  mesh.triangles = vectors<UVec3>(data, arrayName("triangles", object));
  mesh.uv = vectors<Vec2>(data, arrayName("uv", object));
  mesh.uvTriangles = vectors<UVec3>(data, arrayName("uvTriangles", object));
  requireIndices(mesh.triangles, mesh.positions.size(), "triangles");
  requireIndices(mesh.uvTriangles, mesh.uv.size(), "uvTriangles");
  const bool uvFits =
      mesh.uv.empty() ? mesh.uvTriangles.empty() : mesh.uvTriangles.size() == mesh.triangles.size();
  if (mesh.normals.size() != mesh.positions.size() || !uvFits)
    throw FileError("the arrays of a mesh do not fit together", "project", "bake again");
  return mesh;
}

json metaOf(const ProductData& data) {
  json meta = json::parse(data.meta, nullptr, false);
  if (!meta.is_object()) throw FileError("a product has no description", "project", "bake again");
  return meta;
}

int wholeNumber(const json& meta, const char* name, int low, int high) {
  const auto found = meta.find(name);
  if (found == meta.end() || !found->is_number_integer() || *found < low || *found > high)
    throw FileError(std::string("'") + name + "' of a product is not what it must be", "project",
                    "bake again");
  return found->get<int>();
}

double number(const json& meta, const char* name) {
  const auto found = meta.find(name);
  if (found == meta.end() || !found->is_number() || !(*found >= 0))
    throw FileError(std::string("'") + name + "' of a product is not what it must be", "project",
                    "bake again");
  return found->get<double>();
}

/// Arrays that a form does not have are left out.
void put(ProductData& data, const std::string& name, const Array& array) {
  if (!array.bytes.empty()) data.arrays[name] = array;
}

Array take(ProductData& data, const std::string& name) {
  const auto found = data.arrays.find(name);
  return found == data.arrays.end() ? Array{} : std::move(found->second);
}

/// Throws unless the array is float (or half where allowed) and of this shape.
void requireShape(const Array& array, std::vector<std::int64_t> shape, bool halfToo,
                  const std::string& stage) {
  const bool type = array.dtype == DType::f32 || (halfToo && array.dtype == DType::f16);
  if (!type || array.shape != shape) unfit(stage);
}

/// [S, functions], and 3 more numbers where there is colour.
std::vector<std::int64_t> vectorShape(std::int64_t samples, std::int64_t functions, int channels) {
  if (channels == 3) return {samples, functions, 3};
  return {samples, functions};
}

void checkClusters(const Transfer& t) {
  const std::string stage = "transfer";
  const std::int64_t samples = std::int64_t(t.samples), k = t.functions();
  if (t.values.dtype != DType::f16 || t.values.shape.size() != 2 || t.values.shape[0] != samples ||
      t.cluster.dtype != DType::u32 || t.cluster.shape != std::vector<std::int64_t>{samples} ||
      t.basis.dtype != DType::f16 || t.basis.shape.empty() ||
      t.basis.shape != std::vector<std::int64_t>{t.basis.shape[0], t.values.shape[1] + 1, t.channels, k, k})
    unfit(stage);
  for (const std::uint32_t c : t.cluster.as<std::uint32_t>())
    if (std::int64_t(c) >= t.basis.shape[0]) unfit(stage);
}

/// What the renderers rely on: a damaged or forged file must not get past here.
void checkShapes(const Transfer& t) {
  const std::string stage = "transfer";
  const auto samples = std::int64_t(t.samples);
  const std::int64_t k = t.functions(), wide = std::int64_t(2 * t.bands - 1) * (2 * t.bands - 1);
  if (t.channels != 1 && t.channels != 3) unfit(stage);
  switch (t.form) {
    case TransferForm::None:
      break;
    case TransferForm::Diffuse:
      requireShape(t.values, vectorShape(samples, k, t.channels), true, stage);
      break;
    case TransferForm::Visibility:
      requireShape(t.values, {samples, wide}, true, stage);
      break;
    case TransferForm::Matrix:
      if (t.clustered())
        checkClusters(t);
      else
        requireShape(t.values, {samples, t.channels, k, k}, true, stage);
      break;
  }
  if (t.form == TransferForm::Visibility || t.form == TransferForm::Matrix)
    requireShape(t.diffuse, vectorShape(samples, k, t.channels), false, stage);
}

std::string defectArray(const char* what, DefectKind kind, std::size_t object) {
  return arrayName((std::string(what) + "." + defectKey(kind)).c_str(), object);
}

/// Lines of one object into its description and the arrays.
json saveDefects(const std::vector<DefectLine>& lines, std::size_t object, ProductData& data) {
  json list = json::array();
  for (const DefectLine& line : lines) {
    list.push_back({{"kind", defectKey(line.kind)},
                    {"found", line.found},
                    {"left", line.left},
                    {"shape", int(line.places.shape)}});
    data.arrays[defectArray("defectPlaces", line.kind, object)] =
        rows(std::vector<Vec3>(line.places.positions.begin(), line.places.positions.end()));
    data.arrays[defectArray("defectStarts", line.kind, object)] =
        Array::from<std::uint32_t>(line.places.starts, {std::int64_t(line.places.starts.size())});
  }
  return list;
}

/// Elements that lie one behind the other, of whole simplices, at finite places.
DefectPlaces loadPlaces(const ProductData& data, const json& line, DefectKind kind, std::size_t object) {
  DefectPlaces places;
  places.shape =
      DefectPlaces::Shape(wholeNumber(line, "shape", DefectPlaces::Points, DefectPlaces::Triangles));
  for (const Vec3& p : vectors<Vec3>(data, defectArray("defectPlaces", kind, object)))
    places.positions.emplace_back(p);
  const auto starts =
      data.array(defectArray("defectStarts", kind, object), DType::u32, 1).as<std::uint32_t>();
  places.starts.assign(starts.begin(), starts.end());
  const bool whole =
      std::ranges::all_of(places.starts, [&](std::uint32_t s) { return s % places.shape == 0; });
  const bool sound = std::ranges::all_of(places.positions, [](const DVec3& p) { return isFinite(Vec3(p)); });
  if (places.starts.empty() || places.starts.front() != 0 ||
      places.starts.back() != places.positions.size() || !std::ranges::is_sorted(places.starts) || !whole ||
      !sound || places.positions.size() > DefectPlaces::kMost)
    unfit("mesh");
  return places;
}

std::vector<DefectLine> loadDefects(const ProductData& data, const json& description, std::size_t object) {
  std::vector<DefectLine> lines;
  const auto list = description.find("list");
  if (list == description.end()) return lines;
  if (!list->is_array()) unfit("mesh");
  for (const json& each : *list) {
    const auto kind = each.is_object() && each.contains("kind") && each["kind"].is_string()
                          ? defectKind(each["kind"].get<std::string>())
                          : std::nullopt;
    if (!kind) unfit("mesh");
    constexpr int kMany = std::numeric_limits<int>::max();
    lines.push_back({*kind, std::size_t(wholeNumber(each, "found", 0, kMany)),
                     std::size_t(wholeNumber(each, "left", 0, kMany)),
                     loadPlaces(data, each, *kind, object)});
  }
  return lines;
}

/// A description is an object whose texts are texts.
void checkDescription(const json& description) {
  if (!description.is_object()) unfit("mesh");
  for (const char* name : {"text", "facts"})
    if (description.contains(name) && !description[name].is_string()) unfit("mesh");
  const auto notes = description.find("notes");
  if (notes == description.end()) return;
  if (!notes->is_array() ||
      !std::all_of(notes->begin(), notes->end(), [](const json& n) { return n.is_string(); }))
    unfit("mesh");
}

}  // namespace

ProductData MeshProduct::save() const {
  json meta{{"objects", json::array()}};
  ProductData data;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    json description = json::parse(reports[i]);
    if (!defects[i].empty()) description["list"] = saveDefects(defects[i], i, data);
    meta["objects"].push_back(std::move(description));
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
    json description = meta["objects"][i];
    checkDescription(description);
    product->meshes.push_back(std::make_shared<TriMesh>(loadTriMesh(data, i)));
    product->defects.push_back(loadDefects(data, description, i));
    description.erase("list");
    product->reports.push_back(description.dump());
  }
  return product;
}

std::string MeshProduct::repairText(std::size_t object) const {
  return json::parse(reports[object]).value("text", "nothing to repair");
}

std::string MeshProduct::factsText(std::size_t object) const {
  return json::parse(reports[object]).value("facts", "");
}

std::vector<std::string> MeshProduct::notes(std::size_t object) const {
  return json::parse(reports[object]).value("notes", std::vector<std::string>{});
}

ProductData DirectProduct::save() const {
  const json meta{{"bands", direct.settings.bands},
                  {"rays", direct.settings.rays},
                  {"gathered", direct.raysPerSample},
                  {"seed", direct.settings.seed}};
  ProductData data{meta.dump(), {}};
  put(data, "diffuse", direct.diffuse);
  put(data, "visibility", direct.visibility);
  put(data, "buried", direct.buried);
  return data;
}

ProductPtr DirectProduct::load(ProductData data) {
  const json meta = metaOf(data);
  auto product = std::make_shared<DirectProduct>();
  DirectTransfer& d = product->direct;
  d.settings.bands = wholeNumber(meta, "bands", 1, 10);
  d.settings.rays = wholeNumber(meta, "rays", 1, kMaxRays);
  d.raysPerSample = wholeNumber(meta, "gathered", 0, kMaxRays);
  d.settings.visibility = data.arrays.contains("visibility");
  d.settings.seed = std::uint64_t(number(meta, "seed"));
  d.diffuse = take(data, "diffuse");
  d.visibility = take(data, "visibility");
  d.buried = take(data, "buried");
  if (d.diffuse.bytes.empty() && d.visibility.bytes.empty()) return product;  // of the form None
  const auto samples = std::int64_t(d.samples());
  const std::int64_t side = 2 * d.settings.bands - 1;
  requireShape(d.diffuse, {samples, std::int64_t(d.settings.bands) * d.settings.bands}, false, "direct");
  if (d.settings.visibility) requireShape(d.visibility, {samples, side * side}, false, "direct");
  if (d.buried.dtype != DType::u8 || d.buried.shape != std::vector<std::int64_t>{samples}) unfit("direct");
  return product;
}

ProductData TransferProduct::save() const {
  const json meta{{"form", int(transfer.form)},         {"bands", transfer.bands},
                  {"channels", transfer.channels},      {"samples", transfer.samples},
                  {"gathered", transfer.raysPerSample}, {"rays", transfer.raysWanted},
                  {"bounces", transfer.bounces},        {"storageError", transfer.storageError}};
  ProductData data{meta.dump(), {}};
  put(data, "values", transfer.values);
  put(data, "cluster", transfer.cluster);
  put(data, "basis", transfer.basis);
  put(data, "diffuse", transfer.diffuse);
  put(data, "surface", transfer.surface);
  return data;
}

ProductPtr TransferProduct::load(ProductData data) {
  const json meta = metaOf(data);
  Transfer t;
  t.form = TransferForm(wholeNumber(meta, "form", 0, int(TransferForm::Matrix)));
  t.bands = wholeNumber(meta, "bands", 1, 10);
  t.channels = wholeNumber(meta, "channels", 1, 3);
  t.samples = std::size_t(wholeNumber(meta, "samples", 0, std::numeric_limits<int>::max()));
  t.raysPerSample = wholeNumber(meta, "gathered", 0, kMaxRays);
  t.raysWanted = wholeNumber(meta, "rays", 0, kMaxRays);
  t.bounces = wholeNumber(meta, "bounces", 0, kMaxBounces);
  t.storageError = number(meta, "storageError");
  t.values = take(data, "values");
  t.cluster = take(data, "cluster");
  t.basis = take(data, "basis");
  t.diffuse = take(data, "diffuse");
  t.surface = take(data, "surface");
  checkShapes(t);
  return std::make_shared<TransferProduct>(std::move(t));
}

ProductData FloorProduct::save() const {
  const json meta{{"interpolation", floor.interpolation},
                  {"interpolationError", floor.interpolationError},
                  {"product", floor.product},
                  {"sampling", floor.sampling},
                  {"points", floor.points}};
  return {meta.dump(), {}};
}

ProductPtr FloorProduct::load(ProductData data) {
  const json meta = metaOf(data);
  InterpolationFloor f;
  f.interpolation = number(meta, "interpolation");
  f.interpolationError = number(meta, "interpolationError");
  f.product = number(meta, "product");
  f.sampling = number(meta, "sampling");
  f.points = std::size_t(number(meta, "points"));
  return std::make_shared<FloorProduct>(f);
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
