#pragma once
// The atlas: every triangle's place in the unit square, made of charts laid flat and packed, or taken over
// from a mesh's own texture coordinates where they are one-to-one.

#include "libprt/atlas/auto_cut.h"
#include "libprt/atlas/pack.h"

#include <string>

namespace prt {

/// Texture coordinates lie on a grid of 2^-22, so that which triangle a point is in is decided exactly.
struct Atlas {
  int size = 2048;                         ///< texels along a side that it was packed for
  int gutter = 1;                          ///< texels around each chart
  std::vector<Vec2> uv;                    ///< [V'] v up, 0..1
  std::vector<UVec3> uvTriangles;          ///< [F]
  std::vector<std::uint32_t> chartOf;      ///< [F]
  std::vector<ChartPlacement> placements;  ///< [charts]; empty for imported coordinates
  std::uint32_t chartCount = 0;

  std::size_t triangleCount() const { return uvTriangles.size(); }
};

struct AtlasOptions {
  PackOptions pack;
  std::vector<double> weights;         ///< [charts] texels per area relative to others; empty = 1
  std::vector<ChartPlacement> locked;  ///< [charts] placements that stay; empty = none
};

/// Packs charts and rounds their coordinates to the grid. No triangle is turned over: vertices that rounding
/// would make to are nudged. Throws GeometryError, which names the chart, when a triangle is smaller than the
/// grid can hold; ResourceError when the charts do not fit.
Atlas packAtlas(const FlatCharts& charts, const AtlasOptions& options, Job& job);

/// The same for placements made by hand; nothing is moved.
Atlas placeAtlas(const FlatCharts& charts, std::vector<ChartPlacement> placements, const PackOptions& options,
                 Job& job);

/// A place where coordinates are no map.
struct UvProblem {
  enum class Kind { Missing, Outside, Flipped, Overlap } kind = Kind::Overlap;
  std::uint32_t triangle = 0;
  std::uint32_t other = kNowhere;  ///< Overlap: a triangle that it lies over
  Vec2 at{0};                      ///< in the texture
};
std::string toString(UvProblem::Kind kind);

struct ImportedAtlas {
  Atlas atlas;                      ///< its charts are what hangs together in the texture
  std::vector<UvProblem> problems;  ///< empty when the coordinates are injective; by triangle, at most 1000
};

/// A mesh's own coordinates as an atlas. Mirrored coordinates (all triangles clockwise) are flipped in u as a
/// whole. Overlaps are found texel by texel at `options.size`. Throws ValueError when the mesh has none.
ImportedAtlas importAtlas(const TriMesh& mesh, const PackOptions& options, Job& job);

/// L2 and L-infinity stretch of the whole atlas as one map.
StretchSum atlasStretch(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                        const Atlas& atlas);

}  // namespace prt
