#pragma once
// Vertices of a meso mesh as seen by synthesis: each neighbour's place in the vertex' own frame, in texels of
// the patch, and how the two frames are turned against each other.

#include "libprt/mesh/tangent_frames.h"
#include "libprt/synthesis/meso_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

struct Neighbourhoods {
  PointRings rings;
  /// [rings.list] from the vertex to the neighbour, x along the tangent; as long as the way between them in
  /// space, in the mean direction that the two frames give it (so q sees p where p sees q, turned round).
  std::vector<Vec2> offset;
  /// [rings.list] how often 2 pi / symmetry the neighbour's frame is turned counter-clockwise against this
  /// one; empty for symmetry 1.
  std::vector<std::uint8_t> turn;

  std::size_t count() const { return rings.count(); }
  int turnOf(std::size_t slot) const { return turn.empty() ? 0 : turn[slot]; }
};

/// Tangents of the vertices, [M] unit, at right angles to the normals.
std::vector<Vec3> mesoTangents(const MesoMesh& meso, const TangentFrames& frames, Job& job);

/// Of one level. `unit`: texels per length. Same result for any number of threads.
Neighbourhoods makeNeighbourhoods(const MesoMesh& meso, const SurfaceSheets& sheets,
                                  std::span<const Vec3> tangents, int symmetry, double unit, int level,
                                  Job& job);

/// Sets of vertices none of which are neighbours: what one set decides does not depend on the order inside
/// it. Each set in rising order.
std::vector<std::vector<std::uint32_t>> independentSets(const PointRings& rings);

}  // namespace prt
