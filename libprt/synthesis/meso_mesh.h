#pragma once
// The meso mesh: the surface covered anew by many evenly spaced vertices, each of which knows the triangle of
// the macro mesh that it lies on. Carries the texture that is synthesised (Bi-Scale Radiance Transfer, 4.3:
// "we first retile the surface into a dense mesh").
//
// Made as Turk did (1992, "Re-Tiling Polygonal Surfaces"): points are spread at random with a least distance,
// then pushed apart, here by moving each to the middle of its cell (Lloyd), over edges and all. Spacing is
// even whatever the triangles are like, slivers and fans included; every vertex lies on the macro surface.

#include "libprt/synthesis/voronoi_rings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace prt {

struct MesoMesh {
  std::vector<std::uint32_t> triangle;  ///< [M] macro triangle that each vertex lies on
  std::vector<Vec2> barycentric;        ///< [M] weights of its corners 1 and 2
  std::vector<Vec3> positions;          ///< [M]
  std::vector<Vec3> normals;            ///< [M] unit shading normals, interpolated
  /// [levels] The first levelEnd[0] vertices alone cover the surface evenly, the first levelEnd[1] twice as
  /// densely, and so on; the last is M. Inside a level, vertices near to each other are near in memory.
  std::vector<std::size_t> levelEnd;
  double edge = 0;  ///< length of edges of an even mesh of so many vertices: sqrt(1.155 area / M)

  std::size_t vertexCount() const { return positions.size(); }
  int levels() const { return int(levelEnd.size()); }
  /// Edge length of a level, 0 = coarsest.
  double edgeOf(int level) const {
    return edge * std::sqrt(double(vertexCount()) / double(levelEnd[std::size_t(level)]));
  }
};

struct MesoMeshOptions {
  std::size_t vertices = 960'000;  ///< about so many, 16 .. 50 million
  std::size_t coarsest = 64;       ///< least vertices of the first level
  int relaxations = 4;             ///< moves towards the middle of the cells, 0..20
  std::uint64_t seed = 1;
};

/// `surface` is made of `mesh`. Same result for any number of threads. Throws GeometryError, ValueError,
/// Cancelled.
MesoMesh makeMesoMesh(const TriMesh& mesh, const SurfaceSheets& sheets, const MesoMeshOptions& options,
                      Job& job);

/// Vertices for a spacing of `edge`.
std::size_t verticesForEdge(const Surface& surface, double edge);

/// Neighbours on one level: of the first levelEnd[level] vertices among themselves.
PointRings mesoRings(const MesoMesh& meso, const SurfaceSheets& sheets, int level, Job& job);

/// How even the spacing is: distances to the nearest neighbour and lengths of edges, relative to `edge`.
struct MesoSpacing {
  double nearestMean = 0, nearestLeast = 0, nearestSpread = 0;  ///< spread: standard deviation / mean
  double edgeMean = 0, edgeMost = 0, edgeSpread = 0;
  double valence = 0;
};
MesoSpacing mesoSpacing(const MesoMesh& meso, const PointRings& rings);

}  // namespace prt
