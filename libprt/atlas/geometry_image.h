#pragma once
// The surface seen through the atlas: which point of which triangle each texel shows (bi-scale, 4.3).

#include "libprt/atlas/atlas.h"

#include <cstdint>
#include <vector>

namespace prt {

/// How a texel came to its point.
enum class TexelKind : std::uint8_t {
  Empty,
  Inside,  ///< its centre lies in the triangle
  Border,  ///< a chart reaches into it past its centre: the nearest point of the chart's rim
  Gutter   ///< outside of all charts: the point of the nearest texel that has one
};

/// [size][size], rows from the top (v = 1 first), as images are.
struct GeometryImage {
  int size = 0;
  std::vector<std::uint32_t> triangle;  ///< kNowhere where Empty
  std::vector<Vec2> barycentric;        ///< weights of corners 1 and 2; in 0..1, together at most 1
  std::vector<TexelKind> kind;

  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(size) + std::size_t(x); }
  /// Texels that a chart covers or touches, as part of all.
  double filled() const;
};

/// Texture coordinates of a texel's centre.
inline DVec2 texelCentre(int size, int x, int y) {
  return {(x + 0.5) / size, 1 - (y + 0.5) / size};
}

/// Rasterises at any size; `dilate` rings of texels around the charts take the nearest point's values (the
/// atlas's gutter when negative). A centre on an edge belongs to one triangle (top-left rule). Where two
/// triangles cover a centre, the later one is shown. Throws Cancelled.
GeometryImage makeGeometryImage(const Atlas& atlas, int size, int dilate, Job& job);

/// A centre that two triangles cover.
struct TexelOverlap {
  std::uint32_t triangle, other;
  Vec2 at;
};
/// All of them at a size, row by row; `rims`: texels that two charts reach into as well.
std::vector<TexelOverlap> overlappingTexels(const Atlas& atlas, int size, Job& job, bool rims = true);

/// Positions, shading normals (unit) and tangents along growing u (unit, at right angles to the normal) at
/// the texels, zero where there is none. `triangles` are the mesh's, by vertices.
struct TexelSurface {
  std::vector<Vec3> position, normal, tangent;  ///< [size * size]
};
TexelSurface texelSurface(const TriMesh& mesh, const Atlas& atlas, const GeometryImage& image, Job& job);

/// Largest distance, in texels, between a texel's centre and the place in the texture of the point it shows:
/// of Inside texels, zero but for rounding; of Border texels, under 0.75.
struct BackProjection {
  double inside = 0;
  double border = 0;
  std::size_t outsideTriangle = 0;  ///< texels whose barycentric coordinates leave their triangle
};
BackProjection backProject(const Atlas& atlas, const GeometryImage& image, Job& job);

}  // namespace prt
