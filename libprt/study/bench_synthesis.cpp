// The patch over a whole surface: a meso mesh of 960 000 vertices, the orientation field, the exemplar from a
// 64 x 64 weave, synthesis, and an id map of 2048 x 2048, on the built-in bird. Beside it one pass that reads
// 8 floats of each of 8 neighbours of every vertex, in the order of the mesh, on as many threads: what the
// machine needs to look at such neighbourhoods once. (The paper: texton extraction 1 to 3 hours,
// synthesis 4.)

#include "libprt/atlas/atlas.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/generate.h"
#include "libprt/meso/patch_build.h"
#include "libprt/meso/rtt_bake.h"
#include "libprt/study/bench_list.h"
#include "libprt/synthesis/id_map.h"
#include "libprt/synthesis/orientation_field.h"
#include "libprt/synthesis/texture_synthesis.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace prt {
namespace {

constexpr std::size_t kVertices = 960'000;
constexpr int kMapSize = 2048;
constexpr double kPatchWidth = 0.08;  // of the bounding box's diagonal, as recipes have it
constexpr int kRead = 8;

/// What bake and atlas give before the clock starts.
struct Given {
  TriMesh mesh;
  Rtt rtt;
  Atlas atlas;
};

Given given(Job& job) {
  Given g;
  g.mesh = makeBuiltinMesh("bird", 1, 1);
  PatchOptions weave;
  weave.model = PatchModel::Weave;
  RttSettings settings;
  settings.rays = 128, settings.supersamples = 2;  // fewer rays than usual: only the size of the table counts
  g.rtt = bakeRtt(makePatchScene(std::make_shared<Patch>(buildPatch(weave, {}, job)), job), settings, job);
  const Surface surface(g.mesh, job);
  g.atlas = packAtlas(autoCut(surface, seamCosts(surface, {}, job), {}, job), {}, job);
  return g;
}

struct Parts {
  double mesh = 0, field = 0, exemplar = 0, synthesis = 0, image = 0, map = 0, pass = 0;
  SynthesisQuality quality;
  std::size_t vertices = 0;
  double total() const { return mesh + field + exemplar + synthesis + image + map; }
};

/// One pass over all neighbourhoods: the first kRead neighbours of each, again from the first where there are
/// fewer.
double readNeighbours(const PointRings& rings, Job& job) {
  std::vector<std::array<float, kAppearance>> values(rings.count());
  for (std::size_t i = 0; i < values.size(); ++i) values[i].fill(float(i % 7));
  std::vector<std::array<std::uint32_t, kRead>> neighbours(rings.count());
  for (std::uint32_t p = 0; p < rings.count(); ++p) {
    const auto ring = rings.of(p);
    for (std::size_t i = 0; i < kRead; ++i) neighbours[p][i] = ring.empty() ? p : ring[i % ring.size()];
  }
  std::atomic<std::uint64_t> check{0};
  const double seconds = secondsOf([&] {
    parallelFor(job, 0, rings.count(), 8192, [&](std::size_t begin, std::size_t end) {
      float sum = 0;
      for (std::size_t p = begin; p < end; ++p)
        for (const std::uint32_t q : neighbours[p])
          for (const float x : values[q]) sum += x;
      check += std::uint64_t(sum);
    });
  });
  return check > 0 ? seconds : 0;
}

Parts measure(const Given& g, Job& outer) {
  InnerJob inner(outer);
  Job& job = inner.job;
  Parts parts;
  const double width = kPatchWidth * double(g.mesh.bounds().diagonal());
  std::unique_ptr<Surface> surface;
  std::unique_ptr<SurfaceSheets> sheets;
  MesoMesh meso;
  parts.mesh = secondsOf([&] {
    surface = std::make_unique<Surface>(g.mesh, job);
    sheets = std::make_unique<SurfaceSheets>(*surface);
    meso = makeMesoMesh(g.mesh, *sheets, {.vertices = kVertices}, job);
  });
  parts.vertices = meso.vertexCount();
  std::vector<Vec3> tangents;
  parts.field = secondsOf([&] {
    const OrientationField field = makeOrientationField(g.mesh, *surface, {}, job);
    tangents = mesoTangents(meso, field.frames, job);
  });
  Exemplar exemplar;
  parts.exemplar = secondsOf([&] {
    exemplar = makeExemplar(g.rtt, {.spacings = exemplarSpacings(meso, width, g.rtt.texels)}, job);
  });
  std::vector<Vec2> coordinates;
  SynthesisOptions options;
  options.patchWidth = width;
  parts.synthesis =
      secondsOf([&] { coordinates = synthesise(meso, *sheets, tangents, exemplar, options, job); });
  GeometryImage image;
  TexelSurface texels;
  parts.image = secondsOf([&] {
    image = makeGeometryImage(g.atlas, kMapSize, -1, job);
    texels = texelSurface(g.mesh, g.atlas, image, job);
  });
  IdMap map;
  parts.map = secondsOf(
      [&] { map = makeIdMap(kMapSize, shootNormals(meso, *sheets, image, texels, {}, job), coordinates); });
  const Neighbourhoods finest =
      makeNeighbourhoods(meso, *sheets, tangents, 1, g.rtt.texels / width, meso.levels() - 1, job);
  parts.pass = readNeighbours(finest.rings, job);
  parts.quality = measureSynthesis(meso, finest, exemplar, coordinates, g.atlas.chartOf);
  return parts;
}

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

}  // namespace

BenchResult benchSynthesis(Job& job, int repetitions) {
  InnerJob preparing(job);
  const Given g = given(preparing.job);
  BenchResult result;
  std::vector<double> ours, pass, ratios;
  Parts parts;
  job.begin("bench synthesis", repetitions, "repetitions");
  for (int i = 0; i < repetitions; ++i) {
    parts = measure(g, job);
    ours.push_back(parts.total()), pass.push_back(parts.pass), ratios.push_back(parts.pass / parts.total());
    job.advance(1);
  }
  result.ratio = median(ratios);
  result.ours = {median(ours), "s"};
  result.againstWhat = "one pass that reads 8 floats of each of 8 neighbours in mesh order";
  result.against = {median(pass), "s"};
  result.details = {{"vertices", double(parts.vertices)},
                    {"seconds_meso_mesh", parts.mesh},
                    {"seconds_field", parts.field},
                    {"seconds_exemplar", parts.exemplar},
                    {"seconds_synthesis", parts.synthesis},
                    {"seconds_geometry_image", parts.image},
                    {"seconds_id_map", parts.map},
                    {"passes", parts.total() / std::max(parts.pass, 1e-9)},
                    {"limit_seconds", 60},
                    {"peak_megabytes", peakMegabytes()},
                    {"distance", parts.quality.distance},
                    {"distance_inside_charts", parts.quality.inside},
                    {"distance_across_borders", parts.quality.across},
                    {"coherence", parts.quality.coherence},
                    {"longest_repeat", parts.quality.longestRepeat}};
  return result;
}

}  // namespace prt
