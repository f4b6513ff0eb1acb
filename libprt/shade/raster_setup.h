#pragma once
// First half of the rasteriser: projection, clipping, snapping, and sorting of triangles into tiles.
// Private to shade/raster.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/mesh/mesh.h"
#include "libprt/shade/camera.h"

#include <array>
#include <cstdint>
#include <vector>

namespace prt::raster {

/// Samples from one row of a tile to the next, and the most a tile is wide or high.
inline constexpr int kTileSamples = 128;

/// A point before the division: screen position in samples times w. w = distance along the axis; 1 for
/// parallel rays, whose distance is kept apart.
struct Homogeneous {
  double x = 0, y = 0, w = 0;
  double distance = 0;
};

/// Camera to sample coordinates (y down), and how finely those are snapped.
struct Projection {
  Projection() = default;
  Projection(const Camera& camera, int samplesX, int samplesY);
  Homogeneous operator()(const Vec3& p) const;

  DVec3 eye{0}, rowX{0}, rowY{0}, rowW{0};
  bool parallel = false;
  int samplesX = 0, samplesY = 0;
  int bits = 8;  ///< fixed-point units in a sample: 2^bits
};

/// A snapped triangle, turned so that its area is positive in sample coordinates.
struct SetupTriangle {
  std::array<std::int32_t, 3> x, y;
  std::array<float, 3> nearness;  ///< linear on screen, larger = nearer, positive: 1/w
  std::uint32_t triangle;
};

/// Consecutive triangles of the mesh: what is left of them after clipping and culling, and which of
/// them touch which tile (items[first[tile]] to items[first[tile + 1] - 1], in order).
struct Chunk {
  std::vector<SetupTriangle> triangles;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> items;
};

struct Bins {
  std::vector<Chunk> chunks;
  // Parallel rays: what SetupTriangle::nearness means, see distance().
  double farthest = 0, perLength = 0;

  /// Along the axis, of a nearness.
  double distance(float nearness) const {
    return perLength > 0 ? farthest - (double(nearness) - 1) / perLength : 1 / double(nearness);
  }
};

/// `tileSamples`: a tile's side in samples.
Bins binTriangles(const TriMesh& mesh, const Projection& projection, int tileSamples, int tilesX, int tilesY,
                  Job& job);

}  // namespace prt::raster
