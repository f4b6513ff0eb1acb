#pragma once
// Who is next to whom among points spread over a surface: the sides of each point's Voronoi cell in its
// tangent plane. On level ground that is the Delaunay triangulation.

#include "libprt/synthesis/surface_point.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Neighbours of all points in one list, counter-clockwise around each seen from outside; symmetric: when q
/// is in p's ring, p is in q's (those that only the other one asked for come last).
struct PointRings {
  std::vector<std::uint32_t> start;  ///< [points + 1] into list
  std::vector<std::uint32_t> list;

  std::size_t count() const { return start.empty() ? 0 : start.size() - 1; }
  std::span<const std::uint32_t> of(std::uint32_t point) const {
    return std::span(list).subspan(start[point], start[point + 1] - start[point]);
  }
};

/// Points as plain arrays: places, unit normals, triangles.
struct SpreadPoints {
  std::span<const Vec3> positions, normals;
  std::span<const std::uint32_t> triangle;
};

struct RingResult {
  PointRings rings;
  /// [points] from each point to the middle of its cell, in its tangent plane. Cells reach no further than
  /// `reach` / 2 to any side.
  std::vector<Vec3> toCentre;
};

/// `reach`: no neighbours further away than this, of the order of 2.5 times the distance of points. Points of
/// other sheets (SheetTest) are no neighbours however near. Same result for any number of threads.
RingResult voronoiRings(const SurfaceSheets& sheets, const SpreadPoints& points, float reach, Job& job);

}  // namespace prt
