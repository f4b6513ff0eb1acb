#include "libprt/project/atlas_stages.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/core/error.h"
#include "libprt/core/npy.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_writer.h"
#include "libprt/mesh/repair.h"
#include "libprt/project/hand_cuts.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/project/relight.h"
#include "tests/project/toy_stages.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using test::MemoryStore;

Recipe small(const std::string& mesh) {
  Recipe recipe;
  recipe.objects[0].mesh.path = mesh;
  recipe.objects[0].mesh.detail = 0.4f;
  recipe.atlas.size = 256;
  return recipe;
}

Products bake(const Recipe& recipe, ProductStore* store = nullptr) {
  Job job;
  return Pipeline(store, {}).run(recipe, {"atlas"}, job);
}

TEST(AtlasStages, UnfoldABuiltInShape) {
  const auto atlas = bake(small("builtin:vase")).get<AtlasProduct>("atlas");
  ASSERT_TRUE(atlas && atlas->atlas);
  EXPECT_GE(atlas->facts.charts, 1u);
  EXPECT_LE(atlas->facts.l2, 1.10);
  EXPECT_GT(atlas->facts.filled, 0.3);
  EXPECT_GT(atlas->facts.seam, 0);
  Job job;
  EXPECT_TRUE(overlappingTexels(*atlas->atlas, 256, job).empty());
}

TEST(AtlasStages, AreMadeOnlyWhenAskedFor) {
  for (const Stage& stage : stages())
    if (stage.name == "charts" || stage.name == "atlas") {
      EXPECT_TRUE(stage.wanted && !stage.wanted(Recipe{}));
    }
}

TEST(AtlasStages, SurviveTheProjectFile) {
  MemoryStore store;
  const Recipe recipe = small("builtin:vase");
  const Products products = bake(recipe, &store);
  const auto made = products.get<AtlasProduct>("atlas");
  const auto charts = products.get<ChartsProduct>("charts");
  ASSERT_TRUE(made && charts);
  const auto again = std::dynamic_pointer_cast<const AtlasProduct>(AtlasProduct::load(made->save()));
  EXPECT_EQ(again->atlas->uv, made->atlas->uv);
  EXPECT_EQ(again->atlas->chartOf, made->atlas->chartOf);
  EXPECT_EQ(again->facts.l2, made->facts.l2);
  ASSERT_EQ(again->atlas->placements.size(), made->atlas->placements.size());
  EXPECT_EQ(again->atlas->placements[0].offset, made->atlas->placements[0].offset);
  const auto flat = std::dynamic_pointer_cast<const ChartsProduct>(ChartsProduct::load(charts->save()));
  EXPECT_EQ(flat->charts->uv, charts->charts->uv);
  EXPECT_TRUE(flat->charts->seams == charts->charts->seams);
  for (std::size_t c = 0; c < flat->charts->charts.charts.size(); ++c) {
    EXPECT_EQ(flat->charts->charts.charts[c].triangles, charts->charts->charts.charts[c].triangles);
    EXPECT_EQ(flat->charts->charts.charts[c].loops[0], charts->charts->charts.charts[c].loops[0]);
  }
}

TEST(AtlasStages, BrokenDataIsRefused) {
  const auto made = bake(small("builtin:box")).get<AtlasProduct>("atlas");
  ProductData data = made->save();
  data.arrays.erase("uv");
  EXPECT_THROW(AtlasProduct::load(data), FileError);
  data = made->save();
  data.arrays["chart_of"].bytes.resize(4);
  data.arrays["chart_of"].shape = {1};
  EXPECT_THROW(AtlasProduct::load(data), FileError);
  data = made->save();
  data.meta = "{}";
  EXPECT_THROW(AtlasProduct::load(data), FileError);
  const auto charts = bake(small("builtin:box")).get<ChartsProduct>("charts");
  data = charts->save();
  std::fill(data.arrays["triangles"].bytes.begin(), data.arrays["triangles"].bytes.end(), std::byte(0xff));
  EXPECT_THROW(ChartsProduct::load(data), FileError);
}

TEST(AtlasStages, AnAtlasSettingLeavesTheChartsAlone) {
  Job job;
  Pipeline pipeline(nullptr, {});
  Recipe recipe = small("builtin:box");
  const auto before = pipeline.keys(recipe);
  recipe.atlas.gutter = 3;
  const auto after = pipeline.keys(recipe);
  EXPECT_EQ(before.at("charts"), after.at("charts"));
  EXPECT_NE(before.at("atlas"), after.at("atlas"));
  EXPECT_EQ(before.at("transfer"), after.at("transfer"));
  recipe.objects[0].seams = "0 1";
  EXPECT_EQ(before.at("mesh"), pipeline.keys(recipe).at("mesh"));
}

TEST(AtlasStages, ManualCutsAreThoseOfTheRecipe) {
  Recipe recipe = small("builtin:box");
  recipe.charts.mode = ChartsMode::Manual;
  try {
    bake(recipe);  // nothing cut: closed
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_EQ(error.where(), "chart 1");
    EXPECT_NE(error.problem().find("closed"), std::string::npos);
  }
  // Three of the edges that meet in a corner leave a disk.
  const auto product = bake(small("builtin:box")).get<SceneProduct>("scene");
  const TriMesh& mesh = product->scene->mesh;
  Job job;
  const Surface surface(mesh, job);
  Seams seams(surface);
  const Charts charts = makeDisks(surface, seams, seamCosts(surface, {}, job), job);
  ASSERT_EQ(charts.charts.size(), 1u);
  recipe.objects[0].seams = seamsToText(surface, seams);
  const auto atlas = bake(recipe).get<AtlasProduct>("atlas");
  EXPECT_EQ(atlas->facts.charts, 1u);
  recipe.objects[0].seams = "0 9999999";
  EXPECT_THROW(bake(recipe), ValueError);
}

TEST(AtlasStages, ImportedCoordinatesAreKeptOrRefusedWithThePlace) {
  Recipe recipe = small("builtin:torus");
  recipe.charts.mode = ChartsMode::Imported;
  const Products products = bake(recipe);
  const auto atlas = products.get<AtlasProduct>("atlas");
  EXPECT_EQ(atlas->atlas->uv, products.get<SceneProduct>("scene")->scene->mesh.uv);
  EXPECT_GT(atlas->facts.filled, 0.9);

  const test::TemporaryFolder folder;
  TriMesh mesh = makePlane({.columns = 4, .rows = 4});
  for (Vec2& uv : mesh.uv) uv.x = std::abs(uv.x - 0.5f);
  Job job;
  writeMesh(folder.path() / "folded.obj", mesh, {}, job);
  recipe.objects[0].mesh.path = (folder.path() / "folded.obj").string();
  try {
    bake(recipe);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_EQ(error.where(), "texture coordinates");
    EXPECT_NE(error.problem().find("places in all"), std::string::npos);
  }
}

TEST(AtlasStages, PolygonsHaveTheCornersAskedFor) {
  Recipe recipe = small("builtin:vase");
  recipe.charts.boundary = ChartsBoundary::Polygon;
  recipe.charts.corners = 5;
  const auto atlas = bake(recipe).get<AtlasProduct>("atlas");
  EXPECT_GE(atlas->facts.l2, 1.0);
  Job job;
  EXPECT_TRUE(overlappingTexels(*atlas->atlas, 256, job).empty());
}

// Charts are cut for free boundaries: on triangles they stretch more than was asked for, and that is said.
TEST(AtlasStages, ABoundMissedOnPolygonsNamesTheChart) {
  Recipe recipe = small("builtin:vase");
  const Products free = bake(recipe);
  EXPECT_EQ(stretchNote(recipe, *free.get<ChartsProduct>("charts")), "");
  recipe.charts.boundary = ChartsBoundary::Polygon;
  recipe.charts.corners = 3;
  const Products polygons = bake(recipe);
  EXPECT_GT(polygons.get<AtlasProduct>("atlas")->facts.l2, 1.10);
  const std::string note = stretchNote(recipe, *polygons.get<ChartsProduct>("charts"));
  EXPECT_NE(note.find("chart "), std::string::npos) << note;
  EXPECT_NE(note.find("1.100"), std::string::npos) << note;
}

Recipe texels(int count) {
  Recipe recipe = small("builtin:vase");
  recipe.transfer.where = TransferWhere::Texel;
  recipe.transfer.texels = count;
  recipe.transfer.rays = 16;
  recipe.transfer.bounces = 1;
  return recipe;
}

std::vector<std::string> stagesMade(Pipeline& pipeline, const Recipe& recipe) {
  struct : PipelineListener {
    std::vector<std::string> made;
    void stageBegun(const Stage& stage) override { made.push_back(stage.name); }
    bool wantsPreviews() const override { return false; }
  } listener;
  Job job;
  pipeline.run(recipe, {"transfer"}, job, &listener);
  return listener.made;
}

TEST(AtlasStages, TransferAtTexelsNeedsTheAtlasAndAtVerticesDoesNot) {
  const auto isMade = [](const std::vector<std::string>& made, const char* stage) {
    return std::find(made.begin(), made.end(), stage) != made.end();
  };
  MemoryStore store;
  Pipeline pipeline(&store, {});
  Recipe recipe = texels(48);
  const auto first = stagesMade(pipeline, recipe);
  for (const char* stage : {"charts", "atlas", "samples", "direct", "transfer"})
    EXPECT_TRUE(isMade(first, stage)) << stage;
  recipe.atlas.gutter = 3;  // packed anew, not cut anew, and so transfer is of other texels
  const auto packed = stagesMade(pipeline, recipe);
  EXPECT_FALSE(isMade(packed, "charts"));
  EXPECT_TRUE(isMade(packed, "atlas") && isMade(packed, "transfer"));
  recipe.transfer.texels = 32;
  const auto coarser = stagesMade(pipeline, recipe);
  EXPECT_FALSE(isMade(coarser, "atlas"));
  EXPECT_TRUE(isMade(coarser, "samples") && isMade(coarser, "transfer"));
  recipe.transfer.where = TransferWhere::Vertex;
  const auto vertices = stagesMade(pipeline, recipe);
  EXPECT_FALSE(isMade(vertices, "charts") || isMade(vertices, "atlas"));
  recipe.atlas.gutter = 1;
  EXPECT_TRUE(stagesMade(pipeline, recipe).empty());
  for (const Stage& stage : stages())
    if (stage.name == "atlas") {
      EXPECT_TRUE(isWanted(stage, texels(48)));
      EXPECT_FALSE(isWanted(stage, recipe));
    }
}

// At vertices the keys of samples and transfer are what they were before there were texels.
TEST(AtlasStages, TransferAtVerticesKeepsItsKey) {
  Recipe recipe = small("builtin:vase");
  const auto keys = Pipeline(nullptr, {}).keys(recipe);
  recipe.transfer.texels = 77;
  recipe.charts.stretch = 1.2f;
  EXPECT_EQ(Pipeline(nullptr, {}).keys(recipe).at("transfer"), keys.at("transfer"));
}

TEST(AtlasStages, PicturesAreDrawnFromTexels) {
  Job job;
  Recipe recipe = texels(64);
  const Products products = Pipeline(nullptr, {}).run(recipe, {"transfer"}, job);
  const BakedScene baked = bakedScene(products);
  ASSERT_TRUE(baked.samples->samples->texels);
  LightRig lights;
  lights.constant = Rgb(1);
  const Image image = relight(baked, recipe, lights, frameBox(baked.geometry->scene->mesh.bounds()),
                              {.width = 48, .height = 48}, job);
  float brightest = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) brightest = std::max(brightest, image.pixel(x, y)[0]);
  EXPECT_GT(brightest, 0.3f);
}

TEST(AtlasStages, SettingsOfSingleChartsAreUsedAndChecked) {
  Recipe recipe = small("builtin:torus");
  const auto before = bake(recipe);
  const auto packed = before.get<AtlasProduct>("atlas")->atlas;
  const Charts& charts = before.get<ChartsProduct>("charts")->charts->charts;
  const std::string last = std::to_string(charts.charts.back().faces.back());
  recipe.objects[0].charts = last + " place=0.5,0.5,0,0.01";
  const auto atlas = bake(recipe).get<AtlasProduct>("atlas")->atlas;
  EXPECT_EQ(atlas->placements.back().offset, DVec2(0.5));
  EXPECT_EQ(atlas->placements.back().scale, 0.01);
  recipe.objects[0].charts = last + " place=3,0.5,0,0.01";
  try {
    bake(recipe);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(error.problem().find("leaves the square"), std::string::npos);
    EXPECT_EQ(error.where(), "chart " + std::to_string(charts.charts.size()));
  }
  recipe.objects[0].charts = "99999999 weight=2";
  EXPECT_THROW(bake(recipe), ValueError);
  recipe.objects[0].charts = "1 weight=-2";
  EXPECT_THROW(checkRecipe(recipe, ""), ValueError);
}

TEST(AtlasStages, PlacingAChartDoesNotLayItFlatAnew) {
  Recipe recipe = small("builtin:vase");
  const auto keyOf = [](const Recipe& r, const char* stage) {
    return Pipeline(nullptr, {}).keys(r).at(stage);
  };
  const std::string charts = keyOf(recipe, "charts"), atlas = keyOf(recipe, "atlas");
  recipe.objects[0].charts = "0 weight=2 place=0.5,0.5,0,0.1";
  EXPECT_EQ(keyOf(recipe, "charts"), charts);
  EXPECT_NE(keyOf(recipe, "atlas"), atlas);
  recipe.objects[0].charts = "0 corners=5";
  EXPECT_NE(keyOf(recipe, "charts"), charts);
}

TEST(AtlasStages, CutsOfAnObjectBehindAHiddenOneStayItsOwn) {
  Recipe recipe = small("builtin:vase");
  recipe.charts.mode = ChartsMode::Manual;
  const Scene alone = *bake([] {
                         Recipe r = small("builtin:vase");
                         return r;
                       }())
                           .get<SceneProduct>("scene")
                           ->scene;
  Job job;
  const Surface surface(alone.mesh, job);
  Seams seams(surface);
  makeDisks(surface, seams, seamCosts(surface, {}, job), job);
  recipe.objects[0].seams = seamsOfObject(alone, surface, seams, 0);
  recipe.objects.insert(recipe.objects.begin(), recipe.objects[0]);
  recipe.objects[0].visible = false;
  recipe.objects[0].seams = "0 1";
  EXPECT_EQ(bake(recipe).get<AtlasProduct>("atlas")->facts.charts, 1u);
}

TEST(AtlasPlacements, RoundTripAndAreChecked) {
  const std::vector<ChartPlacement> places = parsePlacements("2 0.25 90 0.5 0.75", 3);
  ASSERT_EQ(places.size(), 3u);
  EXPECT_FALSE(places[0].locked);
  EXPECT_TRUE(places[1].locked);
  EXPECT_NEAR(places[1].angle, kPi / 2, 1e-12);
  EXPECT_EQ(placementsToText(places), "2 0.25 90 0.5 0.75");
  EXPECT_TRUE(parsePlacements("", 3).empty());
  EXPECT_THROW(parsePlacements("4 1 0 0 0", 3), ValueError);
  EXPECT_THROW(parsePlacements("1 0 0 0 0", 3), ValueError);
  EXPECT_THROW(parsePlacements("1 1 0 0", 3), ValueError);
  EXPECT_THROW(parsePlacements("one", 3), ValueError);
}

TEST(AtlasStages, ExportWritesCoordinatesAndGeometryImages) {
  const test::TemporaryFolder folder;
  Job job;
  const Products products = bake(small("builtin:vase"));
  const auto atlas = products.get<AtlasProduct>("atlas");
  const TriMesh& mesh = products.get<SceneProduct>("scene")->scene->mesh;
  const ExportedFiles files = exportAtlas(mesh, *atlas, folder.path(), job);
  for (const char* name :
       {"uv.npy", "uv_faces.npy", "uv_chart.npy", "geometry_position.npy", "geometry_normal.npy",
        "geometry_tangent.npy", "atlas.obj", "atlas.png", "manifest.json"})
    EXPECT_TRUE(std::find(files.begin(), files.end(), name) != files.end()) << name;
  EXPECT_EQ(readNpy(folder.path() / "geometry_position.npy").shape, (std::vector<std::int64_t>{256, 256, 3}));
  EXPECT_EQ(readNpy(folder.path() / "uv_chart.npy").shape[0], std::int64_t(mesh.triangleCount()));
  // The OBJ comes back as the same injective map.
  const TriMesh back = loadMesh(folder.path() / "atlas.obj", {}, job);
  EXPECT_TRUE(importAtlas(back, {.size = 256}, job).problems.empty());
}

}  // namespace
}  // namespace prt
