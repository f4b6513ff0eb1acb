#include "libprt/project/patch_stages.h"

#include "libprt/core/error.h"
#include "libprt/core/image_io.h"
#include "libprt/meso/btf_render.h"
#include "libprt/meso/rtt_seam.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/source_hash.h"
#include "tests/project/toy_stages.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

using test::MemoryStore;

Recipe small(PatchModel model) {
  Recipe recipe;
  recipe.patch.model = model;
  recipe.patch.yarns = 2, recipe.patch.grid = 16;
  recipe.rtt.texels = 8, recipe.rtt.views = 2, recipe.rtt.rays = 64, recipe.rtt.bounces = 1;
  return recipe;
}

std::shared_ptr<const RttProduct> bake(const Recipe& recipe, ProductStore* store,
                                       PipelineListener* listener = nullptr,
                                       const std::filesystem::path& folder = ".") {
  Job job;
  return Pipeline(store, {folder}).run(recipe, {"rtt"}, job, listener).get<RttProduct>("rtt");
}

struct Watcher : PipelineListener {
  void stageDone(const Stage& stage, const ProductState&, bool made) override {
    if (made) ran.push_back(stage.name);
  }
  void preview(const Stage& stage, const ProductState& state) override {
    EXPECT_EQ(stage.name, "rtt");
    EXPECT_LT(state.level, state.levels);
    ++previews;
  }
  std::vector<std::string> ran;
  int previews = 0;
};

TEST(PatchStages, ProductsComeBackAsTheyWere) {
  for (const RttStorage storage : {RttStorage::Float, RttStorage::Half, RttStorage::Byte}) {
    Recipe recipe = small(PatchModel::Weave);
    recipe.rtt.storage = storage;
    recipe.patch.warp = Rgb(1, 0.5f, 0.2f);
    recipe.patch.texture = "builtin:checker";
    MemoryStore store;
    const auto made = bake(recipe, &store);
    const auto found = bakedRtt(*std::make_unique<Pipeline>(&store, Pipeline::Options{}), recipe, "p.prt");
    if (storage == RttStorage::Byte) {
      EXPECT_LT(relativeDifference(*found->rtt, *made->rtt), 1e-5);
    } else {
      EXPECT_EQ(found->rtt->values, made->rtt->values);
    }
    EXPECT_EQ(found->storage, storage);
    EXPECT_EQ(found->storageError > 0, storage != RttStorage::Float);
    const auto patch = Pipeline(&store, {}).find(recipe, {"patch"}).get<PatchProduct>("patch");
    ASSERT_TRUE(patch && patch->patch);
    EXPECT_TRUE(patch->patch->backed);
    EXPECT_TRUE(patch->patch->albedoTexture);
    Job job;
    const Patch fresh = buildPatch(recipe.patch, {}, job);
    EXPECT_EQ(patch->patch->mesh.positions, fresh.mesh.positions);
    EXPECT_EQ(patch->patch->twin, fresh.twin);
    EXPECT_EQ(patch->patch->middle(), fresh.middle());
  }
}

TEST(PatchStages, OnlyWhatChangedIsBakedAgain) {
  MemoryStore store;
  Recipe recipe = small(PatchModel::HeightField);
  const auto ran = [&](const Recipe& r) {
    Watcher watcher;
    bake(r, &store, &watcher);
    return watcher.ran;
  };
  EXPECT_EQ(ran(recipe), (std::vector<std::string>{"patch", "rtt"}));
  EXPECT_EQ(ran(recipe), std::vector<std::string>{});
  recipe.rtt.bounces = 2;
  EXPECT_EQ(ran(recipe), std::vector<std::string>{"rtt"});
  recipe.patch.yarns = 4;     // no weave
  recipe.patch.exponent = 7;  // nor gloss
  EXPECT_EQ(ran(recipe), std::vector<std::string>{});
  recipe.patch.albedo = Rgb(0.2f);
  EXPECT_EQ(ran(recipe), (std::vector<std::string>{"patch", "rtt"}));
}

TEST(PatchStages, PreviewsComeImageByImage) {
  Recipe recipe = small(PatchModel::HeightField);
  recipe.rtt.views = 4;
  recipe.rtt.rays = 512;
  Watcher watcher;
  bake(recipe, nullptr, &watcher);
  EXPECT_EQ(watcher.previews, 2);  // the coarse one, and after 8 of 16 images
}

TEST(PatchStages, WithoutAPatchThereIsNothing) {
  MemoryStore store;
  const Recipe recipe = small(PatchModel::None);
  EXPECT_FALSE(hasPatch(recipe));
  EXPECT_FALSE(bake(recipe, &store)->rtt);
  Pipeline pipeline(&store, {});
  EXPECT_THROW(bakedRtt(pipeline, recipe, "p.prt"), ValueError);
  for (const Stage& stage : stages())
    if (stage.name == "patch" || stage.name == "rtt") {
      ASSERT_TRUE(stage.wanted);
      EXPECT_FALSE(stage.wanted(recipe));
      EXPECT_TRUE(stage.wanted(small(PatchModel::Flat)));
    }
}

TEST(PatchStages, ReadsHeightMapsAndNamesWhatIsWrong) {
  const test::TemporaryFolder folder;
  Image image(8, 8, 1);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 5) / 5;
  writeImage(folder / "height.png", image);
  Recipe recipe = small(PatchModel::HeightField);
  recipe.patch.heightmap = "height.png";
  EXPECT_TRUE(bake(recipe, nullptr, nullptr, folder.path())->rtt);
  recipe.patch.heightmap = "gone.png";
  EXPECT_THROW(bake(recipe, nullptr, nullptr, folder.path()), FileError);
  recipe.patch.heightmap = "builtin:gone";
  EXPECT_THROW(bake(recipe, nullptr, nullptr, folder.path()), ValueError);
}

/// Pictures of a flat patch in a folder, changed on the way; returns the patch.
PatchScene writeFlatBtf(const std::filesystem::path& folder, const RttSettings& settings,
                        const std::function<void(BtfView&)>& change = {}) {
  Job job;
  const LightSet lights = lightGrid(4, 8);
  PatchScene patch =
      makePatchScene(std::make_shared<Patch>(buildPatch(small(PatchModel::Flat).patch, {}, job)), job);
  BtfWriter writer(folder, lights);
  renderBtf(patch, settings, lights, job, [&](BtfView view) {
    if (change) change(view);
    writer.add(view, job);
  });
  writer.finish();
  return patch;
}

RttSettings fewTexels(int texels) {
  RttSettings settings;
  settings.texels = texels, settings.views = 2, settings.rays = 64;
  return settings;
}

TEST(PatchStages, ImportsImagesAndSeesWhenTheyChange) {
  const test::TemporaryFolder folder;
  Job job;
  const RttSettings settings = fewTexels(4);
  const PatchScene patch = writeFlatBtf(folder.path(), settings);
  Recipe recipe = small(PatchModel::Btf);
  EXPECT_THROW(bake(recipe, nullptr, nullptr, folder.path()), ValueError);  // names no set
  recipe.patch.btf = "manifest.json";
  recipe.rtt.texels = 4;
  const auto rtt = bake(recipe, nullptr, nullptr, folder.path());
  EXPECT_LT(relativeDifference(*rtt->rtt, bakeRtt(patch, settings, job)), 0.01);
  EXPECT_EQ(filesBeside(folder / "manifest.json").size(), 4u * 32u);
  const std::string before = hashSource(folder / "manifest.json");
  writeImage(folder / "view_000_light_000.exr", Image(4, 4, 3));
  EXPECT_NE(hashSource(folder / "manifest.json"), before);
}

TEST(PatchStages, ASampleThatDoesNotTileIsMadeTo) {
  const test::TemporaryFolder folder;
  writeFlatBtf(folder.path(), fewTexels(16), [](BtfView& view) {
    const std::size_t numbers = view.lights * std::size_t(view.channels);
    for (std::size_t i = 0; i < view.values.size(); ++i) {
      const std::size_t u = i / numbers % 16, v = i / numbers / 16;
      view.values[i] *= 1 + float(u) / 16 + 0.1f * float((u + v) % 2);  // brighter towards +u, with a grain
    }
  });
  Recipe recipe = small(PatchModel::Btf);
  recipe.patch.btf = "manifest.json";
  recipe.rtt.texels = 16;
  EXPECT_GT(seamStep(*bake(recipe, nullptr, nullptr, folder.path())->rtt), 3);
  recipe.patch.seamless = true;
  EXPECT_LT(seamStep(*bake(recipe, nullptr, nullptr, folder.path())->rtt), 1.5);
}

TEST(PatchStages, DamagedProductsAreRefused) {
  MemoryStore store;
  Recipe recipe = small(PatchModel::HeightField);
  Job job;
  const Products products = Pipeline(&store, {}).run(recipe, {"rtt"}, job);
  const ProductData rtt = products.get<RttProduct>("rtt")->save(),
                    patch = products.get<PatchProduct>("patch")->save();
  const auto broken = [](ProductData data, const auto& change) {
    change(data);
    return data;
  };
  EXPECT_THROW(RttProduct::load(broken(rtt, [](ProductData& d) { d.arrays["values"].shape[0] = 7; })),
               FileError);
  EXPECT_THROW(RttProduct::load(broken(rtt, [](ProductData& d) { d.meta = "{}"; })), FileError);
  EXPECT_THROW(RttProduct::load(broken(rtt, [](ProductData& d) { d.arrays["values"].bytes.resize(8); })),
               FileError);
  EXPECT_THROW(PatchProduct::load(broken(patch, [](ProductData& d) { d.arrays.erase("twin"); })), FileError);
  EXPECT_THROW(PatchProduct::load(broken(patch,
                                         [](ProductData& d) {
                                           const std::uint32_t corner[3] = {0, 1, 1u << 30};
                                           d.arrays["triangles"] = Array::from<std::uint32_t>(corner, {1, 3});
                                         })),
               FileError);
}

}  // namespace
}  // namespace prt
