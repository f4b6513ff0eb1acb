#pragma once
// The surface that charts are cut from: a mesh's triangles joined by position, each edge with its two
// sides, as plain arrays that every algorithm of this folder walks over.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace prt {

using DVec2 = glm::dvec2;
using UVec2 = glm::uvec2;

/// "No half-edge there", "no such vertex", "in no chart".
inline constexpr std::uint32_t kNowhere = 0xffffffffu;

/// Half-edge 3 f + i runs from corner i of triangle f to the next corner, its triangle on the left.
inline std::uint32_t nextHalf(std::uint32_t half) {
  return half % 3 == 2 ? half - 2 : half + 1;
}
inline std::uint32_t previousHalf(std::uint32_t half) {
  return half % 3 == 0 ? half + 2 : half - 1;
}

/// Vertices of the mesh at one position are one vertex here; where the surface is no oriented manifold it is
/// cut, and each fan of triangles has a vertex of its own. Triangles keep their numbers and corners, and
/// vertices their order: those of a whole mesh without creases keep their numbers too.
struct Surface {
  std::vector<Vec3> positions;              ///< [W]
  std::vector<UVec3> triangles;             ///< [F]
  std::vector<std::uint32_t> meshVertex;    ///< [W] a vertex of the mesh at that place
  std::vector<std::uint32_t> vertexOfMesh;  ///< [V] the first vertex here at a mesh vertex's place; kNowhere
                                            ///< where no triangle is
  std::vector<std::uint32_t> twin;          ///< [3F] the half-edge across; kNowhere at a border
  std::vector<std::uint32_t> edge;          ///< [3F] edge of each half-edge
  std::vector<std::uint32_t> halfOf;        ///< [E] a half-edge of each edge
  std::vector<std::uint32_t> spokeStart;    ///< [W + 1] into spokes
  std::vector<std::uint32_t> spokes;        ///< edges around each vertex, in rising order

  Surface() = default;
  /// The mesh is not kept. Near linear; throws Cancelled.
  Surface(const TriMesh& mesh, Job& job);
  /// From triangles that are an oriented manifold already.
  Surface(std::vector<Vec3> at, std::vector<UVec3> faces, Job& job);

  std::size_t vertexCount() const { return positions.size(); }
  std::size_t triangleCount() const { return triangles.size(); }
  std::size_t edgeCount() const { return halfOf.size(); }
  std::uint32_t from(std::uint32_t half) const { return triangles[half / 3][int(half % 3)]; }
  std::uint32_t to(std::uint32_t half) const { return from(nextHalf(half)); }
  bool isBorder(std::uint32_t e) const { return twin[halfOf[e]] == kNowhere; }
  UVec2 ends(std::uint32_t e) const { return {from(halfOf[e]), to(halfOf[e])}; }
  /// The other end of an edge.
  std::uint32_t across(std::uint32_t e, std::uint32_t vertex) const {
    const UVec2 v = ends(e);
    return v.x == vertex ? v.y : v.x;
  }
  /// The edge between two vertices; kNowhere when there is none.
  std::uint32_t edgeBetween(std::uint32_t a, std::uint32_t b) const;
  double length(std::uint32_t e) const {
    return glm::distance(DVec3(positions[ends(e).x]), DVec3(positions[ends(e).y]));
  }
  /// Twice the area times the normal, in double.
  DVec3 areaNormal(std::uint32_t triangle) const {
    const UVec3& t = triangles[triangle];
    const DVec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    return glm::cross(b - a, c - a);
  }
  double area(std::uint32_t triangle) const { return 0.5 * glm::length(areaNormal(triangle)); }
  double totalArea() const;
};

/// Angle between the normals of the two triangles at each edge, in radians: positive where the edge is a
/// valley (concave), negative where it is a ridge, 0 at borders and beside triangles without area.
std::vector<float> bendAngles(const Surface& surface, Job& job);

struct EdgeCostOptions {
  /// 0: the plain length. 1: an edge bent by 60 degrees or more costs half of its length (ALGORITHMS 8).
  double followCreases = 1;
  double concaveBonus = 0.2;  ///< of the length, taken off valleys bent as far: seams there are seen less
};

/// What a seam along each edge costs: its length, less where the surface bends, never below a fifth of it.
std::vector<float> seamCosts(const Surface& surface, const EdgeCostOptions& options, Job& job);

}  // namespace prt
