#include "libprt/mesh/duplicates.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/edges.h"

#include <algorithm>

namespace prt {
namespace {

struct Group {
  std::uint32_t first;
  std::uint32_t count = 0;
  int turns = 0;  ///< triangles wound like the first, less those wound the other way
};

/// True when both run through their vertices in the same cyclic order.
bool sameWinding(const UVec3& a, const UVec3& b) {
  const int start = b.x == a.x ? 0 : b.y == a.x ? 1 : 2;
  return b[(start + 1) % 3] == a.y;
}

}  // namespace

std::vector<bool> duplicateTriangles(std::span<const UVec3> triangles, Job& job) {
  CancelCheck check(job);
  // Group triangles over the same vertices.
  DenseIndex<3> index(triangles.size());
  std::vector<Group> groups;
  std::vector<std::uint32_t> groupOf(triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    check();
    std::array<std::uint32_t, 3> key{triangles[f].x, triangles[f].y, triangles[f].z};
    std::sort(key.begin(), key.end());
    groupOf[f] = index.insert(key);
    if (groupOf[f] == groups.size()) groups.push_back({.first = f});
    Group& group = groups[groupOf[f]];
    ++group.count;
    group.turns += sameWinding(triangles[group.first], triangles[f]) ? 1 : -1;
  }
  std::vector<bool> drop(triangles.size(), false);
  for (std::uint32_t f = 0; f < triangles.size(); ++f) drop[f] = groups[groupOf[f]].first != f;
  if (groups.size() == triangles.size()) return drop;

  // A fin: wound both ways alike, two single triangles at one of its edges at least, one at none.
  const MeshEdges edges(triangles, job);
  std::vector<std::uint32_t> singles(3 * triangles.size(), 0);  // of each side's edge
  for (std::size_t e = 0; e < edges.size(); ++e) {
    check();
    std::uint32_t count = 0;
    for (std::uint32_t side : edges[e].sides) count += groups[groupOf[side / 3]].count == 1;
    for (std::uint32_t side : edges[e].sides) singles[side] = count;
  }
  for (const Group& group : groups) {
    if (group.count == 1 || group.turns != 0) continue;
    const std::uint32_t* s = singles.data() + 3 * group.first;
    const bool onSurface = std::max({s[0], s[1], s[2]}) >= 2, needed = s[0] == 1 || s[1] == 1 || s[2] == 1;
    if (onSurface && !needed) drop[group.first] = true;
  }
  return drop;
}

}  // namespace prt
