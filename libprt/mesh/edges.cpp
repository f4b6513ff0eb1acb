#include "libprt/mesh/edges.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>

namespace prt {

MeshEdges::MeshEdges(std::span<const UVec3> triangles, Job& job) {
  CancelCheck check(job);
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    check();
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[f][i], b = triangles[f][(i + 1) % 3];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), std::uint32_t(3 * f + i)});
    }
  }
  build(sides, job);
}

MeshEdges::MeshEdges(std::span<const std::uint32_t> faceStart, std::span<const std::uint32_t> cornerVertex,
                     const std::vector<bool>& skip, Job& job) {
  CancelCheck check(job);
  std::vector<Side> sides;
  sides.reserve(cornerVertex.size());
  for (std::size_t f = 0; f + 1 < faceStart.size(); ++f) {
    check();
    if (!skip.empty() && skip[f]) continue;
    for (std::uint32_t c = faceStart[f]; c < faceStart[f + 1]; ++c) {
      const std::uint32_t next = c + 1 < faceStart[f + 1] ? c + 1 : faceStart[f];
      const std::uint32_t a = cornerVertex[c], b = cornerVertex[next];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), c});
    }
  }
  build(sides, job);
}

void MeshEdges::build(const std::vector<Side>& sides, Job& job) {
  // Sort by the lower vertex by counting, then the few sides at each vertex.
  CancelCheck check(job);
  std::uint32_t vertices = 0;
  for (const Side& side : sides) vertices = std::max(vertices, side.a + 1);
  std::vector<std::uint32_t> first(std::size_t(vertices) + 1, 0);
  for (const Side& side : sides) ++first[side.a + 1];
  for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  struct End {
    std::uint32_t b, corner;
  };
  std::vector<End> ends(sides.size());
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  for (const Side& side : sides) {
    check();
    ends[fill[side.a]++] = {side.b, side.corner};
  }
  sides_.reserve(sides.size());
  for (std::uint32_t a = 0; a < vertices; ++a) {
    check();
    const auto begin = ends.begin() + first[a], end = ends.begin() + first[a + 1];
    std::sort(begin, end,
              [](const End& x, const End& y) { return x.b != y.b ? x.b < y.b : x.corner < y.corner; });
    for (auto side = begin; side != end; ++side) {
      if (side == begin || side->b != (side - 1)->b) {
        starts_.push_back(std::uint32_t(sides_.size()));
        keys_.push_back(edgeKey(a, side->b));
      }
      sides_.push_back(side->corner);
    }
  }
  starts_.push_back(std::uint32_t(sides_.size()));
}

std::size_t MeshEdges::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), edgeKey(a, b));
  return found != keys_.end() && *found == edgeKey(a, b) ? std::size_t(found - keys_.begin()) : size();
}

UnionFind cornerFans(const MeshEdges& edges, std::span<const std::uint32_t> cornerVertex,
                     const std::function<std::uint32_t(std::uint32_t)>& nextCorner,
                     const std::function<bool(const MeshEdge&)>& joins, Job& job) {
  CancelCheck check(job);
  UnionFind fans(cornerVertex.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    check();
    const MeshEdge edge = edges[e];
    if (edge.faceCount() < 2 || !joins(edge)) continue;
    std::uint32_t first[2] = {0, 0};
    for (std::size_t i = 0; i < edge.sides.size(); ++i) {
      std::uint32_t ends[2] = {edge.sides[i], nextCorner(edge.sides[i])};
      if (cornerVertex[ends[0]] != edge.a) std::swap(ends[0], ends[1]);
      for (int k = 0; k < 2; ++k) {
        if (i == 0) first[k] = ends[k];
        fans.join(first[k], ends[k]);
      }
    }
  }
  return fans;
}

}  // namespace prt
