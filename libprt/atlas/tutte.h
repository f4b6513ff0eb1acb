#pragma once
// A flat map that is surely one-to-one: every inner vertex a positive mean of its neighbours, the boundary on
// a convex curve (Tutte 1963, Floater 1997).

#include "libprt/atlas/boundary_polygon.h"
#include "libprt/atlas/flat_chart.h"
#include "libprt/atlas/sparse_cholesky.h"

#include <memory>

namespace prt {

/// Factors once; then maps for any boundary, in a few milliseconds.
class TutteMap {
 public:
  /// Weights are cotangents, limited to 0.1 .. 10 so that they are positive; `uniform`: all 1. Keeps a
  /// reference to the chart. Throws Cancelled.
  TutteMap(const FlatChart& chart, bool uniform, Job& job);

  /// [n] for boundary points [b] that go with chart.rim.
  std::vector<DVec2> map(const std::vector<DVec2>& boundary) const;

 private:
  const FlatChart& chart_;
  std::vector<double> weights_;         // [e]
  std::vector<std::uint32_t> unknown_;  // [n] number of an inner vertex; kNowhere on the boundary
  std::unique_ptr<SparseCholesky<1>> solver_;
};

/// The boundary of a chart on a circle of the chart's area, by length.
std::vector<DVec2> boundaryOnCircle(const FlatChart& chart);

/// Which sides of a polygon dividing edges or cut-off triangles lie along: they must be bowed.
std::vector<bool> sidesToBow(const FlatChart& chart, std::span<const std::uint32_t> corners);

/// Maps with cotangents, else with uniform weights. Throws GeometryError, which names the chart, when
/// rounding leaves triangles turned over even so: the chart is too deep for its boundary.
std::vector<DVec2> bijectiveMap(const FlatChart& chart, const std::vector<DVec2>& boundary,
                                const std::string& name, Job& job);

}  // namespace prt
