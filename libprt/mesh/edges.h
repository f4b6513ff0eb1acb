#pragma once
// The undirected edges of triangles or polygons, non-manifold ones included, and the fans of corners
// around their vertices.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/mesh/union_find.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace prt {

/// One number for an undirected edge.
inline std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t(a) << 32) | b : (std::uint64_t(b) << 32) | a;
}

/// An edge a < b. Its sides are the corners that start a walk along it inside their face, in rising
/// order; in a list of triangles, corner 3 f + i is corner i of triangle f.
struct MeshEdge {
  std::uint32_t a, b;
  std::span<const std::uint32_t> sides;

  std::size_t faceCount() const { return sides.size(); }
  std::uint32_t triangle(std::size_t side) const { return sides[side] / 3; }
};

/// All edges of a mesh, sorted by (a, b). Sides from a vertex to itself are left out. Linear but for the
/// sorting around each vertex; can be cancelled.
class MeshEdges {
 public:
  MeshEdges(std::span<const UVec3> triangles, Job& job);
  /// Polygons: corners of face f are faceStart[f] .. faceStart[f+1] - 1 of cornerVertex. Faces for which
  /// `skip` is true take no part (empty = none is skipped).
  MeshEdges(std::span<const std::uint32_t> faceStart, std::span<const std::uint32_t> cornerVertex,
            const std::vector<bool>& skip, Job& job);

  std::size_t size() const { return keys_.size(); }
  MeshEdge operator[](std::size_t edge) const {
    const std::size_t first = starts_[edge], last = starts_[edge + 1];
    return {
        std::uint32_t(keys_[edge] >> 32), std::uint32_t(keys_[edge]), {sides_.data() + first, last - first}};
  }
  /// Index of the edge between two vertices; size() when there is none. O(log E).
  std::size_t find(std::uint32_t a, std::uint32_t b) const;

 private:
  struct Side {
    std::uint32_t a, b, corner;  // a < b
  };
  void build(const std::vector<Side>& sides, Job& job);

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> sides_;
};

/// The corner after a corner in its triangle.
inline std::uint32_t nextInTriangle(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Joins corners at one vertex whose faces meet in an edge for which `joins` is true: afterwards each set
/// is a fan of faces around its vertex.
UnionFind cornerFans(const MeshEdges& edges, std::span<const std::uint32_t> cornerVertex,
                     const std::function<std::uint32_t(std::uint32_t)>& nextCorner,
                     const std::function<bool(const MeshEdge&)>& joins, Job& job);

}  // namespace prt
