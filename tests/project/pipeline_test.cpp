#include "libprt/project/pipeline.h"
#include "tests/project/toy_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace prt {
namespace {

using test::MemoryStore;
using test::Number;
using test::ToyStages;
using testing::ElementsAre;
using Runs = std::map<std::string, int>;

const std::vector<std::string> kAll{"frames", "bounces"};

struct Watcher : PipelineListener {
  void stageDone(const Stage& s, const ProductState& state, bool made) override {
    EXPECT_TRUE(state.final());
    heard.push_back(s.name + (made ? " made" : " found"));
  }
  void preview(const Stage& s, const ProductState& state) override {
    EXPECT_FALSE(state.final());
    heard.push_back(s.name + " " + std::to_string(state.level) + "/" + std::to_string(state.levels));
  }
  std::vector<std::string> heard;
};

Recipe small() {
  Recipe recipe;
  recipe.transfer.rays = 64;
  return recipe;
}

Products runOn(ToyStages& toy, ProductStore* store, const Recipe& recipe,
               PipelineListener* listener = nullptr) {
  Pipeline pipeline(store, {".", 0}, toy.table);
  Job job;
  return pipeline.run(recipe, kAll, job, listener);
}

double result(const Products& products) {
  return products.get<Number>("bounces")->value;
}

/// Which stages run again after an edit, everything else being in the store.
struct EditCase {
  const char* path;
  const char* value;
  Runs runs;
};

class Edits : public testing::TestWithParam<EditCase> {};

TEST_P(Edits, RunExactlyWhatReadThem) {
  ToyStages toy;
  MemoryStore store;
  Recipe recipe = small();
  recipe.objects[0].material.model = MaterialModel::Phong;
  recipe.objects[0].material.specular = Rgb(0.2f);
  runOn(toy, &store, recipe);
  toy.runs.clear();
  setByPath(recipe, GetParam().path, GetParam().value);
  runOn(toy, &store, recipe);
  Runs runs = toy.runs;
  runs.erase("frames");  // never stored
  EXPECT_EQ(runs, GetParam().runs) << GetParam().path;
}

INSTANTIATE_TEST_SUITE_P(
    Pipeline, Edits,
    testing::Values(EditCase{"objects[0].name", "other", {}},
                    EditCase{"material.albedo", "0.9", {{"bounces", 1}}},
                    EditCase{"material.exponent", "900", {}},
                    EditCase{"transfer.bounces", "1", {{"bounces", 1}}},
                    EditCase{"transfer.bands", "4", {{"direct", 1}, {"bounces", 1}}},
                    EditCase{"transfer.rays", "128", {{"direct", 1}, {"bounces", 1}}},
                    EditCase{"transform.translate", "1,0,0", {{"direct", 1}, {"bounces", 1}}},
                    EditCase{"mesh.detail", "2", {{"mesh", 1}, {"direct", 1}, {"bounces", 1}}},
                    EditCase{"mesh.path", "builtin:bird", {{"mesh", 1}, {"direct", 1}, {"bounces", 1}}},
                    EditCase{"mesh.seed", "7", {}},     // the vase has no noise
                    EditCase{"mesh.crease", "30", {}},  // files only
                    EditCase{"lights[0].rotation", "90", {}}, EditCase{"method.name", "diffuse", {}}));

TEST(Pipeline, UndoFindsTheOldProducts) {
  ToyStages toy;
  MemoryStore store;
  Recipe recipe = small();
  runOn(toy, &store, recipe);
  Recipe edited = recipe;
  setByPath(edited, "material.albedo", "0.1");
  runOn(toy, &store, edited);
  toy.runs.clear();
  runOn(toy, &store, recipe);
  EXPECT_EQ(toy.runs.count("bounces"), 0u);
}

TEST(Pipeline, PreviewsFlowDownstreamAndAreMarked) {
  ToyStages toy;
  Watcher watcher;
  Recipe recipe = small();
  recipe.transfer.rays = 48;
  runOn(toy, nullptr, recipe, &watcher);
  EXPECT_THAT(watcher.heard, ElementsAre("mesh made", "frames made", "direct 1/3", "bounces 1/3",
                                         "direct 2/3", "bounces 2/3", "direct made", "bounces made"));
}

TEST(Pipeline, PreviewsAreNoExcuseNotToFinish) {
  ToyStages toy;
  MemoryStore store;
  Watcher watcher;
  toy.cancelAtPass = 2;
  EXPECT_THROW(runOn(toy, &store, small(), &watcher), Cancelled);
  toy.cancelAtPass = -1;
  Pipeline pipeline(&store, {".", 0}, toy.table);
  const Products found = pipeline.find(small(), kAll);
  ASSERT_NE(found.state("bounces"), nullptr);
  EXPECT_FALSE(found.state("bounces")->final());
  EXPECT_EQ(found.state("bounces")->level, 2);
  const Products done = runOn(toy, &store, small());
  EXPECT_TRUE(done.state("bounces")->final());
}

// A store that takes so long that whoever cancelled would wait for it.
class SlowStore : public MemoryStore {
 public:
  void put(const std::string& stage, const std::string& key, const Stored& stored,
           const WriteCheck& check) override {
    for (int i = 0; check && i < 4; ++i) check(), std::this_thread::sleep_for(std::chrono::milliseconds(2));
    MemoryStore::put(stage, key, stored, {});
  }
};

TEST(Pipeline, ACancelledRunMayBeGivenLittleTimeToWrite) {
  for (const bool hurry : {false, true}) {
    ToyStages toy;
    SlowStore store;
    Watcher watcher;
    toy.cancelAtPass = 2;
    Pipeline pipeline(&store, {.folder = ".", .checkpointSeconds = 0, .lastWriteSeconds = hurry ? 1e-6 : 60},
                      toy.table);
    Job job;
    EXPECT_THROW(pipeline.run(small(), kAll, job, &watcher), Cancelled);
    const Products found = Pipeline(&store, {".", 0}, toy.table).find(small(), kAll);
    EXPECT_EQ(found.state("bounces") != nullptr, !hurry);
    // The checkpoint was written before and is there in any case.
    toy.cancelAtPass = -1;
    runOn(toy, &store, small());
    EXPECT_EQ(toy.passes, 4) << "work was done twice";
  }
}

TEST(Pipeline, ResumesWithTheSameBits) {
  ToyStages whole;
  const double expected = result(runOn(whole, nullptr, small()));
  for (int cancelAt = 0; cancelAt < 4; ++cancelAt) {
    ToyStages toy;
    MemoryStore store;
    toy.cancelAtPass = cancelAt;
    EXPECT_THROW(runOn(toy, &store, small()), Cancelled);
    toy.cancelAtPass = -1;
    EXPECT_EQ(result(runOn(toy, &store, small())), expected);
    EXPECT_EQ(toy.passes, 4) << "work was done twice";
  }
}

TEST(Pipeline, MoreRaysExtendWhatIsThere) {
  ToyStages toy, fresh;
  MemoryStore store;
  Recipe recipe = small();
  runOn(toy, &store, recipe);
  recipe.transfer.rays = 128;
  EXPECT_EQ(result(runOn(toy, &store, recipe)), result(runOn(fresh, nullptr, recipe)));
  EXPECT_EQ(toy.passes, 8);
}

TEST(Pipeline, FewerRaysGiveWhatAFreshBakeGives) {
  ToyStages toy, fresh;
  MemoryStore store;
  Recipe recipe = small();
  recipe.transfer.rays = 128;
  runOn(toy, &store, recipe);
  recipe.transfer.rays = 64;
  EXPECT_EQ(result(runOn(toy, &store, recipe)), result(runOn(fresh, nullptr, recipe)));
}

TEST(Pipeline, ProductsAreSharedBetweenRuns) {
  ToyStages toy;
  Pipeline pipeline(nullptr, {}, toy.table);
  Job job;
  const auto first = pipeline.run(small(), kAll, job).get<Number>("bounces");
  EXPECT_EQ(pipeline.run(small(), kAll, job).get<Number>("bounces"), first);
}

TEST(Pipeline, UnknownStagesAreNamed) {
  ToyStages toy;
  Pipeline pipeline(nullptr, {}, toy.table);
  Job job;
  EXPECT_THROW(pipeline.run(small(), {"charts"}, job), ValueError);
}

class SourceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("prt_sources_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; }
  std::string meshKey(const std::string& path) {
    Recipe recipe;
    recipe.objects[0].mesh.path = path;
    return Pipeline(&store, {folder}, toy.table).keys(recipe).at("mesh");
  }

  std::filesystem::path folder;
  ToyStages toy;
  MemoryStore store;
};

TEST_F(SourceFiles, ContentsCountNotNames) {
  write("a.obj", "v 0 0 0");
  write("b.obj", "v 0 0 0");
  write("c.obj", "v 1 0 0");
  EXPECT_EQ(meshKey("a.obj"), meshKey("b.obj"));
  EXPECT_NE(meshKey("a.obj"), meshKey("c.obj"));
}

TEST_F(SourceFiles, AMissingFileKeepsItsLastHash) {
  write("a.obj", "v 0 0 0");
  const std::string key = meshKey("a.obj");
  std::filesystem::remove(folder / "a.obj");
  EXPECT_EQ(meshKey("a.obj"), key);
  EXPECT_THROW(meshKey("never.obj"), FileError);
}

TEST_F(SourceFiles, BuffersOfAGltfCount) {
  write("m.gltf", R"({"buffers": [{"uri": "m.bin"}]})");
  write("m.bin", "one");
  const std::string key = meshKey("m.gltf");
  write("m.bin", "three");
  EXPECT_NE(meshKey("m.gltf"), key);
}

}  // namespace
}  // namespace prt
