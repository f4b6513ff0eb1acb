#pragma once
// A chart as the flatteners see it: its vertices in space, its triangles, its boundary.

#include "libprt/atlas/charts.h"

#include <utility>
#include <vector>

namespace prt {

struct FlatChart {
  std::vector<DVec3> positions;    ///< [n]
  std::vector<UVec3> triangles;    ///< [f]
  std::vector<std::uint32_t> rim;  ///< the boundary, counter-clockwise
  std::vector<double> rimLengths;  ///< [b] of edge i, from rim vertex i to the next
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< [e] first < second
  std::vector<UVec3> edgeOf;                                   ///< [f] edge from each corner to the next
  double area = 0;

  FlatChart() = default;
  /// Throws GeometryError, which names the chart `name`, when it is not a disk.
  FlatChart(const Surface& surface, const Chart& chart, const std::string& name);
  /// From plain arrays. `rim` must be the one boundary of the triangles.
  FlatChart(std::vector<DVec3> at, std::vector<UVec3> faces, std::vector<std::uint32_t> boundary);

 private:
  void finish();
};

/// Whether a flat map turns over no triangle and its boundary does not cross itself: it is injective then.
bool isInjective(const FlatChart& chart, const std::vector<DVec2>& uv);
/// Triangles that are not surely counter-clockwise.
std::vector<std::uint32_t> flippedTriangles(const FlatChart& chart, const std::vector<DVec2>& uv);

}  // namespace prt
