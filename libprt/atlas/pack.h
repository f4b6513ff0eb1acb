#pragma once
// Charts side by side in one square: bitmap packing of their rotated outlines.

#include "libprt/atlas/surface.h"

#include "libprt/core/job.h"

#include <span>
#include <vector>

namespace prt {

/// Where a chart lies: uv = offset + scale * turn(angle) * flat.
struct ChartPlacement {
  double scale = 1;  ///< of the flat map's lengths, to a square of side 1
  double angle = 0;  ///< radians, counter-clockwise
  DVec2 offset{0};
  bool locked = false;  ///< stays where it is

  DVec2 operator()(const DVec2& flat) const {
    const double c = std::cos(angle) * scale, s = std::sin(angle) * scale;
    return offset + DVec2(c * flat.x - s * flat.y, s * flat.x + c * flat.y);
  }
};

/// A chart to be packed: its outline in the flat map, counter-clockwise, and how large it is to be.
struct PackChart {
  std::vector<DVec2> outline;
  double area = 0;      ///< of the surface
  double flatArea = 0;  ///< of the flat map
  double weight = 1;    ///< texels per area relative to others
};

struct PackOptions {
  int size = 2048;    ///< texels along a side
  int gutter = 1;     ///< empty texels around each chart, hence twice as many between two
  int turns = 16;     ///< directions tried per chart, 1..64; from 8 on others between them too
  double effort = 1;  ///< how long orders of charts are tried, against what is right for small meshes
};

/// Places charts that are not locked at one common scale, as large as goes in: sides of texels are covered
/// conservatively, so that no texel that a chart touches is one that another touches or has in its gutter.
/// Chart areas are proportional to surface area times weight. `locked` (empty, or one per chart) holds those
/// that stay. Deterministic whatever the threads. Throws ResourceError when the charts do not fit even when
/// tiny, Cancelled.
std::vector<ChartPlacement> packCharts(std::span<const PackChart> charts,
                                       std::span<const ChartPlacement> locked, const PackOptions& options,
                                       Job& job);

}  // namespace prt
