#include "libprt/synthesis/mesh_part.h"

namespace prt {

MeshPart meshPart(const TriMesh& mesh, const TangentFrames& frames, const std::vector<bool>& kept) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  MeshPart part;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
    if (kept[t]) part.triangle.push_back(t);
  std::vector<std::uint32_t> place(mesh.vertexCount(), kUnused);
  for (const std::uint32_t t : part.triangle)
    for (int c = 0; c < 3; ++c) place[mesh.triangles[t][c]] = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    place[v] = std::uint32_t(part.mesh.positions.size());
    part.mesh.positions.push_back(mesh.positions[v]);
    part.mesh.normals.push_back(mesh.normals[v]);
  }
  for (const std::uint32_t t : part.triangle) {
    const UVec3& old = mesh.triangles[t];
    part.mesh.triangles.push_back({place[old.x], place[old.y], place[old.z]});
    for (std::size_t c = 0; c < 3; ++c)
      part.frames.tangents.push_back(frames.tangents[3 * std::size_t(t) + c]);
  }
  return part;
}

}  // namespace prt
