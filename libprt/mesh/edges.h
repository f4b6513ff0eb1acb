#pragma once
// The undirected edges of a triangle list, non-manifold ones included.

#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// One number for an undirected edge.
inline std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t(a) << 32) | b : (std::uint64_t(b) << 32) | a;
}

/// True when the triangle runs from a to b (not from b to a) along that edge.
inline bool followsEdge(const UVec3& t, std::uint32_t a, std::uint32_t b) {
  return (t.x == a && t.y == b) || (t.y == a && t.z == b) || (t.z == a && t.x == b);
}

/// An edge a < b with the triangles at it, in rising order.
struct MeshEdge {
  std::uint32_t a, b;
  std::span<const std::uint32_t> faces;

  std::size_t faceCount() const { return faces.size(); }
};

/// All edges of a mesh, sorted by (a, b). Edges of a triangle from a vertex to itself are left out.
/// O(F) up to the sort's logarithm.
class MeshEdges {
 public:
  explicit MeshEdges(std::span<const UVec3> triangles);

  std::size_t size() const { return starts_.size() - 1; }
  MeshEdge operator[](std::size_t edge) const {
    const std::size_t first = starts_[edge], last = starts_[edge + 1];
    return {std::uint32_t(keys_[edge] >> 32), std::uint32_t(keys_[edge]), {faces_.data() + first, last - first}};
  }
  /// Index of the edge between two vertices; size() when there is none. O(log E).
  std::size_t find(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> faces_;
};

}  // namespace prt
