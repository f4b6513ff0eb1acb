#pragma once
// The benches that runBench() knows. Internal to study: to add one, declare it here and list it in bench.cpp.

#include "libprt/core/job.h"
#include "libprt/study/bench.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace prt {

/// Direct 25 x 25 bake against the same rays traced and thrown away.
BenchResult benchBake(Job& job, int repetitions);
/// Three diffuse bounces against the direct bake before them.
BenchResult benchBounces(Job& job, int repetitions);
/// Dense transfer applied to RGB light against reading the matrices.
BenchResult benchTransfer(Job& job, int repetitions);
/// The default weave's radiance transfer texture against its own rays traced and thrown away.
BenchResult benchRtt(Job& job, int repetitions);
/// prt-studio's frames under a real hand's events against what must hold; `repetitions` frames of each part.
BenchResult benchStudio(Job& job, int repetitions);

/// The automatic atlas of built-in shapes, or of one mesh file, against laying its charts flat alone.
BenchResult benchAtlas(Job& job, int repetitions);
/// Meso mesh, synthesis and id map against one pass over all neighbourhoods.
BenchResult benchSynthesis(Job& job, int repetitions);
/// A built-in mesh with a woven patch, from nothing to the first lit frame, against two minutes.
BenchResult benchPipeline(Job& job, int repetitions);
/// Frames of both scales together, light and view changing, against the paper's; `repetitions` of them.
BenchResult benchBiscale(Job& job, int repetitions);
/// What path tracing takes for a picture as exact as the bi-scale one; `repetitions` paths per pixel.
BenchResult benchEqual(Job& job, int repetitions);
/// Adds to its details what cutting a chart of 10 000 triangles and dragging a corner of it take.
void benchChartEdit(BenchResult& result, Job& job);

struct Recipe;
struct Scene;
class Products;
class RayScene;
struct SampleSet;

/// The scene of the transfer benches: a built-in rock of 10 242 vertices with hollows, ready for baking.
struct BenchScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const SampleSet> samples;
};
BenchScene benchScene();

/// Medians over frames of 512 x 512, light and view changing in each, and how much of them is covered.
struct BiscaleFrame {
  double whole = 0, light = 0, raster = 0, transfer = 0;  ///< seconds
  double vertices = 0, framesSeen = 0, covered = 0;
};
BiscaleFrame biscaleFrame(const Recipe& recipe, const Products& products, int frames, Job& job);

/// A job for work inside a bench: reports to nobody, ends when the bench's own job is cancelled.
struct InnerJob {
  explicit InnerJob(Job& outer)
      : job([this, &outer](const Progress&) {
          if (outer.cancelled()) job.cancel();
        }) {
    outer.checkCancelled();
  }
  Job job;
};

/// Wall-clock seconds of one call.
double secondsOf(const std::function<void()>& work);

/// Median of some numbers, at least one.
double median(std::vector<double> values);

}  // namespace prt
