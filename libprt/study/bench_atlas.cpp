// The automatic atlas: charts cut, laid flat and packed at 2048 texels with a gutter of one, against the time
// of laying the same charts flat alone, from Tutte's maps.

#include "libprt/atlas/atlas.h"
#include "libprt/atlas/geometry_image.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "libprt/study/bench_list.h"

#include <cmath>
#include <memory>

namespace prt {
namespace {

/// A ring with waves on it of about so many triangles.
TriMesh wavyRing(double triangles) {
  const int sides = int(std::lround(std::sqrt(triangles / 4)));
  TriMesh mesh = makeTorus({.segments = 2 * sides, .sides = sides});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    mesh.positions[v] +=
        mesh.normals[v] * (0.06f * std::sin(9 * p.x) * std::sin(7 * p.y) * std::cos(8 * p.z));
  }
  return mesh;
}

/// What one shape's atlas came to.
struct Made {
  double seconds = 0, alone = 0;
  double charts = 0, l2 = 0, lInf = 0, seam = 0, filled = 0, overlaps = 0;
};

Made measure(const TriMesh& mesh, Job& job) {
  Made made;
  InnerJob inner(job);
  std::unique_ptr<Surface> surface;
  FlatCharts charts;
  Atlas atlas;
  made.seconds = secondsOf([&] {
    surface = std::make_unique<Surface>(mesh, inner.job);
    charts = autoCut(*surface, seamCosts(*surface, {}, inner.job), {}, inner.job);
    atlas = packAtlas(charts, {}, inner.job);
  });
  made.alone = secondsOf([&] { flattenCharts(*surface, charts.seams, {}, inner.job); });
  const StretchSum stretch = atlasStretch(mesh.positions, mesh.triangles, atlas);
  made.charts = double(atlas.chartCount);
  made.l2 = stretch.l2();
  made.lInf = stretch.lInf();
  made.seam = seamLength(*surface, charts.seams) / std::sqrt(surface->totalArea());
  made.filled = makeGeometryImage(atlas, atlas.size, 0, inner.job).filled();
  made.overlaps = double(overlappingTexels(atlas, atlas.size, inner.job).size());
  return made;
}

void addDetails(BenchResult& result, const std::string& prefix, const TriMesh& mesh, const Made& made) {
  result.details[prefix + "faces"] = double(mesh.triangleCount());
  result.details[prefix + "charts"] = made.charts;
  result.details[prefix + "stretch_l2"] = made.l2;
  result.details[prefix + "stretch_max"] = made.lInf;
  result.details[prefix + "seam"] = made.seam;
  result.details[prefix + "filled"] = made.filled;
  result.details[prefix + "overlaps"] = made.overlaps;
  result.details[prefix + "seconds"] = made.seconds;
}

BenchResult benchShapes(const std::vector<std::pair<std::string, TriMesh>>& shapes, Job& job,
                        int repetitions) {
  BenchResult result;
  std::vector<double> ours, alone, ratios;
  job.begin("bench atlas", double(repetitions) * double(shapes.size()), "atlases");
  for (int i = 0; i < repetitions; ++i) {
    double seconds = 0, rival = 0;
    for (const auto& [name, mesh] : shapes) {
      const Made made = measure(mesh, job);
      seconds += made.seconds;
      rival += made.alone;
      addDetails(result, shapes.size() > 1 ? name + "_" : std::string(), mesh, made);
      job.advance(1);
    }
    ours.push_back(seconds);
    alone.push_back(rival);
    ratios.push_back(rival / seconds);
  }
  result.ratio = median(ratios);
  result.ours = {median(ours), "s"};
  result.againstWhat = "laying the same charts flat alone";
  result.against = {median(alone), "s"};
  return result;
}

}  // namespace

BenchResult benchAtlas(Job& job, int repetitions) {
  std::vector<std::pair<std::string, TriMesh>> shapes;
  for (const char* name : {"bird", "vase", "rock", "torus"})
    shapes.emplace_back(name, makeBuiltinMesh(name, 1, 1));
  BenchResult result = benchShapes(shapes, job, repetitions);
  benchChartEdit(result, job);
  return result;
}

BenchResult runLargeAtlasBench(Job& job) {
  BenchResult result;
  result.name = "atlas";
  job.begin("bench atlas", 2, "atlases");
  double seconds[2] = {0, 0};
  for (const bool large : {false, true}) {
    const TriMesh mesh = wavyRing(large ? 1e6 : 1e5);
    const Made made = measure(mesh, job);
    seconds[large] = made.seconds;
    addDetails(result, large ? "million_" : "hundred_thousand_", mesh, made);
    job.advance(1);
  }
  result.ours = {seconds[1], "s"};
  result.againstWhat = "20 times what a tenth of the triangles takes";
  result.against = {20 * seconds[0], "s"};
  result.ratio = result.against.value / result.ours.value;
  return result;
}

BenchResult runAtlasBench(const std::string& meshFile, Job& job, int repetitions) {
  BenchResult result =
      benchShapes({{"mesh", loadMesh(meshFile, {}, job)}}, job, repetitions > 0 ? repetitions : 1);
  result.name = "atlas";
  return result;
}

}  // namespace prt
