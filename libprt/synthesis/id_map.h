#pragma once
// The id map: for every texel of the atlas, the place in the patch that it shows (Bi-Scale Radiance Transfer,
// 4.3, step 3). A texel at P with normal N takes the coordinates of one vertex of the meso mesh, found by
// normal shooting (Sander et al. 2001): of the k vertices nearest to P the one nearest to the line through P
// along N.
//
// Guards against the far side of thin sheets (ALGORITHMS 9): a vertex counts only when its normal is within
// 72 degrees of N (dot at least 0.3), it lies at most two edges of the meso mesh along the line, and
// triangles lead to it from the texel's own (SheetTest: provenance, which no distance can replace). Where
// none of k vertices counts, k grows to 64; where none of those does, the nearest vertex that triangles lead
// to is taken.

#include "libprt/atlas/geometry_image.h"
#include "libprt/synthesis/meso_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// [size][size], rows from the top, as geometry images are.
struct IdMap {
  static constexpr std::uint16_t kEmpty = 65535;
  int size = 0;
  std::vector<std::uint16_t>
      ids;         ///< [size * size * 2] u, v: floor(65535 u), so below kEmpty; or kEmpty twice
  int layers = 0;  ///< patches over the first one, see layer_masks.h
  std::vector<std::uint8_t> weights;  ///< [size * size * layers] what each shows of a texel, in 255ths

  bool empty(std::size_t texel) const { return ids[2 * texel] == kEmpty; }
  /// Patch coordinates in (0, 1), in the middle of the step; (-1, -1) where empty.
  Vec2 at(std::size_t texel) const {
    if (empty(texel)) return Vec2(-1);
    return (Vec2(ids[2 * texel], ids[2 * texel + 1]) + 0.5f) / 65535.0f;
  }
};

struct IdMapOptions {
  int neighbours = 20;  ///< k, 1..64
};

/// Nobody's vertex: empty texels.
inline constexpr std::uint32_t kNoVertex = 0xffffffffu;

/// The vertex of every texel, [size * size]; exact. Near constant time a texel: vertices come from a grid.
/// Same result for any number of threads. Throws Cancelled.
std::vector<std::uint32_t> shootNormals(const MesoMesh& meso, const SurfaceSheets& sheets,
                                        const GeometryImage& image, const TexelSurface& texels,
                                        const IdMapOptions& options, Job& job);

/// The same by k nearest neighbours of a k-d tree (FLANN's exact single index): slower, kept as the check.
std::vector<std::uint32_t> shootNormalsByTree(const MesoMesh& meso, const SurfaceSheets& sheets,
                                              const GeometryImage& image, const TexelSurface& texels,
                                              const IdMapOptions& options, Job& job);

/// The map from the vertices of its texels. `coordinates` are the patch's, [M].
IdMap makeIdMap(int size, std::span<const std::uint32_t> vertexOf, std::span<const Vec2> coordinates);

/// A vertex as normal shooting looks at it.
struct ShotCandidate {
  std::uint32_t vertex;
  float distance2;  ///< to P
};

/// The choice itself, from candidates sorted by (distance, number): the best of the first k by the rules
/// above; kNoVertex when none counts.
std::uint32_t chooseAlongNormal(const MesoMesh& meso, SheetTest& test, const Vec3& position,
                                const Vec3& normal, std::uint32_t triangle,
                                std::span<const ShotCandidate> candidates);

}  // namespace prt
