#include "libprt/study/bench.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/generate.h"
#include "libprt/study/bench_list.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Entry {
  BenchInfo info;
  BenchResult (*run)(Job&, int repetitions);
  int repetitions;  // that give a steady median
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"bake", "direct 25x25 bake, 1024 rays a vertex: ray rate against the same rays thrown away"},
       benchBake,
       7},
      {{"bounces", "three diffuse bounces: time against that of the direct bake"}, benchBounces, 7},
      {{"transfer", "25x25 matrices times RGB light: time against reading the matrices"}, benchTransfer, 100},
      {{"rtt",
        "radiance transfer texture of the default weave, two bounces: rate against its own rays thrown away"},
       benchRtt,
       5},
      {{"atlas", "automatic charts and packing at 2048: time against laying the same charts flat alone"},
       benchAtlas,
       3},
      {{"synthesis",
        "960 000 vertices from a 64 x 64 weave and an id map of 2048: time against one pass over neighbours"},
       benchSynthesis,
       1},
      {{"pipeline", "mesh with a woven patch to the first lit frame: time against two minutes"},
       benchPipeline,
       1},
      {{"biscale", "512x512 frames of a woven rock, light and view changing: rate against the paper's 14.5"},
       benchBiscale,
       60},
      {{"equal",
        "path tracing of a rock's displaced stucco to the error of its bi-scale picture: how many frames it "
        "takes"},
       benchEqual,
       32},
      {{"studio", "frames of the studio's window under the hand: light drag, slider, gaps while it bakes"},
       benchStudio,
       90},
  };
  return all;
}

}  // namespace

const std::vector<BenchInfo>& benches() {
  static const std::vector<BenchInfo> infos = [] {
    std::vector<BenchInfo> list;
    for (const Entry& entry : entries()) list.push_back(entry.info);
    return list;
  }();
  return infos;
}

BenchResult runBench(const std::string& name, Job& job, int repetitions) {
  std::string names;
  for (const Entry& entry : entries()) {
    if (entry.info.name != name) {
      names += (names.empty() ? "" : ", ") + entry.info.name;
      continue;
    }
    BenchResult result = entry.run(job, repetitions > 0 ? repetitions : entry.repetitions);
    result.name = name;
    result.details["threads"] = threadCount();
    return result;
  }
  throw ValueError("there is no bench '" + name + "'", "bench", "choose one of " + names);
}

nlohmann::json toJson(const BenchResult& result) {
  return {{"name", result.name},
          {"ratio", result.ratio},
          {"ours", {{"value", result.ours.value}, {"unit", result.ours.unit}}},
          {"against",
           {{"what", result.againstWhat}, {"value", result.against.value}, {"unit", result.against.unit}}},
          {"details", result.details}};
}

BenchScene benchScene() {
  const SceneObject rock{"rock", std::make_shared<TriMesh>(makeRock({})), Mat4(1), Material{}};
  const auto scene = std::make_shared<Scene>(flattenScene({&rock, 1}));
  return {scene, std::make_shared<RayScene>(*scene), std::make_shared<SampleSet>(samplesAtVertices(*scene))};
}

double secondsOf(const std::function<void()>& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace prt
