#pragma once
// The upper hemisphere on a square, for tables over view directions: Shirley and Chiu's concentric map from
// the square to the disc, then z = 1 - r^2. Equal areas stay equal: a square of side s holds 2 pi s^2
// steradians. The border of the square is the horizon, its centre the zenith; opposite borders have nothing
// to do with each other, so lookups clamp and never wrap. The map turns with the square: a quarter turn of
// the one is a quarter turn of the other about +z. Continuous, with creases along the diagonals.

#include "libprt/core/math.h"

#include <array>

namespace prt {

/// Unit direction, z >= 0, of a point of the unit square.
Vec3 viewFromSquare(const Vec2& p);
/// The reverse; a direction below the horizon counts as lying on it.
Vec2 squareFromView(const Vec3& d);

/// A table of side x side cells on the square; values stand for the cells' centres. View (x, y) has the
/// index y * side + x.
class ViewSquare {
 public:
  /// Throws ValueError unless side is 1..256.
  explicit ViewSquare(int side);

  int side() const { return side_; }
  int count() const { return side_ * side_; }
  /// Direction of a cell's centre.
  Vec3 centre(int index) const;
  /// Solid angle of every cell.
  double solidAngle() const { return 2 * kPi / count(); }
  /// The cell that a direction falls into.
  int nearest(const Vec3& d) const;

  /// Up to four cells and weights that add up to 1: bilinear between centres; beyond the outermost centres
  /// values go on as they are.
  struct Corner {
    int index;
    float weight;
  };
  std::array<Corner, 4> bilinear(const Vec3& d) const;

 private:
  int side_;
};

}  // namespace prt
