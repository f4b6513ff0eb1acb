#pragma once
// How far a flat map is from an isometry: the texture stretch of Sander et al. 2001, "Texture Mapping
// Progressive Meshes".

#include "libprt/atlas/surface.h"

#include <array>
#include <span>

namespace prt {

/// Singular values of the map from the texture plane to the surface, in lengths per texture length; infinite
/// where the flat triangle is flipped or has no area. `l2` is the root mean square over directions, `lInf`
/// the largest.
struct TriangleStretch {
  double l2 = 0;
  double lInf = 0;
};
TriangleStretch triangleStretch(const std::array<DVec3, 3>& surface, const std::array<DVec2, 3>& flat);

/// Sums over triangles, which can be added up over charts.
struct StretchSum {
  double squares = 0;   ///< of l2, times surface area
  double area = 0;      ///< of the surface
  double flatArea = 0;  ///< in the texture plane
  double worst = 0;     ///< largest lInf

  StretchSum& operator+=(const StretchSum& other);
  /// Scale that a flat map takes: texture lengths times `factor`.
  StretchSum scaled(double factor) const;
  /// 1 is an isometry but for scale; always >= 1, infinite when something is flipped.
  double l2() const { return area > 0 ? std::sqrt(squares / area * (flatArea / area)) : 1; }
  /// Largest stretch in any direction, relative to the scale that the areas give.
  double lInf() const { return area > 0 ? worst * std::sqrt(flatArea / area) : 1; }
};

/// Adds one triangle.
void addStretch(StretchSum& sum, const std::array<DVec3, 3>& surface, const std::array<DVec2, 3>& flat);
/// All triangles of a flat map: `positions` and `uv` go by the same indices.
StretchSum stretchOf(std::span<const DVec3> positions, std::span<const DVec2> uv,
                     std::span<const UVec3> triangles);

}  // namespace prt
