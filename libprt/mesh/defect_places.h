#pragma once
// Where defects are: a bounded number of points, edges or triangles, as positions rather than indices, so
// that they still mean something once a repair has renumbered everything.

#include "libprt/core/math.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// The places of one class of defects. Element i is the simplices whose corners are
/// positions[starts[i]] .. positions[starts[i + 1] - 1]: one point, a loop of edges, a face's triangles.
struct DefectPlaces {
  /// Corners of a simplex.
  enum Shape : std::uint32_t { Points = 1, Edges = 2, Triangles = 3 };
  /// Positions that are kept; what comes later is counted but not placed.
  static constexpr std::size_t kMost = 6144;  // a multiple of every shape

  Shape shape = Points;
  std::vector<DVec3> positions;
  std::vector<std::uint32_t> starts{0};

  std::size_t elements() const { return starts.size() - 1; }
  std::span<const DVec3> element(std::size_t i) const {
    return std::span(positions).subspan(starts[i], starts[i + 1] - starts[i]);
  }
  /// Appends an element, as much of it as there is room for; nothing when there is none. All elements of one
  /// class have one shape.
  void add(Shape of, std::span<const DVec3> corners) {
    shape = of;
    const std::size_t room = (kMost - positions.size()) / of * of;
    if (room == 0 || corners.empty()) return;
    const std::span<const DVec3> fitting = corners.first(corners.size() < room ? corners.size() : room);
    positions.insert(positions.end(), fitting.begin(), fitting.end());
    starts.push_back(std::uint32_t(positions.size()));
  }
  bool full() const { return positions.size() + 3 > kMost; }
  bool operator==(const DefectPlaces&) const = default;
};

}  // namespace prt
