#include "libprt/study/bench.h"

#include "libprt/core/error.h"
#include "libprt/project/recipe.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

/// Every bench runs and gives numbers that make sense; how good they are is for `prt bench`, on a quiet
/// machine.
class EveryBench : public testing::TestWithParam<BenchInfo> {};

TEST_P(EveryBench, GivesAResult) {
  const BenchInfo& info = GetParam();
  if (info.name == "pipeline") GTEST_SKIP() << "takes minutes; below with little to bake";
  Job job;
  const BenchResult result = runBench(info.name, job, 1);
  EXPECT_EQ(result.name, info.name);
  EXPECT_GT(result.ratio, 0);
  EXPECT_GT(result.ours.value, 0);
  EXPECT_GT(result.against.value, 0);
  EXPECT_EQ(job.snapshot().fraction(), 1);
  const nlohmann::json json = toJson(result);
  EXPECT_EQ(json.at("ours").at("unit"), result.ours.unit);
  EXPECT_EQ(json.at("against").at("what"), result.againstWhat);
  EXPECT_TRUE(json.at("details").contains("threads"));
}

INSTANTIATE_TEST_SUITE_P(Bench, EveryBench, testing::ValuesIn(benches()),
                         [](const auto& bench) { return bench.param.name; });

TEST(Bench, ThePipelineEndsInALitFrame) {
  Recipe recipe = pipelineBenchRecipe("builtin:vase");
  recipe.objects[0].mesh.detail = 0.3f;
  recipe.transfer.rays = 64, recipe.transfer.bounces = 1;
  recipe.rtt.texels = 16, recipe.rtt.views = 2, recipe.rtt.rays = 32;
  recipe.synthesis.vertices = 5000, recipe.synthesis.scale = 0.2f;
  recipe.idmap.size = recipe.atlas.size = 256;
  Job job;
  const BenchResult result = runPipelineBench(recipe, job);
  EXPECT_GT(result.ours.value, 0);
  EXPECT_EQ(job.snapshot().fraction(), 1);
  EXPECT_GT(result.details.at("covered"), 0.05);
  for (const char* stage : {"charts", "atlas", "rtt", "synthesis", "idmap", "transfer", "frame"})
    EXPECT_TRUE(result.details.contains(std::string("seconds_") + stage)) << stage;
}

TEST(Bench, AnUnknownNameIsRefusedWithTheChoices) {
  Job job;
  try {
    runBench("nothing", job);
    FAIL();
  } catch (const ValueError& error) {
    EXPECT_NE(std::string(error.what()).find("bake, bounces, transfer"), std::string::npos);
  }
}

TEST(Bench, CancellingStops) {
  Job job;
  job.cancel();
  for (const BenchInfo& info : benches()) EXPECT_THROW(runBench(info.name, job), Cancelled);
}

}  // namespace
}  // namespace prt
