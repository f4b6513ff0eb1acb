#pragma once
// The colours that charts are shown in, on the surface and in the atlas alike.

#include "ui/model/chart_editor.h"

namespace prt::ui {

/// A calm hue of its own for each chart, named by a triangle of it: it stays while others are cut.
Rgb chartHue(std::uint32_t face);
/// Sides of the square per length of the surface, over all charts that are placed; 1 where none is.
double commonScale(const std::vector<ChartItem>& items);
/// Charts that cannot be laid flat, and triangles that lie over others.
inline constexpr Rgb kBadChart{0.52f, 0.16f, 0.13f};

/// Stretch 1 .. kMostStretch is the scale of the stretch map.
inline constexpr double kMostStretch = 2;
/// The density map runs from a kMostDensity-th to kMostDensity times the mean.
inline constexpr double kMostDensity = 4;
/// 0 (least) .. 1 (most), grey at one half.
Rgb densityColor(double value);

/// [F] display-encoded.
std::vector<Rgb> chartColors(const CutSurface& on, const Charts& charts, const std::vector<ChartItem>& items,
                             ChartShade shade, int selected, const std::set<std::uint32_t>& problems);
/// [3F] places of the triangles' corners in the atlas; 0 where a chart has none.
std::vector<Vec2> chartCoordinates(const Surface& surface, const Charts& charts,
                                   const std::vector<ChartItem>& items);

}  // namespace prt::ui
