#include "libprt/mesh/triangulate.h"

#include "libprt/mesh/generate_grid.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

/// The corners in the plane of the polygon's area vector (Newell), counter-clockwise, scaled to size 1.
std::vector<DVec2> flattened(std::span<const DVec3> corners) {
  DVec3 area(0), low = corners[0], high = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    low = min(low, corners[i]);
    high = max(high, corners[i]);
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(area[k]) > std::abs(area[axis])) axis = k;
  const int u = area[axis] >= 0 ? (axis + 1) % 3 : (axis + 2) % 3, v = 3 - axis - u;
  const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double scale = size > 0 ? 1 / size : 1;
  std::vector<DVec2> points;
  for (const DVec3& p : corners) points.push_back(scale * DVec2(p[u] - low[u], p[v] - low[v]));
  return points;
}

double twiceArea(const DVec2& a, const DVec2& b, const DVec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// The polygon's reflex corners in a grid of cells, so that an ear looks at those near it only.
class ReflexGrid {
 public:
  ReflexGrid(const std::vector<DVec2>& points, const std::vector<bool>& reflex) : points_(points) {
    const auto count = double(std::count(reflex.begin(), reflex.end(), true));
    side_ = std::clamp(int(std::sqrt(count)), 1, 256);
    cells_.resize(std::size_t(side_) * side_);
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (reflex[i]) cells_[cellOf(points[i])].push_back(i);
  }

  /// True when some corner for which `matters` is true lies in the triangle; counts its work.
  template <class Matters>
  bool anyInside(const DVec2& a, const DVec2& b, const DVec2& c, Matters matters, std::size_t* work) const {
    const int x0 = clamped(std::min({a.x, b.x, c.x})), x1 = clamped(std::max({a.x, b.x, c.x}));
    const int y0 = clamped(std::min({a.y, b.y, c.y})), y1 = clamped(std::max({a.y, b.y, c.y}));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const auto& cell = cells_[std::size_t(y) * side_ + x];
        *work += 1 + cell.size();
        for (std::uint32_t i : cell) {
          const DVec2& p = points_[i];
          if (matters(i) && p != a && p != b && p != c && twiceArea(a, b, p) >= 0 &&
              twiceArea(b, c, p) >= 0 && twiceArea(c, a, p) >= 0)
            return true;
        }
      }
    return false;
  }

 private:
  int clamped(double t) const { return std::clamp(int(t * side_), 0, side_ - 1); }
  std::size_t cellOf(const DVec2& p) const { return std::size_t(clamped(p.y)) * side_ + clamped(p.x); }

  const std::vector<DVec2>& points_;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

class EarClipper {
 public:
  explicit EarClipper(std::span<const DVec3> corners) : points_(flattened(corners)) {
    const auto n = std::uint32_t(points_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
    reflex_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) reflex_[i] = turn(i) <= 0;
  }

  std::vector<std::array<std::uint32_t, 3>> run(Job& job) {
    const ReflexGrid grid(points_, reflex_);
    std::size_t left = points_.size(), work = 0;
    const std::size_t workLimit = 400 * points_.size() + 2'000'000;
    std::uint32_t corner = 0;
    for (std::size_t tried = 0, steps = 0; left > 3; ++steps) {
      if (steps % 4096 == 4095) job.checkCancelled();
      const bool giveUp = tried > left || work > workLimit;
      if (giveUp || isEar(corner, grid, &work)) {
        clip(corner);
        --left;
        tried = 0;
        corner = next_[next_[corner]];  // skipping one spreads the ears, which keeps triangles fat
      } else {
        ++tried;
        corner = next_[corner];
      }
    }
    triangles_.push_back({previous_[corner], corner, next_[corner]});
    return std::move(triangles_);
  }

 private:
  double turn(std::uint32_t i) const {
    return twiceArea(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  bool isEar(std::uint32_t i, const ReflexGrid& grid, std::size_t* work) const {
    if (reflex_[i]) return false;
    return !grid.anyInside(
        points_[previous_[i]], points_[i], points_[next_[i]], [&](std::uint32_t k) { return reflex_[k]; },
        work);
  }

  void clip(std::uint32_t i) {
    const std::uint32_t before = previous_[i], after = next_[i];
    triangles_.push_back({before, i, after});
    next_[before] = after;
    previous_[after] = before;
    reflex_[i] = false;
    for (std::uint32_t k : {before, after}) reflex_[k] = reflex_[k] && turn(k) <= 0;
  }

  std::vector<DVec2> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<bool> reflex_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulatePolygon(std::span<const DVec3> corners, Job& job) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {{0, 1, 2}};
  return EarClipper(corners).run(job);
}

}  // namespace prt
