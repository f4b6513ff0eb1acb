#include "ui/model/chart_colors.h"

#include "libprt/shade/color_map.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

Rgb mix(const Rgb& a, const Rgb& b, float share) {
  return a + share * (b - a);
}

DVec3 at(const Surface& surface, std::uint32_t face, int corner) {
  return DVec3(surface.positions[surface.triangles[face][corner]]);
}

double flatArea(const DVec2& a, const DVec2& b, const DVec2& c) {
  return 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

}  // namespace

Rgb chartHue(std::uint32_t face) {
  // Golden angles apart in the order of a scrambled number: neighbours rarely look alike.
  const std::uint32_t scrambled = (face ^ (face >> 16)) * 0x45d9f3bu;
  const double hue = 2 * kPi * std::fmod(double(scrambled) * 0.6180339887498949, 1.0);
  Rgb color;
  for (int k = 0; k < 3; ++k) color[k] = float(0.56 + 0.17 * std::cos(hue - 2 * kPi * k / 3));
  return color;
}

Rgb densityColor(double value) {
  const float t = float(std::clamp(value, 0.0, 1.0));
  const Rgb low(0.20f, 0.45f, 0.78f), middle(0.72f), high(0.85f, 0.47f, 0.16f);
  return t < 0.5f ? mix(low, middle, 2 * t) : mix(middle, high, 2 * t - 1);
}

double commonScale(const std::vector<ChartItem>& items) {
  double flat = 0, area = 0;
  for (const ChartItem& item : items) {
    if (!item.map || !item.placement) continue;
    flat += item.map->stretch.flatArea * item.placement->scale * item.placement->scale;
    area += item.map->stretch.area;
  }
  return area > 0 && flat > 0 ? std::sqrt(flat / area) : 1;
}

std::vector<Rgb> chartColors(const CutSurface& on, const Charts& charts, const std::vector<ChartItem>& items,
                             ChartShade shade, int selected, const std::set<std::uint32_t>& problems) {
  const Surface& surface = on.surface;
  std::vector<Rgb> colors(surface.triangleCount(), Rgb(0.42f));
  const double common = commonScale(items);
  for (std::size_t c = 0; c < items.size(); ++c) {
    const ChartItem& item = items[c];
    const Chart& chart = charts.charts[c];
    const bool bad = item.bad() || item.overlaps;
    const Rgb hue = bad ? kBadChart : chartHue(item.settings.face);
    const Rgb plain = int(c) == selected ? mix(hue, Rgb(1.0f, 0.86f, 0.58f), 0.45f) : hue;
    const bool mapped = item.map && !bad &&
                        (shade == ChartShade::Stretch || (shade == ChartShade::Density && item.placement));
    const double scale = mapped ? std::sqrt(item.map->stretch.flatArea / item.map->stretch.area) : 1;
    for (std::size_t t = 0; t < chart.faces.size(); ++t) {
      const std::uint32_t face = chart.faces[t];
      Rgb& color = colors[face];
      if (!mapped) {
        color = shade == ChartShade::Checker && !bad ? mix(plain, Rgb(0.88f), 0.55f) : plain;
      } else {
        const UVec3& v = chart.triangles[t];
        const std::array<DVec2, 3> flat{item.map->uv[v.x], item.map->uv[v.y], item.map->uv[v.z]};
        if (shade == ChartShade::Stretch) {
          const TriangleStretch s =
              triangleStretch({at(surface, face, 0), at(surface, face, 1), at(surface, face, 2)}, flat);
          color = magnitudeColor(float(std::clamp((s.l2 * scale - 1) / (kMostStretch - 1), 0.0, 1.0)));
        } else {
          const double size = item.placement->scale, area = std::max(surface.area(face), 1e-300);
          const double ratio = flatArea(flat[0], flat[1], flat[2]) * size * size / area / (common * common);
          color = densityColor(0.5 + 0.5 * std::log(std::max(ratio, 1e-9)) / std::log(kMostDensity));
        }
      }
    }
  }
  for (const std::uint32_t face : problems)
    if (face < colors.size()) colors[face] = kBadChart;
  return colors;
}

std::vector<Vec2> chartCoordinates(const Surface& surface, const Charts& charts,
                                   const std::vector<ChartItem>& items) {
  std::vector<Vec2> uv(3 * surface.triangleCount(), Vec2(0));
  for (std::size_t c = 0; c < items.size(); ++c) {
    if (!items[c].map || !items[c].placement) continue;
    const Chart& chart = charts.charts[c];
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      for (int k = 0; k < 3; ++k)
        uv[3 * std::size_t(chart.faces[t]) + std::size_t(k)] =
            Vec2((*items[c].placement)(items[c].map->uv[chart.triangles[t][k]]));
  }
  return uv;
}

}  // namespace prt::ui
