#pragma once
// Who is next to whom on a surface: one-rings, boundary loops, components. Half-edges are OpenMesh's.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace prt {

/// Adjacency of a mesh's surface. Mesh vertices at one position (creases) are one vertex here; where the
/// surface is not an oriented manifold it is cut, and each fan of triangles has a vertex of its own.
/// Triangles keep their numbers.
class HalfEdgeMesh {
 public:
  /// The mesh is not kept. Throws Cancelled.
  HalfEdgeMesh(const TriMesh& mesh, Job& job);
  ~HalfEdgeMesh();
  HalfEdgeMesh(HalfEdgeMesh&&) noexcept;
  HalfEdgeMesh& operator=(HalfEdgeMesh&&) noexcept;

  std::size_t vertexCount() const;
  std::size_t edgeCount() const;
  std::size_t triangleCount() const;
  /// The vertex here of corner 0..2 of a triangle.
  std::uint32_t vertexOf(std::uint32_t triangle, int corner) const;
  /// A vertex of the mesh at a vertex here.
  std::uint32_t meshVertex(std::uint32_t vertex) const { return meshVertex_[vertex]; }

  /// Neighbours of a vertex, counter-clockwise seen from outside; at a boundary from one end to the other.
  std::vector<std::uint32_t> oneRing(std::uint32_t vertex) const;
  /// Triangles around a vertex, in the same order.
  std::vector<std::uint32_t> fan(std::uint32_t vertex) const;
  /// The triangle across the side from corner `side` to the next; kNoNeighbour at a boundary.
  std::uint32_t neighbour(std::uint32_t triangle, int side) const;
  bool isBoundary(std::uint32_t vertex) const;

  /// Vertices of each hole or rim, in order, the surface on the right.
  std::vector<std::vector<std::uint32_t>> boundaryLoops() const;
  /// [F] number of the edge-connected component of each triangle, in the order of their first triangles.
  std::vector<std::uint32_t> components() const;

  static constexpr std::uint32_t kNoNeighbour = 0xffffffffu;

 private:
  struct Kernel;
  std::unique_ptr<Kernel> kernel_;
  std::vector<std::uint32_t> meshVertex_;
};

}  // namespace prt
