#include "libprt/atlas/convex_hull.h"

#include <algorithm>

namespace prt {
namespace {

double cross(const DVec2& a, const DVec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

std::vector<DVec2> convexHull(std::vector<DVec2> points) {
  // Andrew's monotone chain.
  std::sort(points.begin(), points.end(),
            [](const DVec2& a, const DVec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<DVec2> hull;
  for (const int pass : {0, 1}) {
    const std::size_t base = hull.size();
    for (const DVec2& p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return hull.empty() ? points : hull;
}

double polygonArea(const std::vector<DVec2>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

}  // namespace prt
