#pragma once
// The polygon that a chart's boundary is laid on (bi-scale, 4.3): corners on a circle, sides as long,
// relatively, as the stretches of boundary between corners; and the test that a polygon is simple.

#include "libprt/atlas/surface.h"

#include <span>
#include <vector>

namespace prt {

/// Corners of a convex polygon on a circle about the origin, counter-clockwise from (radius, 0), whose sides
/// have the given lengths. The centre lies outside when one side is longer than a half circle takes.
/// Throws ValueError when there are fewer than three sides or one is not shorter than all others together.
std::vector<DVec2> polygonOnCircle(std::span<const double> sides);

/// `count` corners spread over a closed boundary, by length: indices of boundary vertices in rising order,
/// the first at 0. `lengths` is that of each boundary edge, edge i from vertex i to i + 1. Fewer when the
/// boundary has fewer vertices; at least 3.
std::vector<std::uint32_t> spreadCorners(std::span<const double> lengths, int count);

/// Corners that a polygon can have: sorted, each once; the longest side is halved while it is not shorter
/// than the others together or fewer than three corners are left. Throws ValueError for an index out of
/// range.
std::vector<std::uint32_t> usableCorners(std::span<const double> lengths, std::vector<std::uint32_t> corners);

struct BoundaryPolygon {
  std::vector<DVec2> points;           ///< [b] of each boundary vertex, by length along straight sides
  std::vector<std::uint32_t> corners;  ///< [c] those used
  std::vector<bool> bowed;             ///< [c] sides that had to be bowed, from corner i to the next
};

/// Lays a boundary on the polygon of its corners. Sides for which `bow` is true (empty: none) run on a flat
/// arc outwards, 2 % of their length high: the remedy for dividing edges (Floater 2003), inner edges that
/// join two places of one side and would have to lie on it with all behind them.
BoundaryPolygon layOnPolygon(std::span<const double> lengths, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& bow);

/// Whether a closed polygon crosses or touches itself. Neighbouring sides share their end only. Expected
/// linear time when sides are of similar lengths.
bool selfIntersects(std::span<const DVec2> polygon);
/// The sides, rising, that cross or touch others: side i runs from point i to the next.
std::vector<std::uint32_t> crossingSides(std::span<const DVec2> polygon);

}  // namespace prt
