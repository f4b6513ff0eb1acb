#include "libprt/atlas/flat_chart.h"

#include "libprt/atlas/boundary_polygon.h"
#include "libprt/atlas/orientation.h"
#include "libprt/core/error.h"

#include <algorithm>

namespace prt {

FlatChart::FlatChart(const Surface& surface, const Chart& chart, const std::string& name)
    : triangles(chart.triangles) {
  if (chart.fault() != ChartFault::None)
    throw GeometryError("cannot be laid flat in one piece: " + faultText(chart), name,
                        "cut it further, for instance as suggested");
  positions.reserve(chart.vertices.size());
  for (std::uint32_t v : chart.vertices) positions.emplace_back(surface.positions[v]);
  rim = chart.loops[0];
  finish();
}

FlatChart::FlatChart(std::vector<DVec3> at, std::vector<UVec3> faces, std::vector<std::uint32_t> boundary)
    : positions(std::move(at)), triangles(std::move(faces)), rim(std::move(boundary)) {
  finish();
}

void FlatChart::finish() {
  // Edges by sorting the sides.
  struct Side {
    std::uint32_t a, b, corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][int(i)], b = triangles[t][int((i + 1) % 3)];
      sides.push_back({std::min(a, b), std::max(a, b), 3 * t + i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.corner < y.corner;
  });
  edgeOf.resize(triangles.size());
  for (const Side& side : sides) {
    if (edges.empty() || edges.back() != std::pair(side.a, side.b)) edges.emplace_back(side.a, side.b);
    edgeOf[side.corner / 3][int(side.corner % 3)] = std::uint32_t(edges.size() - 1);
  }
  for (std::size_t i = 0; i < rim.size(); ++i)
    rimLengths.push_back(glm::distance(positions[rim[i]], positions[rim[(i + 1) % rim.size()]]));
  for (const UVec3& t : triangles)
    area += 0.5 * glm::length(glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]));
}

std::vector<std::uint32_t> flippedTriangles(const FlatChart& chart, const std::vector<DVec2>& uv) {
  std::vector<std::uint32_t> flipped;
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
    const UVec3& c = chart.triangles[t];
    if (!surelyPositive(uv[c.x], uv[c.y], uv[c.z])) flipped.push_back(t);
  }
  return flipped;
}

bool isInjective(const FlatChart& chart, const std::vector<DVec2>& uv) {
  for (const UVec3& c : chart.triangles)
    if (!surelyPositive(uv[c.x], uv[c.y], uv[c.z])) return false;
  std::vector<DVec2> boundary;
  boundary.reserve(chart.rim.size());
  for (std::uint32_t v : chart.rim) boundary.push_back(uv[v]);
  return !selfIntersects(boundary);
}

}  // namespace prt
