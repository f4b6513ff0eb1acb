#pragma once
// Benches: one measurement against its limit or its rival, both taken in the same run, interleaved, so that a
// busy or slow machine changes both alike. `prt bench NAME` prints one.

#include "libprt/core/job.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace prt {

struct Recipe;

struct BenchResult {
  struct Value {
    double value = 0;
    std::string unit;
  };
  std::string name;
  double ratio = 0;  ///< 1 = exactly at the limit, or as fast as the rival; larger is better
  Value ours;
  std::string againstWhat;  ///< what the limit or rival is, in words
  Value against;
  std::map<std::string, double> details;
};

/// {"name", "ratio", "ours": {"value", "unit"}, "against": {"what", "value", "unit"}, "details": {...}}
nlohmann::json toJson(const BenchResult& result);

struct BenchInfo {
  std::string name;
  std::string measures;  ///< one line for people
};
/// All benches, by name.
const std::vector<BenchInfo>& benches();

/// Runs one, with all threads of prt::threadCount(). `repetitions` of both sides are timed, their medians
/// compared; 0 = as many as the bench needs for a steady result. Throws ValueError, naming the choices, when
/// there is none of that name, and Cancelled.
BenchResult runBench(const std::string& name, Job& job, int repetitions = 0);
/// Bench "atlas" of a mesh file instead of the built-in shapes.
BenchResult runAtlasBench(const std::string& meshFile, Job& job, int repetitions = 0);
/// Bench "pipeline" of another recipe than its own, which is that of the built-in bird.
BenchResult runPipelineBench(const Recipe& recipe, Job& job);
/// The bench's recipe for a mesh: a weave at its defaults, transfer matrices.
Recipe pipelineBenchRecipe(const std::string& mesh);
/// Bench "atlas" of a built-in shape of a million triangles against twenty times what a hundred thousand
/// take.
BenchResult runLargeAtlasBench(Job& job);

}  // namespace prt
