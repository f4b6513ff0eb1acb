#pragma once
// What every mesh reader's harness does with an input: parse it, repair it, and use the result.

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/half_edge.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/repair.h"
#include "libprt/mesh/tangent_frames.h"
#include "tests/fuzz/target.h"

#include <cstring>

namespace prt::fuzz {

/// A repaired mesh is finite, in range, with unit normals and triangles that have area.
inline void requireUsable(const TriMesh& mesh) {
  require(mesh.triangleCount() > 0 && mesh.normals.size() == mesh.vertexCount());
  for (const Vec3& p : mesh.positions) require(isFinite(p));
  for (const Vec3& n : mesh.normals) require(std::abs(length(n) - 1) < 1e-4f);
  for (const UVec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) require(t[i] < mesh.vertexCount());
  require(mesh.uv.empty() == mesh.uvTriangles.empty());
  for (const UVec3& t : mesh.uvTriangles)
    for (int i = 0; i < 3; ++i) require(t[i] < mesh.uv.size() && std::isfinite(mesh.uv[t[i]].x));
}

inline int fuzzMesh(PolygonSoup (*parser)(std::string_view, const MeshSource&, Job&),
                    const std::uint8_t* data, std::size_t size) {
  Job job;
  try {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const PolygonSoup soup = parser(bytes, {"fuzzed", {}}, job);
    require(soup.faceStart.back() == soup.cornerCount());
    for (const bool split : {false, true}) {
      const RepairedMesh repaired =
          repair(soup, {.splitNonManifold = split, .creaseAngle = split ? 0.5f : kPiF}, job);
      requireUsable(repaired.mesh);
      require(!toText(repaired.report).empty());
      if (repaired.mesh.triangleCount() > 2000) continue;
      const TangentFrames frames = makeTangentFrames(repaired.mesh, {.sweeps = 1}, job);
      for (const Vec3& t : frames.tangents) require(std::abs(length(t) - 1) < 1e-4f);
      const HalfEdgeMesh surface(repaired.mesh, job);
      require(surface.triangleCount() == repaired.mesh.triangleCount());
    }
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
  return 0;
}

/// Small meshes to write seeds from: one with normals, UVs and creases, one closed and smooth.
inline std::vector<TriMesh> seedMeshes() {
  return {makeBox(), makeSphere({.segments = 5, .rings = 3}), makeIcosphere({.subdivisions = 0})};
}

}  // namespace prt::fuzz
