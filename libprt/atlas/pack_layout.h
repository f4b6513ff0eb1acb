#pragma once
// Layouts of charts in a square of coarse cells: the search for the largest scale at which all fit. Internal
// to packing.

#include "libprt/atlas/pack.h"
#include "libprt/atlas/pack_mask.h"

namespace prt {

/// A chart on a grid: where its mask lies, for the angle and the scale that it was made with.
struct PackSpot {
  double angle = 0;
  int x = 0, y = 0;
};

/// What is to be laid out.
struct PackTask {
  std::span<const PackChart> charts;
  std::span<const ChartPlacement> locked;
  PackOptions options;
  std::vector<double> relative;     ///< [charts] flat lengths -> lengths at the common scale
  std::vector<double> angles;       ///< [charts] the turn with the least bounding box
  std::vector<std::uint32_t> free;  ///< charts that are to be placed, largest first
  double area = 0;                  ///< of those, weights included
  double lockedArea = 0;            ///< of the others, as part of the square

  /// The common scale at which the free charts take a part of the square.
  double scaleOf(double part) const { return std::sqrt(part / area); }
  /// A chart's outline in cells.
  std::vector<DVec2> turned(std::uint32_t chart, double scale, double angle, int cells) const;
  /// Distance from outlines to the cells that they must not share with others, in cells: the gutter and a
  /// hair for rounding; half a texel more where cells do not end with texels.
  double margin(int cells) const;
  /// The square with the locked charts in it.
  PackGrid grid(int cells) const;
};

struct PackLayout {
  double part = 0;                   ///< of the square that is chart; 0 when none was found
  int cells = 0;                     ///< of the grid
  std::vector<PackSpot> spots;       ///< [charts] of the free ones
  std::vector<std::uint32_t> order;  ///< in which they were placed
};

/// Greedy: in some order each chart goes to the lowest place that one of its turns finds, or to one lower
/// where it is snug. What found no place comes earlier the next time; when all fit, all grow. About `work`
/// charts are placed in all. With `start`, a layout on coarser cells, the search goes on from it, and the
/// result is `start` when that finds nothing larger. Deterministic whatever the threads. Throws Cancelled.
PackLayout searchLayout(const PackTask& task, int cells, double work, Job& job,
                        const PackLayout* start = nullptr);

}  // namespace prt
