#pragma once
// Mesh files out. A file appears whole or not at all.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace prt {

struct MeshWriteOptions {
  /// [V] linear colours, one per vertex; empty = none. glTF keeps them linear floats; OBJ, PLY and OFF hold
  /// them sRGB-encoded, clamped to 0..1, as other programs expect; STL has none.
  std::span<const Rgb> colors{};
  std::string name = "mesh";  ///< of the object, where the format has names
  Rgb baseColor{0.8f};        ///< linear; glTF's material when there are no colours
  /// glTF only: the colours are light that leaves the surface, not to be lit again (KHR_materials_unlit).
  bool unlit = false;
  /// glTF only: attribute _VERTEX, the number that each vertex has in the mesh, as a float (below 2^24
  /// exact). Vertices doubled at seams share one.
  bool vertexNumbers = false;
};

/// Writes .obj, .ply (binary), .off, .stl (binary), .gltf (buffer inside) or .glb, as the extension says.
/// Positions and normals are exact floats in all of them but for normals in OFF and STL, which go without.
/// PLY and glTF have one texture coordinate per vertex: vertices on seams are doubled there. glTF's v runs
/// downwards and is turned over. Throws ValueError for an unknown extension or colours of another length,
/// FileError when the file cannot be written.
void writeMesh(const std::filesystem::path& path, const TriMesh& mesh, const MeshWriteOptions& options,
               Job& job);

/// A mesh in which every vertex has one texture coordinate.
struct SeamSplit {
  std::vector<std::uint32_t> vertex;  ///< [W] vertex of the mesh that each comes from
  std::vector<std::uint32_t> uv;      ///< [W] its texture coordinate; empty when the mesh has none
  std::vector<UVec3> triangles;       ///< [F] indices below W
};
SeamSplit splitAtSeams(const TriMesh& mesh);

}  // namespace prt
