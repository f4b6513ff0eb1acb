#include "ui/model/chart_picture.h"

#include "libprt/shade/surface_overlay.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

double cross(const DVec2& a, const DVec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Where a chart's map lies; false when it is not to be seen.
bool placementOf(const ChartItem& item, int only, ChartPlacement& placement) {
  if (!item.map || (only < 0 && !item.placement)) return false;
  placement = only < 0 ? *item.placement : ChartPlacement{};
  return true;
}

std::uint32_t packed(const Rgb& color) {
  const auto byte = [](float v) { return std::uint32_t(std::lround(255 * std::clamp(v, 0.0f, 1.0f))); };
  return 0xff000000u | byte(color.x) << 16 | byte(color.y) << 8 | byte(color.z);
}

}  // namespace

ChartPixels rasterCharts(const Charts& charts, const std::vector<ChartItem>& items, int only,
                         const ChartWindow& window) {
  ChartPixels pixels;
  const std::size_t count = std::size_t(window.width) * std::size_t(window.height);
  pixels.triangle.assign(count, kNowhere);
  pixels.twice.assign(count, 0);
  for (std::size_t c = 0; c < items.size(); ++c) {
    ChartPlacement placement;
    if ((only >= 0 && int(c) != only) || !placementOf(items[c], only, placement)) continue;
    const Chart& chart = charts.charts[c];
    std::vector<DVec2> at;
    at.reserve(items[c].map->uv.size());
    for (const DVec2& p : items[c].map->uv) at.push_back(window.toPixels(placement(p)));
    for (std::size_t t = 0; t < chart.faces.size(); ++t) {
      const UVec3& v = chart.triangles[t];
      const DVec2 &p = at[v.x], &q = at[v.y], &r = at[v.z];
      const double area = cross(q - p, r - p);
      const DVec2 low = min(p, min(q, r)), high = max(p, max(q, r));
      if (area == 0 || high.x < 0 || high.y < 0 || low.x > window.width || low.y > window.height) continue;
      const int x0 = std::max(0, int(std::ceil(low.x - 0.5))),
                x1 = std::min(window.width - 1, int(std::floor(high.x - 0.5)));
      const int y0 = std::max(0, int(std::ceil(low.y - 0.5))),
                y1 = std::min(window.height - 1, int(std::floor(high.y - 0.5)));
      const double sign = area > 0 ? 1 : -1;
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const DVec2 m(x + 0.5, y + 0.5);
          if (sign * cross(q - p, m - p) < 0 || sign * cross(r - q, m - q) < 0 ||
              sign * cross(p - r, m - r) < 0)
            continue;
          const std::size_t i = std::size_t(y) * std::size_t(window.width) + std::size_t(x);
          const std::uint32_t there = pixels.triangle[i];
          if (there != kNowhere && charts.chartOf[there] != c) pixels.twice[i] = 1;
          pixels.triangle[i] = chart.faces[t];
        }
    }
  }
  return pixels;
}

std::vector<std::uint32_t> chartPixelColors(const ChartPixels& pixels, const std::vector<Rgb>& colors,
                                            const ChartWindow& window, bool checker, float squares,
                                            std::uint32_t behind, std::uint32_t square) {
  constexpr std::uint32_t kHatch = 0xffe0533d, kBetween = 0xff6e241b;
  std::vector<std::uint32_t> out(pixels.triangle.size());
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(window.width) + std::size_t(x);
      const DVec2 place = window.toPlane({x + 0.5, y + 0.5});
      const std::uint32_t triangle = pixels.triangle[i];
      if (pixels.twice[i]) {
        out[i] = (x + y) % 8 < 4 ? kHatch : kBetween;
      } else if (triangle == kNowhere || triangle >= colors.size()) {
        out[i] = place.x >= 0 && place.y >= 0 && place.x < 1 && place.y < 1 ? square : behind;
      } else {
        const bool dark = checker && onDarkSquare(Vec2(place), squares);
        out[i] = packed(dark ? kDarkSquare * colors[triangle] : colors[triangle]);
      }
    }
  return out;
}

int chartUnder(const Charts& charts, const std::vector<ChartItem>& items, int only, int first,
               const DVec2& place) {
  int found = -1;
  for (int c = 0; c < int(items.size()); ++c) {
    ChartPlacement placement;
    const ChartItem& item = items[std::size_t(c)];
    if ((only >= 0 && c != only) || !placementOf(item, only, placement)) continue;
    // Even-odd over the outline: cheaper than all triangles.
    bool inside = false;
    for (const auto& loop : charts.charts[std::size_t(c)].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec2 a = placement(item.map->uv[loop[i]]),
                    b = placement(item.map->uv[loop[(i + 1) % loop.size()]]);
        if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
          inside = !inside;
      }
    if (!inside) continue;
    if (c == first) return c;
    found = c;
  }
  return found;
}

}  // namespace prt::ui
