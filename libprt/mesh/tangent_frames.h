#pragma once
// A tangent frame at every triangle corner, continuous where the surface allows.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <vector>

namespace prt {

struct TangentFrames {
  std::vector<Vec3>
      tangents;  ///< [3F] unit, at a right angle to the shading normal; corner i of triangle f is 3 f + i

  /// Right-handed, z = the shading normal at that corner.
  Frame at(const TriMesh& mesh, std::size_t triangle, int corner) const {
    const Vec3& n = mesh.normals[mesh.triangles[triangle][corner]];
    const Vec3& t = tangents[3 * triangle + std::size_t(corner)];
    return {t, cross(n, t), n};
  }
};

struct TangentOptions {
  bool fromUvs = true;  ///< follow the UVs where the mesh has them
  int sweeps = 8;       ///< of smoothing when there are no UVs, 0..1000
};

/// With UVs: the direction of growing u, averaged by angle over the corners of a vertex that share a texture
/// coordinate, hence continuous inside a chart and broken along seams. Charts that are mirrored keep the
/// tangent along u; the frame is right-handed all the same. A corner without usable UVs at all gets one of
/// the next kind.
///
/// Without: a direction field over the vertices. It starts as a continuous function of the normal, roughly
/// +Y x normal (eastwards on a globe) and +X on level ground, and is smoothed by Gauss-Seidel sweeps, each
/// vertex taking the mean of its neighbours' vectors carried over by the least turn between normals. It is
/// continuous but for singular triangles, whose indices add up to the Euler number, and for creases, across
/// which nothing is carried.
///
/// Deterministic. Throws Cancelled.
TangentFrames makeTangentFrames(const TriMesh& mesh, const TangentOptions& options, Job& job);

}  // namespace prt
