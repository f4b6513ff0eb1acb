#include "libprt/synthesis/surface_darts.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/synthesis/point_grid.h"

#include <algorithm>

namespace prt {
namespace {

constexpr int kDartsPerPoint = 6;
constexpr float kFirstGuess = 0.80f;  // radius / root of the area of a point, before it is measured

/// The darts, evenly spread over the area by their numbers.
class DartSource {
 public:
  DartSource(const Surface& surface, std::size_t count, std::uint64_t seed) : surface_(surface), seed_(seed) {
    const std::size_t darts = std::max<std::size_t>(count, 2);
    triangle_.resize(darts);
    const double total = surface.totalArea();
    double sum = 0;
    std::uint32_t t = 0;
    double end = surface.area(0);
    for (std::size_t i = 0; i < darts; ++i) {
      const double at = (double(i) + double(hashUniform(seed, i, 2))) / double(darts) * total;
      while (t + 1 < surface.triangleCount() && at >= end) sum = end, end = sum + surface.area(++t);
      triangle_[i] = t;
    }
  }
  std::size_t size() const { return triangle_.size(); }
  /// Darts of a level: every 4^level-th.
  std::size_t sizeOf(int level) const { return (size() + stride(level) - 1) / stride(level); }
  /// Calls throwDart(id) for the darts of a level: in rounds, each spread evenly over the area, and inside a
  /// round from triangle to triangle, so that what is looked at lies together in memory.
  template <class Throw>
  void forEach(int level, const Throw& throwDart) const {
    const std::size_t count = sizeOf(level);
    for (std::size_t round = 0; round < kRounds; ++round)
      for (std::size_t i = kOrder[round]; i < count; i += kRounds) throwDart(i * stride(level));
  }
  SurfacePoint point(std::uint64_t id) const {
    float a = hashUniform(seed_, id, 0), b = hashUniform(seed_, id, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    return {triangle_[id], {a, b}};
  }

 private:
  static constexpr std::size_t kRounds = 16;
  static constexpr std::size_t kOrder[kRounds] = {0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};
  static std::size_t stride(int level) { return std::size_t{1} << (2 * level); }

  const Surface& surface_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> triangle_;
};

/// The points kept so far, in a grid of lists.
class Board {
 public:
  Board(const SurfaceSheets& sheets, float radius, std::size_t expected)
      : radius_(radius), buckets_(radius, expected), head_(buckets_.count(), kNowhere), test_(sheets) {}

  bool isFree(const Vec3& p, std::uint32_t triangle) {
    return !buckets_.around(p, [&](std::uint32_t b) {
      for (std::uint32_t i = head_[b]; i != kNowhere; i = kept_[i].next) {
        const Vec3 d = kept_[i].position - p;
        if (dot(d, d) < radius_ * radius_ &&
            test_.sameSheet(p, triangle, kept_[i].position, kept_[i].triangle))
          return true;
      }
      return false;
    });
  }
  void add(const Vec3& p, std::uint32_t triangle) {
    std::uint32_t& head = head_[buckets_.bucketOf(p)];
    kept_.push_back({p, triangle, head});
    head = std::uint32_t(kept_.size() - 1);
  }

 private:
  struct Kept {
    Vec3 position;
    std::uint32_t triangle, next;
  };
  float radius_;
  CellBuckets buckets_;
  std::vector<std::uint32_t> head_;
  std::vector<Kept> kept_;
  SheetTest test_;
};

/// Points of a surface in Morton order, which keeps neighbours close in memory.
void sortAlongCurve(const Surface& surface, std::span<SurfacePoint> points, const Vec3& low, float extent) {
  const auto spread = [](std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  };
  std::vector<std::pair<std::uint64_t, SurfacePoint>> keyed;
  keyed.reserve(points.size());
  for (const SurfacePoint& point : points) {
    const Vec3 p = (positionAt(surface, point) - low) * (2097151.0f / extent);
    keyed.emplace_back(
        spread(std::uint64_t(p.x)) | spread(std::uint64_t(p.y)) << 1 | spread(std::uint64_t(p.z)) << 2,
        point);
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = keyed[i].second;
}

/// Throws the darts of every level down to `last` (0 = finest).
SurfaceDarts throwLevels(const SurfaceSheets& sheets, const DartSource& source, float radius, int levels,
                         int last, Job& job) {
  SurfaceDarts darts;
  darts.radius = radius;
  std::vector<bool> taken(source.size(), false);
  CancelCheck check(job);
  for (int level = levels - 1; level >= last; --level) {
    Board board(sheets, radius * float(1 << level), source.sizeOf(level) / kDartsPerPoint);
    for (const SurfacePoint& p : darts.points) board.add(positionAt(sheets.surface, p), p.triangle);
    source.forEach(level, [&](std::size_t id) {
      check();
      if (taken[id]) return;
      const SurfacePoint point = source.point(id);
      const Vec3 p = positionAt(sheets.surface, point);
      if (!board.isFree(p, point.triangle)) return;
      taken[id] = true;
      darts.points.push_back(point);
      board.add(p, point.triangle);
    });
    darts.levelEnd.push_back(darts.points.size());
    job.advance(double(source.sizeOf(level)));
  }
  return darts;
}

}  // namespace

SurfaceDarts throwDarts(const SurfaceSheets& sheets, std::size_t count, std::size_t coarsest,
                        std::uint64_t seed, Job& job) {
  if (count < 16 || count > 50'000'000)
    throw ValueError(std::to_string(count) + " points cannot be spread", "synthesis.vertices",
                     "use 16 to 50000000");
  const double area = sheets.surface.triangleCount() > 0 ? sheets.surface.totalArea() : 0;
  if (!(area > 0) || !std::isfinite(area))
    throw GeometryError("the surface has no area", "synthesis", "check the mesh");
  int levels = 1;
  while (count >> (2 * levels) >= std::max<std::size_t>(coarsest, 4)) ++levels;
  const DartSource source(sheets.surface, count * kDartsPerPoint, seed);
  job.begin("spreading points", double(source.size()) * 1.5, "darts");
  // How many points a radius leaves is measured on a coarse level, then the radius is set for all.
  float radius = kFirstGuess * float(std::sqrt(area / double(count)));
  const int probe = std::min(levels - 1, 2);
  for (int i = 0; i < 2; ++i) {
    const SurfaceDarts few = throwLevels(sheets, source, radius, levels, probe, job);
    radius *= float(std::sqrt(double(few.points.size()) * std::pow(4.0, probe) / double(count)));
  }
  SurfaceDarts darts = throwLevels(sheets, source, radius, levels, 0, job);
  Box3 box;
  for (const Vec3& p : sheets.surface.positions) box.extend(p);
  const Vec3 size = box.high - box.low;
  std::size_t begin = 0;
  for (const std::size_t end : darts.levelEnd) {
    sortAlongCurve(sheets.surface, std::span(darts.points).subspan(begin, end - begin), box.low,
                   std::max({size.x, size.y, size.z}));
    begin = end;
  }
  return darts;
}

}  // namespace prt
