#pragma once
// What is wrong with a mesh: counts, and where.

#include "libprt/core/job.h"
#include "libprt/mesh/defect_places.h"
#include "libprt/mesh/soup.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace prt {

/// One class of defects: how many, and the first few of the elements it names.
struct Defect {
  static constexpr std::size_t kListed = 64;

  std::size_t count = 0;
  std::vector<std::uint32_t> first;  ///< at most kListed, in rising order
  /// Where they are, in the coordinates of what was diagnosed: vertices as points, edges and degenerate faces
  /// as edges, a hole as the edges of its loop, other faces as triangles. Of a non-finite vertex or an index
  /// out of range, the finite corners of the faces that use it.
  DefectPlaces places;

  void add(std::uint32_t element) {
    if (++count <= kListed) first.push_back(element);
  }
};

/// Facts and defects of a mesh. Faces that name a vertex out of range, a non-finite vertex, or fewer than
/// three different positions take no part in edges, components and Euler number. Edges, components and all
/// that follows from them are those of positions: vertices at exactly one position count as one.
struct MeshReport {
  std::size_t vertices = 0;   ///< as in the file
  std::size_t faces = 0;      ///< of any size
  std::size_t triangles = 0;  ///< after cutting polygons up
  std::size_t positions = 0;  ///< different positions that faces use
  std::size_t edges = 0;
  std::size_t boundaryEdges = 0;   ///< with one face
  std::size_t components = 0;      ///< pieces that share no position
  std::size_t closedSurfaces = 0;  ///< sheets, joined by edges, without boundary
  long euler = 0;                  ///< positions - edges + faces
  DVec3 low{0}, high{0};           ///< bounds of the finite vertices that faces use

  Defect outOfRangeFaces;       ///< faces: an index beyond the vertices
  Defect nonFiniteVertices;     ///< vertices: NaN or infinite
  Defect degenerateFaces;       ///< faces: fewer than three positions, or no area
  Defect duplicateFaces;        ///< faces: the same positions as an earlier face, in any order
  Defect duplicateVertices;     ///< vertices: at the position of an earlier one
  Defect unreferencedVertices;  ///< vertices of no face
  Defect nonManifoldEdges;      ///< first vertex of each edge with more than two faces
  Defect nonManifoldVertices;   ///< vertices whose faces form more than one fan
  Defect holes;                 ///< a vertex on each boundary loop
  Defect flippedEdges;          ///< first vertex of each edge whose two faces are wound against each other
  Defect insideOut;  ///< first face of each closed surface that faces inwards and is no cavity's wall

  /// Closed, manifold and wound outwards, without any other defect but duplicate vertices.
  bool clean() const;
  bool closed() const { return edges > 0 && boundaryEdges == 0 && nonManifoldEdges.count == 0; }
};

/// Near linear in the size of the mesh. Throws Cancelled only.
MeshReport diagnose(const PolygonSoup& soup, Job& job);
/// With vertices joined as `representative` says ([V], each the number of the vertex that stands for it)
/// instead of by position.
MeshReport diagnose(const PolygonSoup& soup, std::span<const std::uint32_t> representative, Job& job);
/// Of a mesh, vertices are duplicates only when their normals are the same too; else they make a crease.
MeshReport diagnose(const TriMesh& mesh, Job& job);

/// "36,000 vertices, 69,451 triangles, 1 component, 5 holes (223 boundary edges); 1,113 unreferenced
/// vertices"
std::string toText(const MeshReport& report);
nlohmann::json toJson(const MeshReport& report);

}  // namespace prt
