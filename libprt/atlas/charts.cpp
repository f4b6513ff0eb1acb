#include "libprt/atlas/charts.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>

namespace prt {
namespace {

bool crossable(const Surface& surface, const Seams& seams, std::uint32_t half) {
  return surface.twin[half] != kNowhere && !seams[surface.edge[half]];
}

/// The corner numbers (half-edges out of the vertex) of a fan are joined to its first one, counter-clockwise
/// from where the fan begins. Returns the first, and tells whether the fan is open.
std::uint32_t firstOfFan(const Surface& surface, const Seams& seams, std::uint32_t half, bool& open) {
  std::uint32_t at = half;
  do {
    // Clockwise: across the half-edge out of the vertex, to the next one of that triangle.
    if (!crossable(surface, seams, at)) {
      open = true;
      return at;
    }
    at = nextHalf(surface.twin[at]);
  } while (at != half);
  open = false;
  return half;
}

/// Gives each fan of the piece a vertex and follows the boundary.
struct ChartBuilder {
  const Surface& surface;
  const Seams& seams;
  std::vector<std::uint32_t>& vertexOfCorner;  // [3F], written for the piece's corners only

  void numberVertices(Chart& chart) const {
    chart.triangles.reserve(chart.faces.size());
    for (std::uint32_t f : chart.faces)
      for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) vertexOfCorner[c] = kNowhere;
    for (std::uint32_t f : chart.faces)
      for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) {
        if (vertexOfCorner[c] != kNowhere) continue;
        bool open = false;
        const std::uint32_t first = firstOfFan(surface, seams, c, open);
        std::uint32_t at = first;
        do {
          vertexOfCorner[at] = std::uint32_t(chart.vertices.size());
          const std::uint32_t in = previousHalf(at);  // counter-clockwise
          if (!crossable(surface, seams, in)) break;
          at = surface.twin[in];
        } while (at != first);
        chart.vertices.push_back(surface.from(c));
      }
    for (std::uint32_t f : chart.faces) {
      chart.triangles.push_back(
          {vertexOfCorner[3 * f], vertexOfCorner[3 * f + 1], vertexOfCorner[3 * f + 2]});
      chart.area += surface.area(f);
    }
  }

  void followBoundary(Chart& chart) const {
    std::vector<std::uint32_t> next(chart.vertices.size(), kNowhere);
    std::size_t rim = 0, sides = 3 * chart.faces.size();
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      for (std::uint32_t i = 0; i < 3; ++i)
        if (!crossable(surface, seams, 3 * chart.faces[t] + i)) {
          next[chart.triangles[t][int(i)]] = chart.triangles[t][int((i + 1) % 3)];
          ++rim;
        }
    chart.euler = int(chart.vertices.size()) - int((sides + rim) / 2) + int(chart.faces.size());
    for (std::uint32_t v = 0; v < next.size(); ++v) {
      if (next[v] == kNowhere) continue;
      std::vector<std::uint32_t>& loop = chart.loops.emplace_back();
      for (std::uint32_t at = v; next[at] != kNowhere;) {
        loop.push_back(at);
        const std::uint32_t to = next[at];
        next[at] = kNowhere;
        at = to;
      }
    }
  }
};

}  // namespace

ChartFault Chart::fault() const {
  if (handles() > 0) return ChartFault::Handles;
  if (loops.empty() || (loops.size() == 1 && loops[0].size() < 3)) return ChartFault::Closed;
  return loops.size() > 1 ? ChartFault::Boundaries : ChartFault::None;
}

Charts makeCharts(const Surface& surface, const Seams& seams, Job& job) {
  Charts charts;
  charts.chartOf.assign(surface.triangleCount(), kNowhere);
  CancelCheck check(job);
  std::vector<std::uint32_t> vertexOfCorner(3 * surface.triangleCount()), stack;
  const ChartBuilder builder{surface, seams, vertexOfCorner};
  for (std::uint32_t f = 0; f < surface.triangleCount(); ++f) {
    if (charts.chartOf[f] != kNowhere) continue;
    Chart& chart = charts.charts.emplace_back();
    const auto number = std::uint32_t(charts.charts.size() - 1);
    charts.chartOf[f] = number;
    stack.assign(1, f);
    while (!stack.empty()) {
      check();
      const std::uint32_t face = stack.back();
      stack.pop_back();
      chart.faces.push_back(face);
      for (std::uint32_t half = 3 * face; half < 3 * face + 3; ++half) {
        if (!crossable(surface, seams, half)) continue;
        const std::uint32_t other = surface.twin[half] / 3;
        if (charts.chartOf[other] != kNowhere) continue;
        charts.chartOf[other] = number;
        stack.push_back(other);
      }
    }
    std::sort(chart.faces.begin(), chart.faces.end());
    builder.numberVertices(chart);
    builder.followBoundary(chart);
  }
  return charts;
}

Chart makeChart(const Surface& surface, const Seams& seams, std::span<const std::uint32_t> faces) {
  static thread_local std::vector<std::uint32_t> vertexOfCorner;  // as large as a surface: kept between calls
  if (vertexOfCorner.size() < 3 * surface.triangleCount()) vertexOfCorner.resize(3 * surface.triangleCount());
  Chart chart;
  chart.faces.assign(faces.begin(), faces.end());
  std::sort(chart.faces.begin(), chart.faces.end());
  const ChartBuilder builder{surface, seams, vertexOfCorner};
  builder.numberVertices(chart);
  builder.followBoundary(chart);
  return chart;
}

std::string chartName(std::size_t chart) {
  return "chart " + std::to_string(chart + 1);
}

std::vector<DVec2> outlineOf(const Chart& chart, std::span<const DVec2> uv) {
  std::vector<DVec2> outline;
  if (chart.loops.empty()) return outline;
  for (const std::uint32_t v : chart.loops[0]) outline.push_back(uv[v]);
  return outline;
}

std::string faultText(const Chart& chart) {
  const auto plural = [](int count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
  };
  switch (chart.fault()) {
    case ChartFault::None:
      return "a disk";
    case ChartFault::Closed:
      return chart.loops.empty() ? "closed: no boundary to unfold from" : "cut along one edge only";
    case ChartFault::Boundaries:
      return plural(int(chart.loops.size()), "boundary", "boundaries") + " instead of 1";
    case ChartFault::Handles:
      return plural(chart.handles(), "handle", "handles");
  }
  return {};
}

}  // namespace prt
