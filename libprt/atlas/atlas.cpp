#include "libprt/atlas/atlas.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/atlas/orientation.h"
#include "libprt/core/error.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/union_find.h"

#include <algorithm>
#include <map>

namespace prt {
namespace {

constexpr double kGrid = 4194304.0;  // 2^22

Vec2 rounded(const DVec2& uv) {
  return Vec2(glm::round(uv * kGrid) / kGrid);
}

/// Puts vertices whose triangles rounding turned over onto neighbouring grid points where none is.
class Nudger {
 public:
  Nudger(Atlas& atlas, std::uint32_t firstUv, const Chart& chart)
      : atlas_(atlas), first_(firstUv), chart_(chart) {
    for (std::uint32_t t = 0; t < chart.triangles.size(); ++t)
      if (!positive(t)) bad_.push_back(t);
    if (bad_.empty()) return;
    around_.resize(chart.vertices.size());
    for (std::uint32_t t = 0; t < chart.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) around_[chart.triangles[t][i]].push_back(t);
  }

  /// Triangles that are left turned over.
  std::size_t run() {
    constexpr int kRounds = 16;
    for (int round = 0; round < kRounds && !bad_.empty(); ++round) {
      for (std::uint32_t t : bad_)
        for (int i = 0; i < 3 && !positive(t); ++i) improve(chart_.triangles[t][i], 1 + round);
      std::erase_if(bad_, [&](std::uint32_t t) { return positive(t); });
      for (std::uint32_t t = 0; t < chart_.triangles.size() && bad_.empty(); ++t)
        if (!positive(t)) bad_.push_back(t);
    }
    return bad_.size();
  }

 private:
  Vec2& uv(std::uint32_t v) { return atlas_.uv[first_ + v]; }
  bool positive(std::uint32_t t) {
    const UVec3& c = chart_.triangles[t];
    return orientation(uv(c.x), uv(c.y), uv(c.z)) > 0;
  }
  int wrongAround(std::uint32_t v) {
    int wrong = 0;
    for (std::uint32_t t : around_[v]) wrong += !positive(t);
    return wrong;
  }
  /// Of the grid points near a vertex the first one with the fewest triangles turned over.
  void improve(std::uint32_t v, int reach) {
    const Vec2 here = uv(v);
    Vec2 best = here;
    int fewest = wrongAround(v);
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        uv(v) = here + Vec2(float(x / kGrid), float(y / kGrid));
        const int wrong = wrongAround(v);
        if (wrong < fewest) fewest = wrong, best = uv(v);
      }
    uv(v) = best;
  }

  Atlas& atlas_;
  std::uint32_t first_;
  const Chart& chart_;
  std::vector<std::uint32_t> bad_;
  std::vector<std::vector<std::uint32_t>> around_;
};

}  // namespace

Atlas placeAtlas(const FlatCharts& charts, std::vector<ChartPlacement> placements, const PackOptions& options,
                 Job& job) {
  const std::size_t count = charts.charts.charts.size();
  if (placements.size() != count)
    throw ValueError("one placement per chart is wanted", "atlas", "pack the charts anew");
  Atlas atlas;
  atlas.size = options.size;
  atlas.gutter = options.gutter;
  atlas.chartOf = charts.charts.chartOf;
  atlas.chartCount = std::uint32_t(count);
  atlas.uvTriangles.resize(atlas.chartOf.size());
  for (std::size_t c = 0; c < count; ++c) {
    job.checkCancelled();
    const Chart& chart = charts.charts.charts[c];
    const auto first = std::uint32_t(atlas.uv.size());
    for (const DVec2& p : charts.uv[c]) atlas.uv.push_back(rounded(placements[c](p)));
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      atlas.uvTriangles[chart.faces[t]] = chart.triangles[t] + UVec3(first);
    if (const std::size_t left = Nudger(atlas, first, chart).run())
      throw GeometryError(std::to_string(left) + " triangles are too thin for texture coordinates",
                          chartName(c), "repair the mesh there, or enlarge the chart");
  }
  atlas.placements = std::move(placements);
  return atlas;
}

Atlas packAtlas(const FlatCharts& charts, const AtlasOptions& options, Job& job) {
  constexpr double kTrianglesOfEffort = 25000;
  std::vector<PackChart> outlines;
  std::size_t triangles = 0;
  for (std::size_t c = 0; c < charts.charts.charts.size(); ++c) {
    const Chart& chart = charts.charts.charts[c];
    triangles += chart.faces.size();
    if (chart.fault() != ChartFault::None || charts.uv[c].size() != chart.vertices.size())
      throw GeometryError("cannot be laid flat: " + faultText(chart), chartName(c),
                          "cut it there, or repair the mesh");
    PackChart& outline = outlines.emplace_back();
    outline.outline = outlineOf(chart, charts.uv[c]);
    outline.area = charts.charts.charts[c].area;
    outline.flatArea = charts.stretch[c].flatArea;
    if (c < options.weights.size()) outline.weight = options.weights[c];
  }
  // Cutting and laying flat grow with the mesh: so may packing, and stays a small part of the whole.
  PackOptions pack = options.pack;
  pack.effort *= std::clamp(double(triangles) / kTrianglesOfEffort, 1.0, 4.0);
  return placeAtlas(charts, packCharts(outlines, options.locked, pack, job), pack, job);
}

std::string toString(UvProblem::Kind kind) {
  switch (kind) {
    case UvProblem::Kind::Missing:
      return "has no area in the texture";
    case UvProblem::Kind::Outside:
      return "lies outside of the texture";
    case UvProblem::Kind::Flipped:
      return "is turned over";
    case UvProblem::Kind::Overlap:
      return "lies over another";
  }
  return {};
}

ImportedAtlas importAtlas(const TriMesh& mesh, const PackOptions& options, Job& job) {
  if (mesh.uv.empty())
    throw ValueError("the mesh has no texture coordinates", "charts.mode",
                     "use auto, or give a mesh with UVs");
  constexpr std::size_t kMost = 1000;
  ImportedAtlas imported;
  Atlas& atlas = imported.atlas;
  atlas.size = options.size;
  atlas.gutter = options.gutter;
  atlas.uv = mesh.uv;
  atlas.uvTriangles = mesh.uvTriangles;
  std::vector<int> turns(mesh.triangleCount());
  std::size_t clockwise = 0, counter = 0;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    const UVec3& c = atlas.uvTriangles[t];
    turns[t] = orientation(atlas.uv[c.x], atlas.uv[c.y], atlas.uv[c.z]);
    (turns[t] < 0 ? clockwise : counter) += turns[t] != 0;
  }
  if (counter == 0 && clockwise > 0) {
    for (Vec2& p : atlas.uv) p.x = 1 - p.x;
    for (int& t : turns) t = -t;
  }
  const auto report = [&](UvProblem::Kind kind, std::uint32_t t, std::uint32_t other, const Vec2& at) {
    if (imported.problems.size() < kMost) imported.problems.push_back({kind, t, other, at});
  };
  CancelCheck check(job);
  for (std::uint32_t t = 0; t < turns.size(); ++t) {
    check();
    const UVec3& c = atlas.uvTriangles[t];
    const Vec2 middle = (atlas.uv[c.x] + atlas.uv[c.y] + atlas.uv[c.z]) / 3.0f;
    if (turns[t] <= 0)
      report(turns[t] < 0 ? UvProblem::Kind::Flipped : UvProblem::Kind::Missing, t, kNowhere, middle);
    for (int i = 0; i < 3; ++i) {
      const Vec2& p = atlas.uv[c[i]];
      if (p.x < 0 || p.y < 0 || p.x > 1 || p.y > 1) {
        report(UvProblem::Kind::Outside, t, kNowhere, p);
        break;
      }
    }
  }
  // Charts: triangles that share two coordinates along an edge.
  UnionFind sets(turns.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  for (std::uint32_t t = 0; t < turns.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      check();
      const std::uint32_t a = atlas.uvTriangles[t][i], b = atlas.uvTriangles[t][(i + 1) % 3];
      const auto [place, isNew] = edges.try_emplace(std::minmax(a, b), t);
      if (!isNew) sets.join(place->second, t);
    }
  std::vector<std::uint32_t> number(turns.size(), kNowhere);
  for (std::uint32_t t = 0; t < turns.size(); ++t) {
    std::uint32_t& n = number[sets.find(t)];
    if (n == kNowhere) n = atlas.chartCount++;
    atlas.chartOf.push_back(n);
  }
  for (const TexelOverlap& overlap : overlappingTexels(atlas, options.size, job, false))
    report(UvProblem::Kind::Overlap, overlap.triangle, overlap.other, overlap.at);
  std::stable_sort(imported.problems.begin(), imported.problems.end(),
                   [](const UvProblem& a, const UvProblem& b) { return a.triangle < b.triangle; });
  return imported;
}

StretchSum atlasStretch(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                        const Atlas& atlas) {
  StretchSum sum;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const UVec3 &p = triangles[t], &u = atlas.uvTriangles[t];
    addStretch(sum, {DVec3(positions[p.x]), DVec3(positions[p.y]), DVec3(positions[p.z])},
               {DVec2(atlas.uv[u.x]), DVec2(atlas.uv[u.y]), DVec2(atlas.uv[u.z])});
  }
  return sum;
}

}  // namespace prt
