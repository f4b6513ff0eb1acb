#include "libprt/mesh/edges.h"

#include <algorithm>

namespace prt {

MeshEdges::MeshEdges(std::span<const UVec3> triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[f][i], b = triangles[f][(i + 1) % 3];
      if (a != b) sides.push_back({edgeKey(a, b), std::uint32_t(3 * f + i)});
    }
  build(sides);
}

MeshEdges::MeshEdges(std::span<const std::uint32_t> faceStart, std::span<const std::uint32_t> cornerVertex,
                     const std::vector<bool>& skip) {
  std::vector<Side> sides;
  sides.reserve(cornerVertex.size());
  for (std::size_t f = 0; f + 1 < faceStart.size(); ++f) {
    if (!skip.empty() && skip[f]) continue;
    for (std::uint32_t c = faceStart[f]; c < faceStart[f + 1]; ++c) {
      const std::uint32_t next = c + 1 < faceStart[f + 1] ? c + 1 : faceStart[f];
      const std::uint32_t a = cornerVertex[c], b = cornerVertex[next];
      if (a != b) sides.push_back({edgeKey(a, b), c});
    }
  }
  build(sides);
}

void MeshEdges::build(std::vector<Side>& sides) {
  std::sort(sides.begin(), sides.end(),
            [](const Side& x, const Side& y) { return x.key != y.key ? x.key < y.key : x.corner < y.corner; });
  sides_.reserve(sides.size());
  for (const Side& side : sides) {
    if (keys_.empty() || keys_.back() != side.key) {
      starts_.push_back(std::uint32_t(sides_.size()));
      keys_.push_back(side.key);
    }
    sides_.push_back(side.corner);
  }
  starts_.push_back(std::uint32_t(sides_.size()));
}

std::size_t MeshEdges::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), edgeKey(a, b));
  return found != keys_.end() && *found == edgeKey(a, b) ? std::size_t(found - keys_.begin()) : size();
}

UnionFind cornerFans(const MeshEdges& edges, std::span<const std::uint32_t> cornerVertex,
                     const std::function<std::uint32_t(std::uint32_t)>& nextCorner,
                     const std::function<bool(const MeshEdge&)>& joins) {
  UnionFind fans(cornerVertex.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
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
