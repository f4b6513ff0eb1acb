#pragma once
// The atlas, or one chart, as a picture: which triangle each pixel shows, and its colour. Without Qt.

#include "ui/model/chart_editor.h"

#include <cstdint>
#include <vector>

namespace prt::ui {

/// A rectangle of the plane of the flat maps, seen by pixels; v upwards.
struct ChartWindow {
  DVec2 low{0};     ///< of the lower left corner
  double unit = 1;  ///< of the plane, per pixel
  int width = 0, height = 0;

  DVec2 toPixels(const DVec2& p) const { return {(p.x - low.x) / unit, height - (p.y - low.y) / unit}; }
  DVec2 toPlane(const DVec2& at) const { return {low.x + at.x * unit, low.y + (height - at.y) * unit}; }
};

struct ChartPixels {
  std::vector<std::uint32_t> triangle;  ///< [height * width] from the top; kNowhere where there is none
  std::vector<std::uint8_t> twice;      ///< a second chart lies there too
};

/// Rasterises one chart in its flat map, or all where they lie in the atlas (`only` < 0).
ChartPixels rasterCharts(const Charts& charts, const std::vector<ChartItem>& items, int only,
                         const ChartWindow& window);
/// 0xffRRGGBB per pixel. `colors` as of chartColors(); squares where `checker`, in the atlas's coordinates.
std::vector<std::uint32_t> chartPixelColors(const ChartPixels& pixels, const std::vector<Rgb>& colors,
                                            const ChartWindow& window, bool checker, float squares,
                                            std::uint32_t behind, std::uint32_t square);
/// The chart whose map covers a place; -1: none. The selected one first, then the last.
int chartUnder(const Charts& charts, const std::vector<ChartItem>& items, int only, int first,
               const DVec2& place);

}  // namespace prt::ui
