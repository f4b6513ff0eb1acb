#include "libprt/mesh/fans.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/edges.h"

#include <numeric>

namespace prt {

FanSplit splitIntoFans(std::span<const UVec3> triangles, std::size_t vertexCount, Job& job) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> cornerVertex;
  cornerVertex.reserve(3 * triangles.size());
  for (const UVec3& t : triangles) cornerVertex.insert(cornerVertex.end(), {t.x, t.y, t.z});
  const auto joins = [&](const MeshEdge& edge) {
    return edge.faceCount() == 2 && cornerVertex[edge.sides[0]] != cornerVertex[edge.sides[1]];
  };
  UnionFind fans = cornerFans(MeshEdges(triangles, job), cornerVertex, nextInTriangle, joins, job);

  FanSplit split;
  split.triangles.assign(triangles.begin(), triangles.end());
  split.source.resize(vertexCount);
  std::iota(split.source.begin(), split.source.end(), 0u);
  std::vector<bool> taken(vertexCount, false);  // by the first fan
  std::vector<std::uint32_t> vertexOfFan(cornerVertex.size(), kNone);
  CancelCheck check(job);
  for (std::uint32_t c = 0; c < cornerVertex.size(); ++c) {
    check();
    std::uint32_t& vertex = vertexOfFan[fans.find(c)];
    if (vertex == kNone) {
      const std::uint32_t old = cornerVertex[c];
      vertex = taken[old] ? std::uint32_t(split.source.size()) : old;
      if (taken[old]) split.source.push_back(old);
      taken[old] = true;
    }
    split.triangles[c / 3][int(c % 3)] = vertex;
  }
  return split;
}

}  // namespace prt
