#include "libprt/atlas/chart_texels.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <array>
#include <map>

namespace prt {
namespace {

constexpr double kHair = 4e-3;  // texels: more than rounding can move a point in a rectangle

/// A triangle in texels, from the centre of the rectangle's first one.
using Corners = std::array<DVec2, 3>;

double cross2(const DVec2& a, const DVec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Whether a triangle (counter-clockwise) comes into the square of a cell, or within a hair of it.
bool touches(const Corners& c, int x, int y) {
  const double half = 0.5 + kHair;
  const DVec2 centre(x + 0.5, y + 0.5);
  for (int i = 0; i < 3; ++i) {
    const DVec2 &a = c[std::size_t(i)], side = c[std::size_t((i + 1) % 3)] - a;
    if (cross2(side, centre - a) + half * (std::abs(side.x) + std::abs(side.y)) < 0) return false;
  }
  return true;
}

/// The texels of one chart.
class ChartRaster {
 public:
  ChartRaster(const Atlas& atlas, const std::vector<std::uint32_t>& faces, int size, Job& job)
      : atlas_(atlas), faces_(faces), size_(size), check_(job) {
    DVec2 low(1e300), high(-1e300);
    for (const std::uint32_t f : faces)
      for (int i = 0; i < 3; ++i) {
        const DVec2 p = DVec2(atlas.uv[atlas.uvTriangles[f][i]]) * double(size) - 0.5;
        low = min(low, p), high = max(high, p);
      }
    origin_ = glm::floor(low - kHair);
    const DVec2 extent = glm::floor(high + kHair) + 2.0 - origin_;
    width = std::uint32_t(extent.x), height = std::uint32_t(extent.y);
    number.assign(std::size_t(width) * height, TexelGrid::kFar);
    triangle_.assign(number.size(), kNowhere);
    barycentric_.assign(number.size(), DVec2(0));
  }

  void run() {
    for (const std::uint32_t f : faces_) mark(cornersOf(f));
    for (const std::uint32_t f : faces_) coverCentres(f);
    coverBeyondRim();
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (triangle_[i] == kNowhere) number[i] = TexelGrid::kFar;
      if (number[i] == TexelGrid::kFar) continue;
      number[i] = std::uint32_t(triangle.size());
      triangle.push_back(triangle_[i]);
      barycentric.push_back(Vec2(barycentric_[i]));
    }
    if (!triangle.empty()) return;  // else a chart without area: any point of it
    number[0] = 0;
    triangle.push_back(faces_.front());
    barycentric.push_back(Vec2(1.0f / 3));
  }

  TexelTriangle placeOf(std::uint32_t face) const {
    const Corners c = cornersOf(face);
    return {Vec2(c[0]), Vec2(c[1] - c[0]), Vec2(c[2] - c[0]), 0, width | height << 16};
  }

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> number;  // [width * height] from 0 within the chart; kFar
  std::vector<std::uint32_t> triangle;
  std::vector<Vec2> barycentric;

 private:
  static constexpr std::uint32_t kWanted = 0;

  Corners cornersOf(std::uint32_t face) const {
    Corners c;
    for (int i = 0; i < 3; ++i)
      c[std::size_t(i)] = DVec2(atlas_.uv[atlas_.uvTriangles[face][i]]) * double(size_) - 0.5 - origin_;
    return c;
  }
  std::size_t at(int x, int y) const { return std::size_t(y) * width + std::size_t(x); }

  /// Calls visit(x, y) for whole numbers from floor(low) to floor(high), inside of the rectangle.
  template <class Visit>
  void forWhole(const DVec2& low, const DVec2& high, int shrink, const Visit& visit) {
    const int x0 = std::max(0, int(std::floor(low.x))), x1 = std::min(int(width) - shrink, int(high.x));
    const int y0 = std::max(0, int(std::floor(low.y))), y1 = std::min(int(height) - shrink, int(high.y));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        check_();
        visit(x, y);
      }
  }

  /// Every cell that the triangle comes into wants the texels at its four corners.
  void mark(const Corners& c) {
    const DVec2 low = min(c[0], min(c[1], c[2])) - kHair, high = max(c[0], max(c[1], c[2])) + kHair;
    forWhole(low, high, 2, [&](int x, int y) {
      if (!touches(c, x, y)) return;
      for (const std::size_t i : {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)})
        number[i] = kWanted;
    });
  }

  void coverCentres(std::uint32_t face) {
    const Corners c = cornersOf(face);
    const double area = cross2(c[1] - c[0], c[2] - c[0]);
    if (!(area > 0)) return;
    forWhole(min(c[0], min(c[1], c[2])), max(c[0], max(c[1], c[2])), 1, [&](int x, int y) {
      const DVec2 p = DVec2(x, y) - c[0];
      const DVec2 w(cross2(p, c[2] - c[0]) / area, cross2(c[1] - c[0], p) / area);
      const std::size_t i = at(x, y);
      if (w.x < 0 || w.y < 0 || w.x + w.y > 1 || triangle_[i] != kNowhere) return;
      triangle_[i] = face;
      barycentric_[i] = w;
    });
  }

  /// Texels whose centre no triangle covers take the nearest point of the rim, which is less than two away.
  void coverBeyondRim() {
    constexpr double kReach = 2;
    std::map<std::size_t, double> nearest;
    for (const std::uint32_t corner : rim()) {
      const Corners c = cornersOf(corner / 3);
      const int k = int(corner % 3);
      const DVec2 a = c[std::size_t(k)], side = c[std::size_t((k + 1) % 3)] - a;
      const double length2 = dot(side, side);
      forWhole(min(a, a + side) - kReach, max(a, a + side) + kReach, 1, [&](int x, int y) {
        const std::size_t i = at(x, y);
        const auto known = nearest.find(i);
        if (number[i] == TexelGrid::kFar || (triangle_[i] != kNowhere && known == nearest.end())) return;
        const double t = length2 > 0 ? std::clamp(dot(DVec2(x, y) - a, side) / length2, 0.0, 1.0) : 0;
        const double distance = glm::distance(DVec2(x, y), a + t * side);
        if (known != nearest.end() && known->second <= distance) return;
        nearest[i] = distance;
        triangle_[i] = corner / 3;
        double w[3] = {0, 0, 0};
        w[k] = 1 - t, w[(k + 1) % 3] = t;
        barycentric_[i] = {w[1], w[2]};
      });
    }
  }

  /// Sides of triangles that no other one of the chart has, by the corner that they start at.
  std::vector<std::uint32_t> rim() const {
    struct Side {
      std::uint64_t key;
      std::uint32_t corner;
    };
    std::vector<Side> sides;
    sides.reserve(3 * faces_.size());
    for (const std::uint32_t f : faces_)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = atlas_.uvTriangles[f][int(k)], b = atlas_.uvTriangles[f][int((k + 1) % 3)];
        sides.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), 3 * f + k});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return x.key != y.key ? x.key < y.key : x.corner < y.corner;
    });
    std::vector<std::uint32_t> alone;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].key == sides[i].key) ++end;
      if (end == i + 1) alone.push_back(sides[i].corner);
      i = end;
    }
    return alone;
  }

  const Atlas& atlas_;
  const std::vector<std::uint32_t>& faces_;
  int size_;
  CancelCheck check_;
  DVec2 origin_{0};                      // of the rectangle, in texels of the atlas
  std::vector<std::uint32_t> triangle_;  // [width * height]
  std::vector<DVec2> barycentric_;
};

/// Behind what is there already.
void append(ChartRaster& chart, const std::vector<std::uint32_t>& faces, TexelGrid& grid, ChartTexels& all) {
  const auto first = std::uint32_t(grid.texels.size()), number = std::uint32_t(all.triangle.size());
  for (std::uint32_t& n : chart.number) n = n == TexelGrid::kFar ? number | TexelGrid::kFar : n + number;
  grid.charts.push_back({first, chart.width, chart.height});
  grid.texels.insert(grid.texels.end(), chart.number.begin(), chart.number.end());
  for (const std::uint32_t f : faces) {
    grid.triangles[f] = chart.placeOf(f);
    grid.triangles[f].first = first;
  }
  all.triangle.insert(all.triangle.end(), chart.triangle.begin(), chart.triangle.end());
  all.barycentric.insert(all.barycentric.end(), chart.barycentric.begin(), chart.barycentric.end());
}

}  // namespace

ChartTexels makeChartTexels(const Atlas& atlas, int size, Job& job) {
  if (size < 4 || size > 16384)
    throw ValueError("an atlas of " + std::to_string(size) + " texels a side", "texels", "use 4 to 16384");
  std::vector<std::vector<std::uint32_t>> faces(atlas.chartCount);
  for (std::uint32_t f = 0; f < atlas.triangleCount(); ++f) faces[atlas.chartOf[f]].push_back(f);
  std::vector<std::unique_ptr<ChartRaster>> charts(faces.size());
  parallelFor(job, 0, faces.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      if (faces[c].empty()) continue;
      charts[c] = std::make_unique<ChartRaster>(atlas, faces[c], size, job);
      charts[c]->run();
    }
  });
  ChartTexels all;
  auto grid = std::make_shared<TexelGrid>();
  grid->size = size;
  grid->triangles.resize(atlas.triangleCount());
  for (std::size_t c = 0; c < charts.size(); ++c) {
    job.checkCancelled();
    if (charts[c]) append(*charts[c], faces[c], *grid, all);
  }
  grid->count = all.triangle.size();
  all.grid = std::move(grid);
  return all;
}

}  // namespace prt
