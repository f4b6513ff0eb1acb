#include "libprt/study/bench.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

/// Every bench runs and gives numbers that make sense; how good they are is for `prt bench`, on a quiet
/// machine.
TEST(Bench, EveryBenchGivesAResult) {
  for (const BenchInfo& info : benches()) {
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
