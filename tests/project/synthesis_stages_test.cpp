#include "libprt/project/synthesis_stages.h"

#include "libprt/core/error.h"
#include "libprt/project/atlas_stages.h"
#include "libprt/project/export.h"
#include "libprt/project/export_synthesis.h"
#include "libprt/project/patch_stages.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "tests/project/toy_stages.h"
#include "tests/support/temporary_folder.h"

#include "libprt/core/npy.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::MemoryStore;

/// Quick to bake.
Recipe small() {
  Recipe recipe;
  recipe.objects[0].mesh.path = "builtin:vase";
  recipe.objects[0].mesh.detail = 0.4f;
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.grid = 24;
  recipe.rtt.texels = 16, recipe.rtt.views = 2, recipe.rtt.rays = 32, recipe.rtt.bounces = 0;
  recipe.rtt.bands = 3, recipe.rtt.supersamples = 1;
  recipe.atlas.size = 128;
  recipe.synthesis.vertices = 4000, recipe.synthesis.scale = 0.2f;
  recipe.idmap.size = 96;
  return recipe;
}

Products bake(const Recipe& recipe, ProductStore* store = nullptr, PipelineListener* listener = nullptr) {
  Job job;
  return Pipeline(store, {}).run(recipe, {"idmap", "frames"}, job, listener);
}

TEST(SynthesisStages, LayThePatchOverTheSurface) {
  const Products products = bake(small());
  const auto synthesis = products.get<SynthesisProduct>("synthesis");
  ASSERT_TRUE(synthesis && synthesis->meso);
  EXPECT_NEAR(double(synthesis->meso->vertexCount()), 4000, 300);
  EXPECT_EQ(synthesis->coordinates->size(), synthesis->meso->vertexCount());
  const Box3 box = products.get<SceneProduct>("scene")->scene->mesh.bounds();
  EXPECT_NEAR(synthesis->patchWidth, 0.2 * double(box.diagonal()), 1e-6);
  EXPECT_GT(synthesis->quality.coherence, 0.5);
  EXPECT_LT(synthesis->quality.distance, 0.7);
  const auto map = products.get<IdMapProduct>("idmap")->map;
  ASSERT_TRUE(map);
  EXPECT_EQ(map->size, 96);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < map->ids.size() / 2; ++i) filled += !map->empty(i);
  EXPECT_GT(double(filled), 0.4 * 96 * 96);
}

Recipe vaseOnGround() {
  Recipe recipe = small();
  ObjectRecipe& ground = recipe.objects.emplace_back();
  ground.name = "ground", ground.mesh.path = "builtin:ground", ground.mesh.detail = 0.2f;
  ground.patch = false;
  return recipe;
}

TEST(SynthesisStages, LeaveOutWhatCarriesNoPatch) {
  const Products products = bake(vaseOnGround());
  const Scene& scene = *products.get<SceneProduct>("scene")->scene;
  const auto synthesis = products.get<SynthesisProduct>("synthesis");
  ASSERT_TRUE(synthesis && synthesis->meso);
  const MesoMesh& meso = *synthesis->meso;
  EXPECT_NEAR(double(meso.vertexCount()), 4000, 300) << "all serve the vase";
  for (std::size_t v = 0; v < meso.vertexCount(); ++v) {
    ASSERT_EQ(scene.triangleObject[meso.triangle[v]], 0u);
    const UVec3& t = scene.mesh.triangles[meso.triangle[v]];
    const Vec2& w = meso.barycentric[v];
    const Vec3 p = (1 - w.x - w.y) * scene.mesh.positions[t.x] + w.x * scene.mesh.positions[t.y] +
                   w.y * scene.mesh.positions[t.z];
    ASSERT_LT(distance(p, meso.positions[v]), 1e-5f) << "triangles are numbered as in the scene";
  }
  Box3 vase;
  for (std::size_t v = 0; v < scene.mesh.vertexCount(); ++v)
    if (scene.vertexObject[v] == 0) vase.extend(scene.mesh.positions[v]);
  EXPECT_NEAR(synthesis->patchWidth, 0.2 * double(vase.diagonal()), 1e-6);
  const IdMap& map = *products.get<IdMapProduct>("idmap")->map;
  Job job;
  const GeometryImage image =
      makeGeometryImage(*products.get<AtlasProduct>("atlas")->atlas, map.size, -1, job);
  int texels[2] = {};
  for (std::size_t i = 0; i < image.triangle.size(); ++i) {
    if (image.kind[i] == TexelKind::Empty) continue;
    const std::uint32_t object = scene.triangleObject[image.triangle[i]];
    ASSERT_EQ(map.empty(i), object == 1);
    ++texels[object];
  }
  EXPECT_GT(texels[0], 200);
  EXPECT_LT(texels[1], 0.5 * texels[0]) << "the atlas is for what carries the patch";
}

TEST(SynthesisStages, LayNothingWhereNothingCarries) {
  Recipe recipe = vaseOnGround();
  recipe.objects[0].patch = false;
  const Products products = bake(recipe);
  EXPECT_FALSE(products.get<SynthesisProduct>("synthesis")->meso);
  EXPECT_FALSE(products.get<IdMapProduct>("idmap")->map);
}

TEST(SynthesisStages, FramesAreThoseOfTheField) {
  const Products products = bake(small());
  const auto field = products.get<FieldProduct>("field");
  ASSERT_TRUE(field && field->field);
  EXPECT_EQ(products.get<FramesProduct>("frames")->frames.tangents, field->field->frames.tangents);
  Recipe turned = small();
  turned.field.angle = 90;
  const auto other = bake(turned).get<FramesProduct>("frames");
  // A quarter turn of everything; it is made in the planes of the triangles, and this mesh is so coarse that
  // shading normals are tilted against these by up to 20 degrees.
  const TriMesh& mesh = products.get<SceneProduct>("scene")->scene->mesh;
  double sum = 0;
  for (std::size_t c = 0; c < other->frames.tangents.size(); ++c) {
    const Vec3& n = mesh.normals[mesh.triangles[c / 3][int(c % 3)]];
    const float off = distance(other->frames.tangents[c], cross(n, field->field->frames.tangents[c]));
    ASSERT_LT(off, 0.1f);
    sum += double(off);
  }
  EXPECT_LT(sum / double(other->frames.tangents.size()), 1e-2);
}

TEST(SynthesisStages, WithoutAPatchThereIsNothingToLay) {
  Recipe recipe = small();
  recipe.patch.model = PatchModel::None;
  Job job;
  const Products products = Pipeline(nullptr, {}).run(recipe, {"frames", "synthesis", "field"}, job);
  EXPECT_FALSE(products.get<FieldProduct>("field")->field);
  EXPECT_FALSE(products.get<SynthesisProduct>("synthesis")->meso);
  EXPECT_FALSE(products.get<FramesProduct>("frames")->frames.tangents.empty());
}

TEST(SynthesisStages, CoordinatesOfTheMeshNeedNoSynthesis) {
  Recipe recipe = small();
  recipe.synthesis.mapping = PatchMapping::Uv;
  const Products products = bake(recipe);
  EXPECT_FALSE(products.get<SynthesisProduct>("synthesis")->meso);
  EXPECT_FALSE(products.get<IdMapProduct>("idmap")->map);
  EXPECT_FALSE(products.get<FieldProduct>("field")->field);
}

TEST(SynthesisStages, AreMadeOnlyWhenAskedFor) {
  for (const Stage& stage : stages())
    if (stage.name == "synthesis" || stage.name == "idmap") {
      EXPECT_TRUE(stage.wanted && !stage.wanted(small()));
    }
}

TEST(SynthesisStages, KeysFollowWhatIsRead) {
  Pipeline pipeline(nullptr, {});
  const auto before = pipeline.keys(small());
  const auto changed = [&](const std::string& assignment) {
    Recipe recipe = small();
    setByAssignment(recipe, assignment);
    const auto after = pipeline.keys(recipe);
    std::string names;
    for (const auto& [stage, key] : after)
      if (before.at(stage) != key) names += stage + " ";
    return names;
  };
  EXPECT_EQ(changed("idmap.size=64"), "idmap ");
  EXPECT_EQ(changed("synthesis.seed=9"), "idmap synthesis ");
  EXPECT_EQ(changed("synthesis.jitter=0.4"), "idmap synthesis ");
  EXPECT_EQ(changed("field.angle=30"), "field frames idmap synthesis ");
  EXPECT_EQ(changed("synthesis.repeat=3"), "");  // by coordinates only
  EXPECT_EQ(changed("field.width=0.1"), "");     // without strokes
  EXPECT_EQ(changed("atlas.gutter=2"), "atlas idmap ");
  EXPECT_EQ(changed("objects[0].patch=false"), "atlas idmap synthesis ");
}

/// A second patch over part of the vase.
Recipe layeredVase() {
  Recipe recipe = small();
  for (const char* assignment :
       {"layers[0].name=cloth", "layers[0].patch.model=weave", "layers[0].patch.yarns=2",
        "layers[0].patch.albedo=0.7,0.2,0.1", "layers[0].spots=0,0.3,0.2 0.3 1; 0.1,0.4,0.2 0.2 0.5"})
    setByAssignment(recipe, assignment);
  return recipe;
}

TEST(SynthesisStages, LayersCoverWhereTheyArePainted) {
  const Products products = bake(layeredVase()), alone = bake(small());
  const auto layers = products.get<LayersProduct>("layers");
  ASSERT_TRUE(layers && layers->tables.size() == 1 && layers->tables[0]->rtt);
  EXPECT_EQ(layers->tables[0]->rtt->texels, 16);
  const IdMap& map = *products.get<IdMapProduct>("idmap")->map;
  ASSERT_EQ(map.layers, 1);
  const auto covered =
      std::size_t(std::count_if(map.weights.begin(), map.weights.end(), [](auto w) { return w > 0; }));
  EXPECT_GT(covered, 30u);
  EXPECT_LT(covered, map.weights.size() / 2);
  EXPECT_GT(*std::max_element(map.weights.begin(), map.weights.end()), 250);
  EXPECT_EQ(alone.get<IdMapProduct>("idmap")->map->layers, 0);
}

TEST(SynthesisStages, LayersThatShowNothingAreNone) {
  Pipeline pipeline(nullptr, {});
  const auto before = pipeline.keys(small());
  Recipe recipe = layeredVase();
  recipe.layers[0].spots = " ; ";
  EXPECT_EQ(pipeline.keys(recipe), before);
  recipe = layeredVase();
  recipe.layers[0].patch.model = PatchModel::None;
  EXPECT_EQ(pipeline.keys(recipe), before);
  recipe = layeredVase();
  recipe.synthesis.mapping = PatchMapping::Uv;
  EXPECT_EQ(contradictions(recipe).size(), 1u);
  EXPECT_EQ(contradictions(layeredVase()).size(), 0u);
}

TEST(SynthesisStages, KeysOfLayersFollowWhatIsRead) {
  Pipeline pipeline(nullptr, {});
  const auto before = pipeline.keys(layeredVase());
  const auto changed = [&](const std::string& assignment) {
    Recipe recipe = layeredVase();
    setByAssignment(recipe, assignment);
    std::string names;
    for (const auto& [stage, key] : pipeline.keys(recipe))
      if (before.at(stage) != key) names += stage + " ";
    return names;
  };
  EXPECT_EQ(changed("layers[0].spots=0,0.3,0.2 0.1 1"), "idmap synthesis ");
  EXPECT_EQ(changed("layers[0].patch.yarns=4"), "idmap layers synthesis ");
  EXPECT_EQ(changed("layers[0].patch.heightmap=builtin:bins"), "") << "a weave has none";
  EXPECT_EQ(changed("layers[0].name=linen"), "");
  EXPECT_EQ(changed("patch.depth=0.2"), "idmap patch rtt synthesis ");
}

TEST(SynthesisStages, LayersSurviveTheProjectFile) {
  const Products products = bake(layeredVase());
  const auto made = products.get<LayersProduct>("layers");
  const auto again = std::dynamic_pointer_cast<const LayersProduct>(LayersProduct::load(made->save()));
  ASSERT_EQ(again->tables.size(), 1u);
  EXPECT_EQ(again->tables[0]->rtt->values, made->tables[0]->rtt->values);
  const auto map = products.get<IdMapProduct>("idmap");
  const auto read = std::dynamic_pointer_cast<const IdMapProduct>(IdMapProduct::load(map->save()));
  EXPECT_EQ(read->map->layers, 1);
  EXPECT_EQ(read->map->weights, map->map->weights);
  ProductData data = map->save();
  data.arrays["layers"].shape = {96, 32, 3};
  EXPECT_THROW(IdMapProduct::load(data), FileError);
  data = made->save();
  data.meta = "{}";
  EXPECT_THROW(LayersProduct::load(data), FileError);
  data = made->save();
  data.arrays.erase("values0");
  EXPECT_THROW(LayersProduct::load(data), FileError);
  EXPECT_TRUE(std::dynamic_pointer_cast<const LayersProduct>(LayersProduct::load(LayersProduct().save()))
                  ->tables.empty());
}

TEST(SynthesisStages, WrongLayersAreNamed) {
  Recipe recipe = layeredVase();
  recipe.layers[0].patch.model = PatchModel::Btf;
  try {
    bake(recipe);
    FAIL();
  } catch (const ValueError& error) {
    EXPECT_EQ(error.where(), "layers[0].patch.btf");
  }
  recipe = layeredVase();
  recipe.layers[0].spots = "0,0,0 0.1";
  EXPECT_THROW(bake(recipe), ValueError);
  recipe.layers.resize(4);
  EXPECT_THROW(checkRecipe(recipe, ""), ValueError);
}

TEST(SynthesisStages, SurviveTheProjectFile) {
  const Products products = bake(small());
  const auto made = products.get<SynthesisProduct>("synthesis");
  const auto again = std::dynamic_pointer_cast<const SynthesisProduct>(SynthesisProduct::load(made->save()));
  EXPECT_EQ(again->meso->positions, made->meso->positions);
  EXPECT_EQ(again->meso->triangle, made->meso->triangle);
  EXPECT_EQ(again->meso->levelEnd, made->meso->levelEnd);
  EXPECT_EQ(*again->coordinates, *made->coordinates);
  EXPECT_EQ(again->quality.coherence, made->quality.coherence);
  const auto map = products.get<IdMapProduct>("idmap");
  EXPECT_EQ(std::dynamic_pointer_cast<const IdMapProduct>(IdMapProduct::load(map->save()))->map->ids,
            map->map->ids);
  // And empty ones.
  EXPECT_FALSE(
      std::dynamic_pointer_cast<const SynthesisProduct>(SynthesisProduct::load(SynthesisProduct().save()))
          ->meso);
}

TEST(SynthesisStages, BrokenDataIsRefused) {
  const Products products = bake(small());
  const auto made = products.get<SynthesisProduct>("synthesis");
  ProductData data = made->save();
  data.arrays.erase("normals");
  EXPECT_THROW(SynthesisProduct::load(data), FileError);
  data = made->save();
  data.meta = "{}";
  EXPECT_THROW(SynthesisProduct::load(data), FileError);
  data = made->save();
  std::fill(data.arrays["coordinates"].bytes.begin(), data.arrays["coordinates"].bytes.end(),
            std::byte(0xff));
  EXPECT_THROW(SynthesisProduct::load(data), FileError);
  data = made->save();
  std::fill(data.arrays["levels"].bytes.begin(), data.arrays["levels"].bytes.end(), std::byte(0xff));
  EXPECT_THROW(SynthesisProduct::load(data), FileError);
  data = products.get<IdMapProduct>("idmap")->save();
  data.arrays["ids"].shape = {96, 48, 4};
  EXPECT_THROW(IdMapProduct::load(data), FileError);
}

TEST(SynthesisStages, PreviewsCoverTheSurfaceCoarsely) {
  struct Watch : PipelineListener {
    std::vector<std::size_t> counts;
    int maps = 0;
    void preview(const Stage& stage, const ProductState& state) override {
      if (stage.name == "idmap") ++maps;
      if (stage.name != "synthesis") return;
      const auto& product = dynamic_cast<const SynthesisProduct&>(*state.product);
      counts.push_back(product.meso->vertexCount());
      EXPECT_EQ(product.coordinates->size(), counts.back());
      EXPECT_EQ(product.meso->levelEnd.back(), counts.back());
      EXPECT_FALSE(state.final());
    }
  } watch;
  bake(small(), nullptr, &watch);
  ASSERT_GE(watch.counts.size(), 2u);
  EXPECT_TRUE(std::is_sorted(watch.counts.begin(), watch.counts.end()));
  EXPECT_EQ(watch.maps, int(watch.counts.size()));
}

TEST(SynthesisStages, StrokesAndWishesAreText) {
  const std::vector<FieldStroke> strokes = parseStrokes("0,0,1 0.5,0,1; 1,2,3 4,5,6  7,8,-9e-1;");
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[1].points.size(), 3u);
  EXPECT_EQ(strokes[1].points[2], Vec3(7, 8, -0.9f));
  const auto again = parseStrokes(strokesToText(strokes));
  EXPECT_EQ(again[1].points, strokes[1].points);
  EXPECT_TRUE(parseStrokes("").empty());
  for (const char* wrong : {"1,2,3", "1,2 3,4", "a,b,c d,e,f", "1,2,3 4,5,nan"})
    EXPECT_THROW(parseStrokes(wrong), ValueError) << wrong;
  const std::vector<PatchWish> wishes = parseWishes("0,1,2 0.5 0.25,0.75 0.1");
  ASSERT_EQ(wishes.size(), 1u);
  EXPECT_EQ(wishes[0].place, Vec2(0.25f, 0.75f));
  EXPECT_EQ(parseWishes(wishesToText(wishes))[0].centre, wishes[0].centre);
  const std::vector<LayerSpot> spots = parseSpots("0,1,2 0.5 1;3,4,5 0.25 0.5");
  ASSERT_EQ(spots.size(), 2u);
  EXPECT_EQ(spots[1], (LayerSpot{{3, 4, 5}, 0.25f, 0.5f}));
  EXPECT_EQ(parseSpots(spotsToText(spots)), spots);
  for (const char* wrong : {"0,1,2 0.5", "0,1,2 0 1", "0,1,2 1 1.5", "x"})
    EXPECT_THROW(parseSpots(wrong), ValueError) << wrong;
  for (const char* wrong : {"0,1,2 0.5 0.25,0.75", "0,1,2 0 0.5,0.5 0.1", "x"})
    EXPECT_THROW(parseWishes(wrong), ValueError) << wrong;
}

TEST(SynthesisStages, AreExported) {
  const Products products = bake(small());
  const auto synthesis = products.get<SynthesisProduct>("synthesis");
  const auto map = products.get<IdMapProduct>("idmap");
  test::TemporaryFolder folder;
  Job job;
  exportParts(
      {products.get<SceneProduct>("scene")->scene->mesh, products.get<FramesProduct>("frames")->frames,
       products.get<AtlasProduct>("atlas")->atlas.get(), products.get<RttProduct>("rtt")->rtt.get(), nullptr,
       synthesis.get(), map.get()},
      folder.path() / "npy", job);
  const Array ids = readNpy(folder.path() / "npy/idmap.npy");
  EXPECT_EQ(ids.shape, (std::vector<std::int64_t>{96, 96, 2}));
  const auto values = ids.as<float>();
  for (std::size_t i = 0; i < map->map->ids.size() / 2; ++i) {
    if (map->map->empty(i)) {
      ASSERT_EQ(values[2 * i], -1);
    } else {
      ASSERT_TRUE(values[2 * i] >= 0 && values[2 * i] < 1);
    }
  }
  const Array patch = readNpy(folder.path() / "npy/meso_patch.npy");
  EXPECT_EQ(patch.shape, (std::vector<std::int64_t>{std::int64_t(synthesis->meso->vertexCount()), 2}));
  EXPECT_EQ(readNpy(folder.path() / "npy/meso_positions.npy").shape[0], patch.shape[0]);
  const Image picture = idMapPicture(*map->map);
  EXPECT_EQ(picture.width, 96);
}

TEST(SynthesisStages, VerticesFollowTheTexelsWhenAskedTo) {
  Recipe recipe = small();
  recipe.synthesis.vertices = 0;
  const auto synthesis = bake(recipe).get<SynthesisProduct>("synthesis");
  // One vertex apart is one texel.
  EXPECT_NEAR(synthesis->meso->edge, synthesis->patchWidth / 16, 0.05 * synthesis->patchWidth / 16);
}

}  // namespace
}  // namespace prt
