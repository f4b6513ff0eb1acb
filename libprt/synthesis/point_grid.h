#pragma once
// Points in cells of a grid without bounds: which points lie near a place. Cells far from each other may
// share a bucket, so callers check distances.

#include "libprt/core/math.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Cell coordinates and buckets. Cells that are neighbours along x are neighbouring buckets.
class CellBuckets {
 public:
  /// About as many buckets as `points`, at least 8 along each axis.
  CellBuckets(float cell, std::size_t points) : scale_(1 / cell) {
    const int bits = std::max(9, int(std::bit_width(points)));
    bitsX_ = (bits + 2) / 3, bitsY_ = (bits + 1) / 3, bitsZ_ = bits / 3;
  }
  std::size_t count() const { return std::size_t{1} << (bitsX_ + bitsY_ + bitsZ_); }
  std::uint32_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return std::uint32_t((x & mask(bitsX_)) | (y & mask(bitsY_)) << bitsX_ |
                         (z & mask(bitsZ_)) << (bitsX_ + bitsY_));
  }
  std::array<std::int64_t, 3> cell(const Vec3& p) const {
    return {std::int64_t(std::floor(double(p.x) * double(scale_))),
            std::int64_t(std::floor(double(p.y) * double(scale_))),
            std::int64_t(std::floor(double(p.z) * double(scale_)))};
  }
  std::uint32_t bucketOf(const Vec3& p) const {
    const auto c = cell(p);
    return bucket(c[0], c[1], c[2]);
  }
  /// Calls visit(bucket) for the cells at and around p, `rings` to each side; stops when it returns true.
  template <class Visit>
  bool around(const Vec3& p, const Visit& visit, std::int64_t rings = 1) const {
    const auto c = cell(p);
    for (std::int64_t z = c[2] - rings; z <= c[2] + rings; ++z)
      for (std::int64_t y = c[1] - rings; y <= c[1] + rings; ++y)
        for (std::int64_t x = c[0] - rings; x <= c[0] + rings; ++x)
          if (visit(bucket(x, y, z))) return true;
    return false;
  }

 private:
  static std::int64_t mask(int bits) { return (std::int64_t{1} << bits) - 1; }

  float scale_;
  int bitsX_ = 2, bitsY_ = 2, bitsZ_ = 2;
};

/// Points sorted into buckets, for any number of readers. The points must outlive the grid.
class PointGrid {
 public:
  /// `cell`: the distance up to which neighbours will be asked for.
  PointGrid(std::span<const Vec3> points, float cell)
      : points_(points), cell_(cell), buckets_(cell, points.size()) {
    start_.assign(buckets_.count() + 1, 0);
    for (const Vec3& p : points) ++start_[buckets_.bucketOf(p) + 1];
    for (std::size_t b = 0; b < buckets_.count(); ++b) start_[b + 1] += start_[b];
    std::vector<std::uint32_t> fill(start_.begin(), start_.end() - 1);
    list_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) list_[fill[buckets_.bucketOf(points[i])]++] = i;
  }
  /// Calls visit(index, distance squared) for the points nearer to p than `radius`, at most three cells. Each
  /// comes once: the grid is at least eight buckets wide, and so the cells looked at are different buckets.
  template <class Visit>
  void near(const Vec3& p, float radius, const Visit& visit) const {
    const float most = radius * radius;
    buckets_.around(
        p,
        [&](std::uint32_t b) {
          for (std::uint32_t k = start_[b]; k < start_[b + 1]; ++k) {
            const Vec3 d = points_[list_[k]] - p;
            if (const float d2 = dot(d, d); d2 < most) visit(list_[k], d2);
          }
          return false;
        },
        std::clamp<std::int64_t>(std::int64_t(std::ceil(radius / cell_ - 1e-4f)), 1, 3));
  }

 private:
  std::span<const Vec3> points_;
  float cell_;
  CellBuckets buckets_;
  std::vector<std::uint32_t> start_, list_;
};

}  // namespace prt
