#pragma once
// What is set by hand for single charts: corners, weight, place. A chart has no name that lasts, it is named
// by a triangle that it contains: so settings outlive cuts made elsewhere, and of a chart that is cut in two
// the piece with that triangle keeps them.

#include "libprt/atlas/auto_cut.h"
#include "libprt/atlas/pack.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace prt {

struct ChartSettings {
  std::uint32_t face = kNowhere;  ///< a triangle of the chart
  double weight = 1;              ///< texels per area relative to others, 0.001 .. 1000
  int cornerCount = 0;  ///< its boundary on a polygon of so many corners, spread by length; 0: as all
  /// Or corners at these places: parts of the boundary's length from its first vertex on, 0 <= place < 1,
  /// rising, three at least. Each means the boundary vertex nearest to it.
  std::vector<double> corners;
  std::optional<ChartPlacement> place;  ///< it is not packed but lies there
  bool locked = false;                  ///< packing by hand leaves `place` alone too

  bool hasCorners() const { return cornerCount > 0 || !corners.empty(); }
  /// Whether there is nothing to keep.
  bool plain() const { return weight == 1 && !hasCorners() && !place && !locked; }
  bool operator==(const ChartSettings&) const;
};

/// "FACE weight=2 corners=5 place=U,V,DEGREES,SCALE locked;FACE corners=0,0.2,0.7": any of these per chart.
/// Throws ValueError, which quotes the part, when the text is not of that form or a value is out of range.
std::vector<ChartSettings> chartSettingsFromText(const std::string& text);
/// The reverse; plain ones are left out.
std::string chartSettingsToText(std::span<const ChartSettings> settings);

/// [charts] the settings of each; of two that name one chart the first counts. Charts that nobody named get
/// plain ones with their own first triangle.
std::vector<ChartSettings> settingsOfCharts(const Charts& charts, std::span<const ChartSettings> settings);

/// The boundary vertices nearest to places along a closed boundary: rising, each once. `lengths` as for
/// spreadCorners().
std::vector<std::uint32_t> cornersAt(std::span<const double> lengths, std::span<const double> places);
/// The reverse: where boundary vertices lie.
std::vector<double> placesOf(std::span<const double> lengths, std::span<const std::uint32_t> corners);

/// `options` for a chart with these settings: one that has corners of its own is laid on a polygon.
FlattenOptions flattenOptionsFor(const FlatChart& chart, const ChartSettings& settings,
                                 FlattenOptions options);

/// flattenCharts() with settings, [charts] or none.
FlatCharts flattenCharts(const Surface& surface, const Seams& seams, const FlattenOptions& options,
                         std::span<const ChartSettings> settings, Job& job);

/// Where texture coordinates part: inner edges whose two triangles have different coordinates there.
Seams seamsOfCoordinates(const Surface& surface, std::span<const UVec3> uvTriangles);

/// Two charts whose triangles share ground where they were put, or one (`other` == `chart`) that leaves the
/// square.
struct PlacementProblem {
  std::size_t chart = 0, other = 0;
};
/// Of outlines in the flat maps; exact up to the gutter of half a texel at `size`. Deterministic, by chart.
std::vector<PlacementProblem> placementProblems(std::span<const std::vector<DVec2>> outlines,
                                                std::span<const ChartPlacement> placements, int size);

}  // namespace prt
