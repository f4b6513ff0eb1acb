#pragma once
// Points spread over a surface so that none are close to each other and no place is far from all (Poisson
// discs): darts thrown at the surface in a fixed random order, each kept unless one that was kept before is
// nearer than a radius. Radii halve from level to level, so the points of the first levels alone are such a
// set too, of twice the distance and a quarter of the count.

#include "libprt/synthesis/surface_point.h"

#include <cstddef>
#include <vector>

namespace prt {

struct SurfaceDarts {
  std::vector<SurfacePoint> points;   ///< the coarsest level first
  std::vector<std::size_t> levelEnd;  ///< [levels] points of each level and all before it; the last is all
  float radius = 0;                   ///< least distance of points of one sheet, on the finest level
};

/// About `count` points (within a few per cent; at least 1 for each component with area), with as many levels
/// as leave at least `coarsest` points on the first. Pure in (surface, count, seed). Throws GeometryError
/// when the surface has no area, ValueError unless count is 16 .. 50 million.
SurfaceDarts throwDarts(const SurfaceSheets& sheets, std::size_t count, std::size_t coarsest,
                        std::uint64_t seed, Job& job);

}  // namespace prt
