#pragma once
// From a polygon soup to a TriMesh: what can be put right is put right and reported, the rest is refused.

#include "libprt/mesh/diagnose.h"

#include <filesystem>

namespace prt {

enum class Orientation {
  keep,        ///< as in the file
  consistent,  ///< neighbours agree; each component as most of its area was (or as its normals say)
  outward      ///< consistent, and closed components face outwards
};

struct RepairOptions {
  /// Merge vertices at exactly one position. Off: the file's vertices are kept apart as they are.
  bool weld = true;
  Orientation orientation = Orientation::outward;
  /// Cut the surface where more than two faces meet in an edge, or fans of faces in a vertex only.
  bool splitNonManifold = false;
  /// Keep one of the triangles over the same positions; none of two back to back that stand out of a
  /// surface like a fin.
  bool dropDuplicateFaces = true;
  bool removeUnreferenced = true;
  /// Use the file's normals where they are finite and on the front side of their face; compute the rest.
  bool keepNormals = true;
  /// Computed normals break (the vertex is doubled) where faces meet at more than this angle, in radians.
  /// The default never breaks: scans stay whole.
  float creaseAngle = kPiF;
  /// Take off the place of a mesh that lies so far out that floats would not hold its shape.
  bool recentre = true;
};

/// What repair() did. Counts are of the file's elements.
struct RepairReport {
  MeshReport before;  ///< the file
  MeshReport after;   ///< the result
  DVec3 offset{0};    ///< add it to the result's positions to get the file's

  std::size_t weldedVertices = 0;     ///< fewer of them, because positions and normals are the same
  std::size_t removedVertices = 0;    ///< of no triangle that was kept
  std::size_t droppedOutOfRange = 0;  ///< faces
  std::size_t droppedNonFinite = 0;   ///< faces
  std::size_t droppedDegenerate = 0;  ///< faces and cut-off triangles without area
  std::size_t droppedDuplicates = 0;  ///< triangles
  std::size_t cutPolygons = 0;        ///< faces of more than three corners made into triangles
  std::size_t flippedTriangles = 0;
  std::size_t splitVertices = 0;    ///< made to part non-manifold places
  std::size_t creaseVertices = 0;   ///< vertices beyond one per position, because normals differ there
  std::size_t keptNormals = 0;      ///< corners whose normal is the file's
  std::size_t computedNormals = 0;  ///< corners whose normal was computed
  std::size_t filledUvs = 0;        ///< corners without usable texture coordinates, set to (0, 0)
  std::string unit;                 ///< of the file's lengths, when it says so
  std::vector<std::string> notes;   ///< from the reader

  bool changedAnything() const;
};

/// "welded 403 vertices, dropped 80 degenerate faces, flipped 12 triangles"; "nothing to repair".
std::string toText(const RepairReport& report);
nlohmann::json toJson(const RepairReport& report);

struct RepairedMesh {
  TriMesh mesh;
  std::vector<std::uint32_t> triangleMaterial;  ///< [F] into materials or kNoIndex; empty when there are none
  std::vector<SoupMaterial> materials;
  RepairReport report;
};

/// Makes a mesh fit to bake: finite, indexed, triangles with area, unit normals that face the front.
/// Near linear in the size of the soup; the result does not depend on the number of threads.
/// Throws GeometryError when no usable face is left, or the extent of what is left is not within 1e-6..1e9
/// units.
RepairedMesh repair(const PolygonSoup& soup, const RepairOptions& options, Job& job);

/// Reads a file (see mesh_reader.h for formats) and repairs it. Throws FileError and GeometryError.
TriMesh loadMesh(const std::filesystem::path& path, const RepairOptions& options, Job& job,
                 RepairReport* report = nullptr);

}  // namespace prt
