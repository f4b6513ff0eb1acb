#include "libprt/synthesis/id_map.h"

#include "libprt/core/parallel.h"
#include "libprt/synthesis/point_grid.h"

#include <tbb/enumerable_thread_specific.h>
#include <flann/flann.hpp>

#include <algorithm>
#include <array>

namespace prt {
namespace {

constexpr float kLeastNormal = 0.3f;
constexpr float kAlong = 2;  // edges
constexpr float kReach =
    2.25f;  // edges: nothing further away can win over one found nearer to the line than 1
constexpr int kMostNeighbours = 64;
constexpr std::size_t kTile = 4096;

bool closer(const ShotCandidate& a, const ShotCandidate& b) {
  return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.vertex < b.vertex;
}

/// The nearest of some that triangles lead to, or the nearest of all.
std::uint32_t nearestOfSheet(const MesoMesh& meso, SheetTest& test, const Vec3& p, std::uint32_t triangle,
                             std::span<const ShotCandidate> candidates) {
  for (const ShotCandidate& c : candidates)
    if (test.sameSheet(p, triangle, meso.positions[c.vertex], meso.triangle[c.vertex])) return c.vertex;
  return candidates.empty() ? kNoVertex : candidates[0].vertex;
}

/// Vertices near to a place, sorted.
class NearVertices {
 public:
  explicit NearVertices(const MesoMesh& meso)
      : meso_(meso), reach_(kReach * float(meso.edge)), grid_(meso.positions, reach_) {}
  /// All within kReach edges.
  void gather(const Vec3& p, std::vector<ShotCandidate>& out) const { gather(p, reach_, out); }
  /// The nearest `count`, or all there are.
  void gatherMany(const Vec3& p, std::size_t count, std::vector<ShotCandidate>& out) const {
    count = std::min(count, meso_.vertexCount());
    for (const float rings : {2.0f, 3.0f}) {
      gather(p, rings * reach_, out);
      if (out.size() < count) continue;
      out.resize(count);
      return;
    }
    // Hardly ever: looks at everything.
    out.clear();
    for (std::uint32_t v = 0; v < meso_.vertexCount(); ++v) {
      const Vec3 d = meso_.positions[v] - p;
      out.push_back({v, dot(d, d)});
    }
    std::partial_sort(out.begin(), out.begin() + std::ptrdiff_t(count), out.end(), closer);
    out.resize(count);
  }

 private:
  void gather(const Vec3& p, float radius, std::vector<ShotCandidate>& out) const {
    out.clear();
    grid_.near(p, radius, [&](std::uint32_t v, float d2) { out.push_back({v, d2}); });
    std::sort(out.begin(), out.end(), closer);
  }
  const MesoMesh& meso_;
  float reach_;
  PointGrid grid_;
};

/// Calls shoot(texel, scratch) for texels with a point, in parallel.
template <class Shoot>
std::vector<std::uint32_t> forTexels(const SurfaceSheets& sheets, const GeometryImage& image, Job& job,
                                     const Shoot& shoot) {
  std::vector<std::uint32_t> vertexOf(image.kind.size(), kNoVertex);
  tbb::enumerable_thread_specific<SheetTest> tests([&] { return SheetTest(sheets); });
  job.begin("id map", double(image.kind.size()), "texels");
  parallelFor(job, 0, image.kind.size(), kTile, [&](std::size_t begin, std::size_t end) {
    SheetTest& test = tests.local();
    std::vector<ShotCandidate> scratch;
    for (std::size_t i = begin; i < end; ++i)
      if (image.kind[i] != TexelKind::Empty) vertexOf[i] = shoot(i, test, scratch);
    job.advance(double(end - begin));
  });
  return vertexOf;
}

}  // namespace

std::uint32_t chooseAlongNormal(const MesoMesh& meso, SheetTest& test, const Vec3& position,
                                const Vec3& normal, std::uint32_t triangle,
                                std::span<const ShotCandidate> candidates) {
  struct Shot {
    float toLine2;
    std::uint32_t vertex;
    bool operator<(const Shot& o) const {
      return toLine2 != o.toLine2 ? toLine2 < o.toLine2 : vertex < o.vertex;
    }
  };
  std::array<Shot, kMostNeighbours> shots;
  std::size_t count = 0;
  const float most = kAlong * float(meso.edge);
  for (const ShotCandidate& c : candidates.first(std::min<std::size_t>(candidates.size(), kMostNeighbours))) {
    const Vec3 d = meso.positions[c.vertex] - position;
    const float along = dot(d, normal);
    if (std::abs(along) > most || dot(normal, meso.normals[c.vertex]) < kLeastNormal) continue;
    const Vec3 off = d - along * normal;
    shots[count++] = {dot(off, off), c.vertex};
  }
  // Whether triangles lead there is asked of the best ones only: it is the dearest question.
  while (count > 0) {
    const auto best = std::min_element(shots.begin(), shots.begin() + std::ptrdiff_t(count));
    if (test.sameSheet(position, triangle, meso.positions[best->vertex], meso.triangle[best->vertex]))
      return best->vertex;
    *best = shots[--count];
  }
  return kNoVertex;
}

std::vector<std::uint32_t> shootNormals(const MesoMesh& meso, const SurfaceSheets& sheets,
                                        const GeometryImage& image, const TexelSurface& texels,
                                        const IdMapOptions& options, Job& job) {
  const NearVertices near(meso);
  const auto k = std::size_t(std::clamp(options.neighbours, 1, kMostNeighbours));
  return forTexels(
      sheets, image, job, [&](std::size_t i, SheetTest& test, std::vector<ShotCandidate>& found) {
        const Vec3 &p = texels.position[i], &n = texels.normal[i];
        near.gather(p, found);
        const std::span<const ShotCandidate> all(found);
        const std::uint32_t best =
            chooseAlongNormal(meso, test, p, n, image.triangle[i], all.first(std::min(k, all.size())));
        if (best != kNoVertex) {
          // Of the k nearest, some may lie outside the grid's reach: they cannot win over one this near.
          const Vec3 d = meso.positions[best] - p, off = d - dot(d, n) * n;
          if (all.size() >= k || dot(off, off) <= float(meso.edge * meso.edge)) return best;
        }
        near.gatherMany(p, kMostNeighbours, found);
        for (const std::size_t tried : {k, std::size_t(kMostNeighbours)}) {
          const std::uint32_t vertex = chooseAlongNormal(
              meso, test, p, n, image.triangle[i], std::span(found).first(std::min(tried, found.size())));
          if (vertex != kNoVertex) return vertex;
        }
        return nearestOfSheet(meso, test, p, image.triangle[i], found);
      });
}

std::vector<std::uint32_t> shootNormalsByTree(const MesoMesh& meso, const SurfaceSheets& sheets,
                                              const GeometryImage& image, const TexelSurface& texels,
                                              const IdMapOptions& options, Job& job) {
  using Tree = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;
  // FLANN asks for writable memory and leaves it as it is.
  auto* first = const_cast<float*>(&meso.positions[0].x);
  Tree tree(flann::Matrix<float>(first, meso.vertexCount(), 3), flann::KDTreeSingleIndexParams(12));
  tree.buildIndex();
  const auto k = std::size_t(std::clamp(options.neighbours, 1, kMostNeighbours));
  return forTexels(
      sheets, image, job, [&](std::size_t i, SheetTest& test, std::vector<ShotCandidate>& found) {
        const Vec3 &p = texels.position[i], &n = texels.normal[i];
        for (const std::size_t tried : {k, std::size_t(kMostNeighbours)}) {
          const std::size_t count = std::min(tried, meso.vertexCount());
          std::array<std::size_t, kMostNeighbours> index;
          std::array<float, kMostNeighbours> distance2;
          flann::Matrix<float> query(const_cast<float*>(&p.x), 1, 3), distances(distance2.data(), 1, count);
          flann::Matrix<std::size_t> indices(index.data(), 1, count);
          tree.knnSearch(query, indices, distances, count,
                         flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, 0, true));
          found.clear();
          for (std::size_t j = 0; j < count; ++j) found.push_back({std::uint32_t(index[j]), distance2[j]});
          std::sort(found.begin(), found.end(), closer);
          const std::uint32_t best = chooseAlongNormal(meso, test, p, n, image.triangle[i], found);
          if (best != kNoVertex) return best;
        }
        return nearestOfSheet(meso, test, p, image.triangle[i], found);
      });
}

IdMap makeIdMap(int size, std::span<const std::uint32_t> vertexOf, std::span<const Vec2> coordinates) {
  IdMap map;
  map.size = size;
  map.ids.assign(2 * vertexOf.size(), IdMap::kEmpty);
  for (std::size_t i = 0; i < vertexOf.size(); ++i)
    if (vertexOf[i] != kNoVertex)
      for (int k = 0; k < 2; ++k)
        map.ids[2 * i + std::size_t(k)] =
            std::uint16_t(std::clamp(coordinates[vertexOf[i]][k] * 65535.0f, 0.0f, 65534.0f));
  return map;
}

}  // namespace prt
