#include "libprt/synthesis/voronoi_rings.h"

#include "libprt/core/parallel.h"
#include "libprt/synthesis/point_grid.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

namespace prt {
namespace {

struct Near {
  Vec2 at;  // in the tangent plane, as far away as in space
  float distance2;
  std::uint32_t point;
};

/// A convex polygon around the origin whose sides know who cut them.
class Cell {
 public:
  explicit Cell(float half) {
    corners_ = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    owner_.assign(4, kNowhere);  // owner_[i]: of the side from corner i to the next
  }
  float reach2() const {
    float most = 0;
    for (const Vec2& c : corners_) most = std::max(most, dot(c, c));
    return most;
  }
  /// Keeps what is nearer to the origin than to `n`.
  void cut(const Near& n) {
    const float level = 0.5f * dot(n.at, n.at);
    bool any = false;
    for (const Vec2& c : corners_) any |= dot(c, n.at) > level;
    if (!any) return;
    newCorners_.clear(), newOwner_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2 &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
      const float da = dot(a, n.at) - level, db = dot(b, n.at) - level;
      if (da <= 0) newCorners_.push_back(a), newOwner_.push_back(owner_[i]);
      if ((da <= 0) == (db <= 0)) continue;
      newCorners_.push_back(a + (da / (da - db)) * (b - a));
      // Leaving the cell, the new side begins; coming back, the old one goes on.
      newOwner_.push_back(da <= 0 ? n.point : owner_[i]);
    }
    corners_.swap(newCorners_), owner_.swap(newOwner_);
  }
  Vec2 centre() const {
    Vec2 sum(0);
    float area = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2 &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
      const float twice = a.x * b.y - a.y * b.x;
      area += twice;
      sum += twice * (a + b);
    }
    return area > 0 ? sum / (3 * area) : Vec2(0);
  }
  const std::vector<std::uint32_t>& owners() const { return owner_; }

 private:
  std::vector<Vec2> corners_, newCorners_;
  std::vector<std::uint32_t> owner_, newOwner_;
};

struct Tile {
  std::vector<std::uint32_t> counts, list;
};

/// Rings with the neighbours added that only the other side knows of.
PointRings symmetric(const std::vector<Tile>& tiles, std::size_t count) {
  PointRings own;
  own.start.reserve(count + 1);
  own.start.push_back(0);
  for (const Tile& tile : tiles) {
    for (const std::uint32_t n : tile.counts) own.start.push_back(own.start.back() + n);
    own.list.insert(own.list.end(), tile.list.begin(), tile.list.end());
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> missing;
  for (std::uint32_t p = 0; p < count; ++p)
    for (const std::uint32_t q : own.of(p)) {
      const auto ring = own.of(q);
      if (std::find(ring.begin(), ring.end(), p) == ring.end()) missing.emplace_back(q, p);
    }
  if (missing.empty()) return own;
  std::sort(missing.begin(), missing.end());
  PointRings both;
  both.start.reserve(count + 1);
  both.list.reserve(own.list.size() + missing.size());
  both.start.push_back(0);
  auto next = missing.begin();
  for (std::uint32_t p = 0; p < count; ++p) {
    const auto ring = own.of(p);
    both.list.insert(both.list.end(), ring.begin(), ring.end());
    for (; next != missing.end() && next->first == p; ++next) both.list.push_back(next->second);
    both.start.push_back(std::uint32_t(both.list.size()));
  }
  return both;
}

}  // namespace

RingResult voronoiRings(const SurfaceSheets& sheets, const SpreadPoints& points, float reach, Job& job) {
  constexpr std::size_t kTile = 4096;
  const std::size_t count = points.positions.size();
  const PointGrid grid(points.positions, reach);
  tbb::enumerable_thread_specific<SheetTest> tests([&] { return SheetTest(sheets); });
  std::vector<Tile> tiles((count + kTile - 1) / kTile);
  RingResult result;
  result.toCentre.resize(count);
  parallelFor(job, 0, count, kTile, [&](std::size_t begin, std::size_t end) {
    Tile& tile = tiles[begin / kTile];
    SheetTest& test = tests.local();
    std::vector<Near> near;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = points.positions[i];
      const Frame frame = frameFromNormal(points.normals[i]);
      near.clear();
      grid.near(p, reach, [&](std::uint32_t q, float d2) {
        if (q == i || !(d2 > 0)) return;
        const Vec3 d = frame.toLocal(points.positions[q] - p);
        const float flat = std::sqrt(d.x * d.x + d.y * d.y);
        if (flat > 0) near.push_back({Vec2(d.x, d.y) * (std::sqrt(d2) / flat), d2, q});
      });
      std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
        return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.point < b.point;
      });
      Cell cell(0.5f * reach);
      float reach2 = cell.reach2();
      for (const Near& n : near) {
        if (0.25f * n.distance2 >= reach2) break;
        if (!test.sameSheet(p, points.triangle[i], points.positions[n.point], points.triangle[n.point]))
          continue;
        cell.cut(n);
        reach2 = cell.reach2();
      }
      std::uint32_t size = 0;
      for (const std::uint32_t owner : cell.owners())
        if (owner != kNowhere) tile.list.push_back(owner), ++size;
      tile.counts.push_back(size);
      const Vec2 c = cell.centre();
      result.toCentre[i] = c.x * frame.tangent + c.y * frame.bitangent;
    }
  });
  result.rings = symmetric(tiles, count);
  return result;
}

}  // namespace prt
