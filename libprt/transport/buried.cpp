#include "libprt/transport/buried.h"

#include "libprt/core/parallel.h"
#include "libprt/transport/bake_rays.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace prt {
namespace {

constexpr int kTestRays = 64, kFirstRays = 16;
constexpr double kNearlyClosed = 0.1;
constexpr int kFewOpen = kTestRays / 8;

/// Union-find over vertices.
struct Pieces {
  std::vector<std::uint32_t> parent;

  explicit Pieces(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0u); }
  std::uint32_t root(std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent[root(a)] = root(b); }
};

/// Joins vertices at one position, so that creases and texture seams do not cut a surface into pieces.
void joinEqualPositions(const TriMesh& mesh, const Scene& scene, Pieces& pieces) {
  std::vector<std::uint32_t> order(mesh.vertexCount());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::array<float, 4>{float(scene.vertexObject[v]), p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) pieces.join(order[i], order[i - 1]);
}

/// [F] whether the triangle belongs to a piece with an inside.
std::vector<std::uint8_t> trianglesWithInside(const Scene& scene) {
  const TriMesh& mesh = scene.mesh;
  Pieces pieces(mesh.vertexCount());
  for (const UVec3& t : mesh.triangles) pieces.join(t.x, t.y), pieces.join(t.y, t.z);
  joinEqualPositions(mesh, scene, pieces);
  std::vector<DVec3> vector(mesh.vertexCount(), DVec3(0));
  std::vector<double> area(mesh.vertexCount(), 0);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t piece = pieces.root(mesh.triangles[t].x);
    const DVec3 n(mesh.areaNormal(t));
    vector[piece] += n;
    area[piece] += length(n);
  }
  std::vector<std::uint8_t> inside(mesh.triangleCount());
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t piece = pieces.root(mesh.triangles[t].x);
    inside[t] = length(vector[piece]) < kNearlyClosed * area[piece] && !scene.materialOf(t).twoSided;
  }
  return inside;
}

/// Neighbours of every vertex along edges, as pairs sorted by the first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> edgesOfVertices(const TriMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(mesh.triangleCount() * 6);
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      edges.emplace_back(t[k], t[(k + 1) % 3]);
      edges.emplace_back(t[(k + 1) % 3], t[k]);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// [V] mean length of the edges at each vertex: what is smaller, the mesh cannot show.
std::vector<float> edgeLengths(const TriMesh& mesh) {
  std::vector<float> sum(mesh.vertexCount(), 0), count(mesh.vertexCount(), 0);
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      for (const std::uint32_t v : {t[k], t[(k + 1) % 3]}) {
        sum[v] += length(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]);
        count[v] += 1;
      }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0) sum[v] /= count[v];
  return sum;
}

/// The same of texels: those beside and above each other in a chart, in pairs of both orders.
std::vector<std::pair<std::uint32_t, std::uint32_t>> edgesOfTexels(const TexelGrid& grid) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if ((a | b) & TexelGrid::kFar) return;
    edges.emplace_back(a, b);
    edges.emplace_back(b, a);
  };
  for (const TexelGrid::Rectangle& chart : grid.charts)
    for (std::uint32_t y = 0; y < chart.height; ++y)
      for (std::uint32_t x = 0; x < chart.width; ++x) {
        const std::uint32_t* texel = grid.texels.data() + chart.first + std::size_t(y) * chart.width + x;
        if (x + 1 < chart.width) join(texel[0], texel[1]);
        if (y + 1 < chart.height) join(texel[0], texel[chart.width]);
      }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// [texels] length of a texel's side on the surface.
std::vector<float> texelLengths(const TriMesh& mesh, const SampleSet& samples) {
  std::vector<float> lengths(samples.texels->count);
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    const TexelTriangle& t = samples.texels->triangles[samples.triangle[s]];
    const float flat = std::abs(t.edge1.x * t.edge2.y - t.edge1.y * t.edge2.x);
    lengths[s] = flat > 0 ? std::sqrt(length(mesh.areaNormal(samples.triangle[s])) / flat) : 0;
  }
  return lengths;
}

/// What a closer look at a sample asks of its rays. Most samples need no more than a few.
class CloserLook {
 public:
  CloserLook(const Scene& scene, const SampleSet& samples)
      : scene_(scene),
        samples_(samples),
        inside_(trianglesWithInside(scene)),
        anyInside_(std::find(inside_.begin(), inside_.end(), 1) != inside_.end()),
        edges_(spacing()) {}

  /// Whether there is anything that could bury or cover a sample.
  bool needed() const { return anyInside_ || !edges_.empty(); }

  /// Whether few rays leave it open that the sample is buried or covered: of these there are many signs then.
  bool mayBeBuried(std::span<const Hit> hits) const {
    const auto open = std::count_if(hits.begin(), hits.end(), [](const Hit& hit) { return !hit.valid(); });
    return countBacks(hits) > 0 || (!edges_.empty() && open * 4 <= std::ptrdiff_t(hits.size()));
  }
  bool buried(std::size_t sample, std::span<const Hit> hits) const {
    return countBacks(hits) * 4 > kTestRays || covered(sample, hits);
  }

 private:
  std::vector<float> spacing() const {
    if (!samples_.coversSurface() || !severalObjects()) return {};
    return samples_.texels ? texelLengths(scene_.mesh, samples_) : edgeLengths(scene_.mesh);
  }
  bool severalObjects() const {
    const std::vector<std::uint32_t>& owners = scene_.triangleObject;
    return std::adjacent_find(owners.begin(), owners.end(), std::not_equal_to<>()) != owners.end();
  }
  std::ptrdiff_t countBacks(std::span<const Hit> hits) const {
    return std::count_if(hits.begin(), hits.end(),
                         [&](const Hit& hit) { return hit.valid() && hit.back && inside_[hit.triangle]; });
  }

  bool covered(std::size_t sample, std::span<const Hit> hits) const {
    if (sample >= edges_.size() || samples_.triangle[sample] == kNone) return false;
    const std::uint32_t own = scene_.triangleObject[samples_.triangle[sample]];
    int open = 0, close = 0;
    for (const Hit& hit : hits) {
      open += !hit.valid();
      close += hit.valid() && hit.t < edges_[sample] && scene_.triangleObject[hit.triangle] != own;
    }
    return open <= kFewOpen && close * 2 > kTestRays;
  }

  const Scene& scene_;
  const SampleSet& samples_;
  std::vector<std::uint8_t> inside_;
  bool anyInside_;
  std::vector<float> edges_;  // of each front; empty where nothing can be covered: there is one object
};

}  // namespace

std::vector<std::uint8_t> findBuried(const Scene& scene, const RayScene& rays, const SampleSet& samples,
                                     std::span<const std::uint8_t> candidates, std::uint64_t seed, Job& job) {
  std::vector<std::uint8_t> buried(samples.size(), 0);
  const CloserLook look(scene, samples);
  if (!look.needed()) return buried;
  const RayTable few(RaySpread::Uniform, 1, 0, kFirstRays, seed, job);
  const RayTable all(RaySpread::Uniform, 1, 0, kTestRays, seed, job);
  parallelFor(job, 0, samples.size(), kBakeTile, [&](std::size_t begin, std::size_t end) {
    WorldRays directions;
    std::vector<Hit> hits(kTestRays);
    const auto trace = [&](std::size_t s, const RayTable& table) {
      directions.turn(table, bakeScramble(samples, s, seed), bakeFrame(samples, s, RaySpread::Uniform, seed));
      const std::span<Hit> found(hits.data(), std::size_t(table.size()));
      rays.intersectFrom(samples.origin[s], directions.x, directions.y, directions.z, found);
      return found;
    };
    for (std::size_t s = begin; s < end; ++s)
      buried[s] = candidates[s] && look.mayBeBuried(trace(s, few)) && look.buried(s, trace(s, all));
  });
  return buried;
}

BuriedFill::BuriedFill(const Scene& scene, const SampleSet& samples, std::span<const std::uint8_t> buried) {
  if (std::find(buried.begin(), buried.end(), 1) == buried.end() || !samples.coversSurface()) return;
  auto edges = samples.texels ? edgesOfTexels(*samples.texels) : edgesOfVertices(scene.mesh);
  const std::size_t fronts = edges.size();
  for (std::size_t i = 0; i < fronts && !samples.back.empty(); ++i)  // backs are neighbours of backs
    if (samples.back[edges[i].first] != kNone && samples.back[edges[i].second] != kNone)
      edges.emplace_back(samples.back[edges[i].first], samples.back[edges[i].second]);
  std::sort(edges.begin() + std::ptrdiff_t(fronts), edges.end());

  std::vector<std::uint8_t> open(buried.begin(), buried.end());
  for (std::uint8_t& flag : open) flag = !flag;
  for (bool filled = true; filled;) {  // one layer
    const std::size_t firstOfLayer = target_.size();
    for (std::size_t i = 0; i < edges.size();) {
      const std::uint32_t sample = edges[i].first;
      const auto sources = std::uint32_t(source_.size());
      for (; i < edges.size() && edges[i].first == sample; ++i)
        if (!open[sample] && open[edges[i].second]) source_.push_back(edges[i].second);
      if (source_.size() == sources) continue;
      target_.push_back(sample);
      first_.push_back(sources);
    }
    for (std::size_t i = firstOfLayer; i < target_.size(); ++i) open[target_[i]] = 1;
    filled = target_.size() > firstOfLayer;
  }
  first_.push_back(std::uint32_t(source_.size()));
}

void BuriedFill::apply(std::span<float> values, std::size_t stride) const {
  for (std::size_t i = 0; i < size(); ++i) {
    float* to = values.data() + target(i) * stride;
    std::fill(to, to + stride, 0.0f);
    for (const std::uint32_t source : sources(i))
      for (std::size_t c = 0; c < stride; ++c) to[c] += values[source * stride + c];
    const float scale = 1.0f / float(sources(i).size());
    for (std::size_t c = 0; c < stride; ++c) to[c] *= scale;
  }
}

}  // namespace prt
