#include "libprt/project/patch_stages.h"

#include "libprt/core/error.h"
#include "libprt/core/image_io.h"
#include "libprt/mesh/repair.h"
#include "libprt/meso/btf_import.h"
#include "libprt/meso/rtt_seam.h"
#include "libprt/meso/rtt_storage.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/product_rows.h"
#include "libprt/synthesis/layer_masks.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using nlohmann::json;

void putTexture(ProductData& data, const std::string& name, const PatchTexture& texture) {
  if (texture)
    data.arrays[name] = Array::from<float>(std::span<const float>(texture->data),
                                           {texture->height, texture->width, texture->channels});
}

PatchTexture takeTexture(const ProductData& data, const std::string& name) {
  if (!data.arrays.contains(name)) return nullptr;
  const Array& array = data.array(name, DType::f32, 3);
  for (const std::int64_t extent : array.shape)
    if (extent < 1 || extent > 65536) unfit("patch");
  auto image = std::make_shared<Image>(int(array.shape[1]), int(array.shape[0]), int(array.shape[2]));
  if (array.shape[2] > 4 || array.bytes.size() != image->data.size() * sizeof(float)) unfit("patch");
  std::memcpy(image->data.data(), array.bytes.data(), array.bytes.size());
  return image;
}

double number(const json& meta, const char* name, double low, double high) {
  const auto found = meta.find(name);
  if (found == meta.end() || !found->is_number() || !(*found >= low) || !(*found <= high))
    throw FileError(std::string("'") + name + "' of a product is not what it must be", "project",
                    "bake again");
  return found->get<double>();
}

json metaOf(const ProductData& data) {
  json meta = json::parse(data.meta, nullptr, false);
  if (!meta.is_object()) throw FileError("a product has no description", "project", "bake again");
  return meta;
}

/// The description of a colour.
Rgb colour(const json& meta, const char* name) {
  const auto found = meta.find(name);
  if (found == meta.end() || !found->is_array() || found->size() != 3) unfit("patch");
  Rgb c;
  for (int i = 0; i < 3; ++i) {
    if (!(*found)[std::size_t(i)].is_number()) unfit("patch");
    c[i] = (*found)[std::size_t(i)].get<float>();
  }
  if (!isFinite(c)) unfit("patch");
  return c;
}

json colourJson(const Rgb& c) {
  return {c.x, c.y, c.z};
}

void checkPatch(const Patch& patch) {
  const std::size_t count = patch.mesh.vertexCount();
  if (patch.mesh.normals.size() != count || patch.albedo.size() != count || patch.twin.size() != count ||
      patch.mesh.triangles.empty())
    unfit("patch");
  for (const UVec3& t : patch.mesh.triangles)
    if (t.x >= count || t.y >= count || t.z >= count) unfit("patch");
  for (std::size_t v = 0; v < count; ++v)
    if (patch.twin[v] > v || patch.twin[patch.twin[v]] != patch.twin[v] ||
        !isFinite(patch.mesh.positions[v]) || !isFinite(patch.mesh.normals[v]) || !isFinite(patch.albedo[v]))
      unfit("patch");
}

DType typeOf(RttStorage storage) {
  return storage == RttStorage::Float ? DType::f32 : storage == RttStorage::Half ? DType::f16 : DType::u8;
}

/// The product with its values as the storage type leaves them.
std::shared_ptr<RttProduct> rounded(Rtt rtt, RttStorage storage) {
  auto product = std::make_shared<RttProduct>();
  product->storage = storage;
  if (storage != RttStorage::Float) {
    const StoredRtt stored = storeRtt(rtt, typeOf(storage));
    product->storageError = stored.error;
    restoreRtt(stored, rtt);
  }
  product->rtt = std::make_shared<const Rtt>(std::move(rtt));
  return product;
}

/// Null where there is none, or images of a real one.
std::shared_ptr<const Patch> patchOf(const PatchOptions& options, StageRun& run) {
  if (options.model == PatchModel::None || options.model == PatchModel::Btf) return nullptr;
  run.job().begin("patch", 0);
  return std::make_shared<const Patch>(
      buildPatch(options, loadPatchSources(options, run.file(""), run.job()), run.job()));
}

std::shared_ptr<RttProduct> importedTable(const PatchOptions& options, StageRun& run) {
  if (options.btf.empty()) throw ValueError("is not set", "patch.btf", "name the manifest of the images");
  const RttRecipe& r = run.recipe().rtt;
  Rtt rtt = importBtf(openBtf(run.file(options.btf)), {r.texels, r.views, r.bands}, run.job());
  if (options.seamless) makeSeamless(rtt, run.job());
  return rounded(std::move(rtt), r.storage);
}

/// The table of a patch: empty where there is none.
std::shared_ptr<RttProduct> tableOf(const PatchOptions& options, const std::shared_ptr<const Patch>& patch,
                                    StageRun& run, const std::function<void(const RttPreview&)>& preview) {
  if (options.model == PatchModel::Btf) return importedTable(options, run);
  if (!patch) return std::make_shared<RttProduct>();
  const RttSettings settings = rttSettings(run.recipe());
  const PatchScene scene = makePatchScene(patch, run.job());
  const PatchLight light = bakePatchLight(scene, settings, run.job(), preview);
  Rtt rtt = viewsOfPatch(scene, light, settings, run.job(), preview);
  const ViewError viewError = measureViewError(scene, light, settings, rtt, run.job());
  std::shared_ptr<RttProduct> product = rounded(std::move(rtt), run.recipe().rtt.storage);
  product->viewError = viewError;
  return product;
}

}  // namespace

ProductData PatchProduct::save() const {
  if (!patch) return {};
  const json meta{{"specular", colourJson(patch->specular)},
                  {"exponent", patch->exponent},
                  {"low", patch->low},
                  {"high", patch->high},
                  {"backed", patch->backed}};
  ProductData data{meta.dump(), {}};
  data.arrays["positions"] = rowsOf(patch->mesh.positions);
  data.arrays["normals"] = rowsOf(patch->mesh.normals);
  data.arrays["triangles"] = rowsOf(patch->mesh.triangles);
  data.arrays["albedo"] = rowsOf(patch->albedo);
  data.arrays["twin"] = Array::from<std::uint32_t>(std::span<const std::uint32_t>(patch->twin),
                                                   {std::int64_t(patch->twin.size())});
  putTexture(data, "texture", patch->albedoTexture);
  putTexture(data, "gloss", patch->glossTexture);
  return data;
}

ProductPtr PatchProduct::load(ProductData data) {
  auto product = std::make_shared<PatchProduct>();
  if (data.arrays.empty()) return product;
  const json meta = metaOf(data);
  Patch patch;
  patch.specular = colour(meta, "specular");
  patch.exponent = float(number(meta, "exponent", 1, 10000));
  patch.low = float(number(meta, "low", -200, 200)), patch.high = float(number(meta, "high", -200, 200));
  patch.backed = meta.value("backed", json(false)) == json(true);
  patch.mesh.positions = readRows<Vec3>(data, "positions", "patch");
  patch.mesh.normals = readRows<Vec3>(data, "normals", "patch");
  patch.mesh.triangles = readRows<UVec3>(data, "triangles", "patch");
  patch.albedo = readRows<Rgb>(data, "albedo", "patch");
  const auto twin = data.array("twin", DType::u32, 1).as<std::uint32_t>();
  patch.twin.assign(twin.begin(), twin.end());
  patch.albedoTexture = takeTexture(data, "texture");
  patch.glossTexture = takeTexture(data, "gloss");
  checkPatch(patch);
  product->patch = std::make_shared<const Patch>(std::move(patch));
  return product;
}

ProductData RttProduct::save() const {
  if (!rtt) return {};
  json meta{{"texels", rtt->texels},
            {"views", rtt->views},
            {"bands", rtt->bands},
            {"channels", rtt->channels},
            {"colour", colourJson(rtt->colour)},
            {"bounces", rtt->bounces},
            {"rays", rtt->rays},
            {"storage", int(storage)},
            {"storageError", storageError}};
  if (viewError) meta["viewErrorBetween"] = viewError->between, meta["viewErrorBeyond"] = viewError->beyond;
  ProductData data{meta.dump(), {}};
  StoredRtt stored = storeRtt(*rtt, typeOf(storage));
  data.arrays["values"] = std::move(stored.values);
  if (storage == RttStorage::Byte)
    data.arrays["lowest"] = std::move(stored.lowest), data.arrays["step"] = std::move(stored.step);
  return data;
}

ProductPtr RttProduct::load(ProductData data) {
  auto product = std::make_shared<RttProduct>();
  if (data.arrays.empty()) return product;
  const json meta = metaOf(data);
  const auto whole = [&](const char* name, int low, int high) {
    const double value = number(meta, name, low, high);
    if (value != std::floor(value)) unfit("rtt");
    return int(value);
  };
  const int texels = whole("texels", 1, 1024), views = whole("views", 1, 32), bands = whole("bands", 1, 10),
            channels = whole("channels", 1, 3);
  product->storage = RttStorage(whole("storage", 0, int(RttStorage::Byte)));
  StoredRtt stored{data.array("values", typeOf(product->storage), channels == 3 ? 6 : 5), {}, {}, 0};
  if (channels == 2 || stored.values.shape[0] != texels || stored.values.shape[2] != views) unfit("rtt");
  if (product->storage == RttStorage::Byte) {
    stored.lowest = data.array("lowest", DType::f32, 1);
    stored.step = data.array("step", DType::f32, 1);
  }
  Rtt rtt;
  rtt.texels = texels, rtt.views = views, rtt.bands = bands, rtt.channels = channels;
  rtt.colour = colour(meta, "colour");
  rtt.bounces = whole("bounces", 0, kMaxPatchBounces);
  rtt.rays = whole("rays", 0, kMaxRays);
  product->storageError = number(meta, "storageError", 0, 1e9);
  if (meta.contains("viewErrorBetween"))
    product->viewError = {number(meta, "viewErrorBetween", 0, 1e9), number(meta, "viewErrorBeyond", 0, 1e9)};
  restoreRtt(stored, rtt);
  for (const float x : rtt.values)
    if (!std::isfinite(x)) unfit("rtt");
  product->rtt = std::make_shared<const Rtt>(std::move(rtt));
  return product;
}

bool hasPatch(const Recipe& recipe) {
  return recipe.patch.model != PatchModel::None;
}

bool isPainted(const LayerRecipe& layer) {
  return layer.patch.model != PatchModel::None && layer.spots.find_first_not_of(" ;") != std::string::npos;
}

bool hasLayers(const Recipe& recipe) {
  return hasPatch(recipe) && recipe.synthesis.mapping == PatchMapping::Synthesis &&
         std::any_of(recipe.layers.begin(), recipe.layers.end(), isPainted);
}

RttSettings rttSettings(const Recipe& recipe) {
  const RttRecipe& r = recipe.rtt;
  RttSettings settings;
  settings.texels = r.texels, settings.views = r.views, settings.bands = r.bands, settings.rays = r.rays;
  settings.bounces = r.bounces, settings.supersamples = r.supersamples, settings.lobeRays = r.lobeRays;
  settings.seed = r.seed;
  return settings;
}

PatchSources loadPatchSources(const PatchOptions& options, const std::filesystem::path& folder, Job& job) {
  PatchSources sources;
  const auto read = [&](const std::string& path, std::optional<Image>& image) {
    if (!path.empty() && !isBuiltin(path)) image = readImage(folder / path);
  };
  if (options.model == PatchModel::HeightField) read(options.heightmap, sources.height);
  read(options.texture, sources.texture);
  read(options.gloss, sources.gloss);
  if (options.model == PatchModel::Mesh && !options.mesh.empty()) {
    RepairOptions repair;
    repair.recentre = false;
    repair.orientation = Orientation::consistent;
    sources.mesh = loadMesh(folder / options.mesh, repair, job);
  }
  return sources;
}

ProductPtr makePatchStage(StageRun& run) {
  auto product = std::make_shared<PatchProduct>();
  product->patch = patchOf(run.recipe().patch, run);
  return product;
}

ProductPtr makeRttStage(StageRun& run) {
  std::function<void(const RttPreview&)> preview;
  if (run.wantsPreviews())
    preview = [&](const RttPreview& p) {
      constexpr int kEvery = 8;  // copies of the table are not free
      if (p.viewsDone % kEvery != 0 || p.viewsDone == p.viewsWanted) return;
      auto product = std::make_shared<RttProduct>();
      product->rtt = std::make_shared<const Rtt>(p.rtt);
      run.preview(product, p.viewsDone + 1, p.viewsWanted + 1);
    };
  return tableOf(run.recipe().patch, run.input<PatchProduct>("patch")->patch, run, preview);
}

ProductPtr makeLayersStage(StageRun& run) {
  auto product = std::make_shared<LayersProduct>();
  if (!hasLayers(run.recipe())) return product;
  for (std::size_t i = 0; i < run.recipe().layers.size(); ++i) {
    const PatchOptions& options = run.recipe().layers[i].patch;
    try {
      product->tables.push_back(tableOf(options, patchOf(options, run), run, {}));
    } catch (const ValueError& error) {
      throw ValueError(error.problem(), "layers[" + std::to_string(i) + "]." + error.where(), error.fix());
    }
  }
  return product;
}

ProductData LayersProduct::save() const {
  ProductData all;
  json metas = json::array();
  for (std::size_t i = 0; i < tables.size(); ++i) {
    ProductData one = tables[i]->save();
    metas.push_back(one.meta);
    for (auto& [name, array] : one.arrays) all.arrays[name + std::to_string(i)] = std::move(array);
  }
  if (!tables.empty()) all.meta = json{{"layers", metas}}.dump();
  return all;
}

ProductPtr LayersProduct::load(ProductData data) {
  auto product = std::make_shared<LayersProduct>();
  const json meta = json::parse(data.meta, nullptr, false);
  const auto metas = meta.find("layers");
  if (metas == meta.end() && data.arrays.empty()) return product;
  if (metas == meta.end() || !metas->is_array() || metas->size() > std::size_t(kMostLayers)) unfit("layers");
  for (std::size_t i = 0; i < metas->size(); ++i) {
    if (!(*metas)[i].is_string()) unfit("layers");
    ProductData one{(*metas)[i].get<std::string>(), {}};
    for (const char* name : {"values", "lowest", "step"})
      if (const auto found = data.arrays.find(name + std::to_string(i)); found != data.arrays.end())
        one.arrays[name] = std::move(found->second);
    auto table = std::dynamic_pointer_cast<const RttProduct>(RttProduct::load(std::move(one)));
    if (!table || !table->rtt) unfit("layers");
    product->tables.push_back(std::move(table));
  }
  return product;
}

std::shared_ptr<const RttProduct> bakedRtt(Pipeline& pipeline, const Recipe& recipe,
                                           const std::string& project) {
  const Products products = pipeline.find(recipe, {"rtt"});
  const auto rtt = products.get<RttProduct>("rtt");
  if (!rtt || !rtt->rtt)
    throw ValueError(
        "holds no radiance transfer texture", project,
        recipe.patch.model == PatchModel::None ? "set patch.model and bake it" : "run prt bake " + project);
  return rtt;
}

}  // namespace prt
