#include "libprt/project/synthesis_stages.h"

#include "libprt/core/error.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/product_rows.h"
#include "libprt/project/products.h"
#include "libprt/synthesis/mesh_part.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using nlohmann::json;

constexpr int kPreviewSize = 512;

bool allFinite(const std::vector<Vec3>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), isFinite);
}

/// Whether patches are grown over the surface rather than laid by coordinates, or not at all.
bool grown(const Recipe& recipe) {
  return hasPatch(recipe) && recipe.synthesis.mapping == PatchMapping::Synthesis;
}

/// The first levels of a mesh as a mesh.
MesoMesh firstLevels(const MesoMesh& meso, int levels) {
  const auto count = std::ptrdiff_t(meso.levelEnd[std::size_t(levels) - 1]);
  const auto first = [count](const auto& v) {
    return std::remove_cvref_t<decltype(v)>(v.begin(), v.begin() + count);
  };
  MesoMesh few;
  few.triangle = first(meso.triangle), few.barycentric = first(meso.barycentric);
  few.positions = first(meso.positions), few.normals = first(meso.normals);
  few.levelEnd.assign(meso.levelEnd.begin(), meso.levelEnd.begin() + levels);
  few.edge = meso.edgeOf(levels - 1);
  return few;
}

/// What of the scene's triangles carries the patch.
std::vector<bool> carryingTriangles(const Scene& scene, const Recipe& recipe) {
  std::vector<bool> out;
  out.reserve(scene.triangleObject.size());
  for (const std::uint32_t object : scene.triangleObject) out.push_back(recipe.objects[object].patch);
  return out;
}

/// What the patch is grown over, as a mesh of its own: meso meshes know its triangles.
class PatchedPart {
 public:
  PatchedPart(const Scene& scene, const TangentFrames& frames, const Recipe& recipe) {
    const std::vector<bool> carries = carryingTriangles(scene, recipe);
    whole_ = std::find(carries.begin(), carries.end(), false) == carries.end();
    if (whole_)
      mesh_ = &scene.mesh, frames_ = &frames;
    else
      part_ = meshPart(scene.mesh, frames, carries), mesh_ = &part_.mesh, frames_ = &part_.frames;
  }
  PatchedPart(const PatchedPart&) = delete;
  PatchedPart& operator=(const PatchedPart&) = delete;

  const TriMesh& mesh() const { return *mesh_; }
  const TangentFrames& frames() const { return *frames_; }
  /// The same with the numbers of the scene's triangles.
  std::shared_ptr<const MesoMesh> ofScene(std::shared_ptr<const MesoMesh> meso) const {
    if (whole_) return meso;
    auto out = std::make_shared<MesoMesh>(*meso);
    for (std::uint32_t& t : out->triangle) t = part_.triangle[t];
    return out;
  }

 private:
  bool whole_;
  MeshPart part_;
  const TriMesh* mesh_;
  const TangentFrames* frames_;
};

std::vector<LayerMask> layerMasks(const MesoMesh& meso, const Recipe& recipe) {
  std::vector<LayerMask> masks;
  for (const LayerRecipe& layer : recipe.layers) masks.emplace_back(meso, parseSpots(layer.spots));
  return masks;
}

/// Texels that show what carries no patch become empty.
void leaveOut(const std::vector<bool>& carries, GeometryImage& image) {
  for (std::size_t i = 0; i < image.triangle.size(); ++i)
    if (image.kind[i] != TexelKind::Empty && !carries[image.triangle[i]])
      image.kind[i] = TexelKind::Empty, image.triangle[i] = kNowhere, image.barycentric[i] = Vec2(0);
}

void readLayers(const ProductData& data, IdMap& map) {
  if (!data.arrays.contains("layers")) return;
  const Array& layers = data.array("layers", DType::u8, 3);
  if (layers.shape[0] != map.size || layers.shape[1] != map.size || layers.shape[2] < 1 ||
      layers.shape[2] > kMostLayers)
    unfit("idmap");
  map.layers = int(layers.shape[2]);
  const auto weights = layers.as<std::uint8_t>();
  map.weights.assign(weights.begin(), weights.end());
  if (map.weights.size() != map.ids.size() / 2 * std::size_t(map.layers)) unfit("idmap");
  for (std::size_t i = 0; i < map.weights.size(); i += std::size_t(map.layers)) {
    int sum = 0;
    for (int k = 0; k < map.layers; ++k) sum += map.weights[i + std::size_t(k)];
    if (sum > 255) unfit("idmap");
  }
}

}  // namespace

std::string plainObjectsText(const Recipe& recipe) {
  std::string text;
  for (std::size_t i = 0; i < recipe.objects.size(); ++i)
    if (!recipe.objects[i].patch) text += std::to_string(i) + " ";
  return text;
}

int symmetryOf(const FieldRecipe& field) {
  return 1 << int(field.symmetry);
}

FieldOptions fieldOptionsOf(const FieldRecipe& field) {
  return {symmetryOf(field), radians(double(field.angle)), parseStrokes(field.strokes), double(field.width)};
}

std::size_t mesoVerticesOf(const SynthesisRecipe& synthesis, const Surface& surface, double patchWidth,
                           int texels) {
  constexpr std::size_t kMost = 8'000'000;
  const std::size_t wanted = synthesis.vertices > 0 ? std::size_t(synthesis.vertices)
                                                    : verticesForEdge(surface, patchWidth / texels);
  return std::clamp<std::size_t>(wanted, 16, kMost);
}

SurfaceExemplars exemplarsFor(const Rtt& rtt, const LayersProduct* layers, const Recipe& recipe,
                              const MesoMesh& meso, double patchWidth, Job& job) {
  ExemplarOptions options;
  options.turns = symmetryOf(recipe.field);
  options.spacings = exemplarSpacings(meso, patchWidth, rtt.texels);
  SurfaceExemplars out;
  out.exemplars.push_back(makeExemplar(rtt, options, job));
  if (!hasLayers(recipe)) return out;
  if (!layers || layers->tables.size() != recipe.layers.size())
    throw ValueError("are not baked", "layers", "run prt bake");
  for (const auto& table : layers->tables) out.exemplars.push_back(makeExemplar(*table->rtt, options, job));
  out.weights = vertexLayerWeights(meso, layerMasks(meso, recipe), job);
  return out;
}

SynthesisQuality qualityOf(const SynthesisProduct& product, const TriMesh& mesh, const TangentFrames& frames,
                           const Rtt& rtt, const LayersProduct* layers, const Recipe& recipe,
                           std::span<const std::uint32_t> chartOf, Job& job) {
  const MesoMesh& meso = *product.meso;
  const Surface surface(mesh, job);
  const SurfaceSheets sheets(surface);
  const Neighbourhoods finest =
      makeNeighbourhoods(meso, sheets, mesoTangents(meso, frames, job), symmetryOf(recipe.field),
                         rtt.texels / product.patchWidth, meso.levels() - 1, job);
  const SurfaceExemplars exemplars = exemplarsFor(rtt, layers, recipe, meso, product.patchWidth, job);
  return measureSynthesis(meso, finest, exemplars.all(), *product.coordinates, chartOf);
}

ProductPtr makeFieldStage(StageRun& run) {
  auto product = std::make_shared<FieldProduct>();
  if (!grown(run.recipe())) return product;
  const TriMesh& mesh = run.input<SceneProduct>("scene")->scene->mesh;
  product->field = std::make_shared<OrientationField>(
      makeOrientationField(mesh, Surface(mesh, run.job()), fieldOptionsOf(run.recipe().field), run.job()));
  return product;
}

ProductPtr makeSynthesisStage(StageRun& run) {
  const auto rtt = run.input<RttProduct>("rtt")->rtt;
  if (!grown(run.recipe()) || !rtt) return std::make_shared<SynthesisProduct>();
  const SynthesisRecipe& recipe = run.recipe().synthesis;
  Job& job = run.job();
  const auto scene = run.input<SceneProduct>("scene")->scene;
  const auto frames = run.input<FramesProduct>("frames");
  const PatchedPart part(*scene, frames->frames, run.recipe());
  const TriMesh& mesh = part.mesh();
  if (mesh.triangles.empty()) return std::make_shared<SynthesisProduct>();
  const Surface surface(mesh, job);
  const SurfaceSheets sheets(surface);
  const double width = double(recipe.scale) * double(mesh.bounds().diagonal());
  const auto meso = std::make_shared<const MesoMesh>(makeMesoMesh(
      mesh, sheets, {.vertices = mesoVerticesOf(recipe, surface, width, rtt->texels), .seed = recipe.seed},
      job));
  const std::vector<Vec3> tangents = mesoTangents(*meso, part.frames(), job);
  const int symmetry = symmetryOf(run.recipe().field);
  const auto layers = hasLayers(run.recipe()) ? run.input<LayersProduct>("layers") : nullptr;
  const SurfaceExemplars exemplars = exemplarsFor(*rtt, layers.get(), run.recipe(), *meso, width, job);
  const std::vector<VertexWish> wishes = vertexWishes(*meso, parseWishes(recipe.wishes), job);
  SynthesisOptions options;
  options.patchWidth = width, options.symmetry = symmetry, options.jitter = double(recipe.jitter);
  options.passes = recipe.passes, options.seed = recipe.seed, options.wishes = wishes;
  if (run.wantsPreviews())
    options.preview = [&](std::span<const Vec2> coordinates, int level, int levels) {
      if (level == levels) return;
      auto product = std::make_shared<SynthesisProduct>();
      product->meso = part.ofScene(std::make_shared<MesoMesh>(firstLevels(*meso, level)));
      product->coordinates = std::make_shared<std::vector<Vec2>>(coordinates.begin(), coordinates.end());
      product->patchWidth = width;
      run.preview(product, level, levels);
    };
  auto product = std::make_shared<SynthesisProduct>();
  product->meso = part.ofScene(meso);
  product->coordinates =
      std::make_shared<std::vector<Vec2>>(synthesise(*meso, sheets, tangents, exemplars.all(), options, job));
  product->patchWidth = width;
  product->quality = measureSynthesis(
      *meso,
      makeNeighbourhoods(*meso, sheets, tangents, symmetry, rtt->texels / width, meso->levels() - 1, job),
      exemplars.all(), *product->coordinates, {});
  return product;
}

ProductPtr makeIdMapStage(StageRun& run) {
  const auto synthesis = run.input<SynthesisProduct>("synthesis");
  auto product = std::make_shared<IdMapProduct>();
  if (!synthesis->meso) return product;
  Job& job = run.job();
  const auto scene = run.input<SceneProduct>("scene")->scene;
  const TriMesh& mesh = scene->mesh;
  const Atlas& atlas = *run.input<AtlasProduct>("atlas")->atlas;
  const int neighbours = run.recipe().idmap.neighbours;
  // Previews are coarse on the surface, so they may be in the texture: a look must not cost seconds.
  const int size =
      run.fromPreview() ? std::min(run.recipe().idmap.size, kPreviewSize) : run.recipe().idmap.size;
  const Surface surface(mesh, job);
  const SurfaceSheets sheets(surface);
  GeometryImage image = makeGeometryImage(atlas, size, -1, job);
  leaveOut(carryingTriangles(*scene, run.recipe()), image);
  const TexelSurface texels = texelSurface(mesh, atlas, image, job);
  IdMap map = makeIdMap(size, shootNormals(*synthesis->meso, sheets, image, texels, {neighbours}, job),
                        *synthesis->coordinates);
  if (hasLayers(run.recipe())) addLayers(map, texels, layerMasks(*synthesis->meso, run.recipe()), job);
  product->map = std::make_shared<IdMap>(std::move(map));
  return product;
}

ProductData SynthesisProduct::save() const {
  if (!meso) return {};
  const json meta{{"edge", meso->edge},
                  {"patchWidth", patchWidth},
                  {"distance", quality.distance},
                  {"coherence", quality.coherence},
                  {"longestRepeat", quality.longestRepeat}};
  ProductData data{meta.dump(), {}};
  data.arrays["triangle"] = Array::from<std::uint32_t>(std::span<const std::uint32_t>(meso->triangle),
                                                       {std::int64_t(meso->triangle.size())});
  data.arrays["barycentric"] = rowsOf(meso->barycentric);
  data.arrays["positions"] = rowsOf(meso->positions);
  data.arrays["normals"] = rowsOf(meso->normals);
  const std::vector<std::int64_t> ends(meso->levelEnd.begin(), meso->levelEnd.end());
  data.arrays["levels"] =
      Array::from<std::int64_t>(std::span<const std::int64_t>(ends), {std::int64_t(ends.size())});
  data.arrays["coordinates"] = rowsOf(*coordinates);
  return data;
}

ProductPtr SynthesisProduct::load(ProductData data) {
  auto product = std::make_shared<SynthesisProduct>();
  if (data.arrays.empty()) return product;
  const char* stage = "synthesis";
  const json meta = json::parse(data.meta, nullptr, false);
  MesoMesh meso;
  meso.edge = numberOf(meta, "edge", stage);
  product->patchWidth = numberOf(meta, "patchWidth", stage);
  product->quality.distance = product->quality.inside = numberOf(meta, "distance", stage);
  product->quality.coherence = numberOf(meta, "coherence", stage);
  product->quality.longestRepeat = numberOf(meta, "longestRepeat", stage);
  const auto triangle = data.array("triangle", DType::u32, 1).as<std::uint32_t>();
  meso.triangle.assign(triangle.begin(), triangle.end());
  meso.barycentric = readRows<Vec2>(data, "barycentric", stage);
  meso.positions = readRows<Vec3>(data, "positions", stage);
  meso.normals = readRows<Vec3>(data, "normals", stage);
  auto coordinates = readRows<Vec2>(data, "coordinates", stage);
  std::size_t before = 0;
  for (const std::int64_t end : data.array("levels", DType::i64, 1).as<std::int64_t>()) {
    if (end < std::int64_t(before)) unfit(stage);
    meso.levelEnd.push_back(before = std::size_t(end));
  }
  const std::size_t count = meso.positions.size();
  const bool inside = std::all_of(coordinates.begin(), coordinates.end(),
                                  [](const Vec2& u) { return u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1; });
  if (count == 0 || before != count || meso.triangle.size() != count || meso.barycentric.size() != count ||
      meso.normals.size() != count || coordinates.size() != count || !inside || !(meso.edge > 0) ||
      !(product->patchWidth > 0) || !allFinite(meso.positions) || !allFinite(meso.normals))
    unfit(stage);
  product->meso = std::make_shared<MesoMesh>(std::move(meso));
  product->coordinates = std::make_shared<std::vector<Vec2>>(std::move(coordinates));
  return product;
}

ProductData IdMapProduct::save() const {
  if (!map) return {};
  ProductData data;
  data.arrays["ids"] =
      Array::from<std::uint16_t>(std::span<const std::uint16_t>(map->ids), {map->size, map->size, 2});
  if (map->layers > 0)
    data.arrays["layers"] = Array::from<std::uint8_t>(std::span<const std::uint8_t>(map->weights),
                                                      {map->size, map->size, map->layers});
  return data;
}

ProductPtr IdMapProduct::load(ProductData data) {
  auto product = std::make_shared<IdMapProduct>();
  if (data.arrays.empty()) return product;
  const Array& ids = data.array("ids", DType::u16, 3);
  IdMap map;
  if (ids.shape[0] < 1 || ids.shape[0] > 65536 || ids.shape[0] != ids.shape[1] || ids.shape[2] != 2)
    unfit("idmap");
  map.size = int(ids.shape[0]);
  const auto values = ids.as<std::uint16_t>();
  map.ids.assign(values.begin(), values.end());
  if (map.ids.size() != 2 * std::size_t(map.size) * std::size_t(map.size)) unfit("idmap");
  for (std::size_t i = 0; i < map.ids.size(); i += 2)
    if ((map.ids[i] == IdMap::kEmpty) != (map.ids[i + 1] == IdMap::kEmpty)) unfit("idmap");
  readLayers(data, map);
  product->map = std::make_shared<IdMap>(std::move(map));
  return product;
}

}  // namespace prt
