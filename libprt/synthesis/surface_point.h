#pragma once
// Points of a surface, straight ways over it, and which points lie on the same sheet.

#include "libprt/atlas/surface.h"

#include <vector>

namespace prt {

/// A point of a triangle; the weights of its corners are (1 - x - y, x, y).
struct SurfacePoint {
  std::uint32_t triangle = 0;
  Vec2 barycentric{0};
};

/// Sum of the corners' values times their weights.
template <class V>
V interpolated(const V& a, const V& b, const V& c, const Vec2& barycentric) {
  using T = typename V::value_type;
  const T x = T(barycentric.x), y = T(barycentric.y);
  return (1 - x - y) * a + x * b + y * c;
}

Vec3 positionAt(const Surface& surface, const SurfacePoint& point);

/// Weights of corners 1 and 2 of the point of a triangle nearest to p (Ericson 2005, 5.1.5: by regions).
Vec2 nearestInTriangle(const DVec3& p, const DVec3& a, const DVec3& b, const DVec3& c);

/// Goes straight ahead by `way`, a vector in the triangle's plane (other parts of it are left out), and on
/// over edges as if the triangles were laid flat. Ends early at a border, or where a triangle has no area.
SurfacePoint walk(const Surface& surface, SurfacePoint from, const DVec3& way);

/// Facts about triangles that neighbourhoods ask for again and again.
struct SurfaceSheets {
  explicit SurfaceSheets(const Surface& surface);
  const Surface& surface;
  std::vector<Vec3> normal;              ///< [F] unit; 0 where a triangle has no area
  std::vector<std::uint32_t> component;  ///< [F] pieces that hang together by edges
};

/// Tells near points of one sheet from points of another that lies close by: the far side of a thin plate, a
/// leaf on top. Two points are on one sheet when triangles lead from one to the other inside a ball of 1.5
/// times their distance. Holds scratch memory: one per thread.
class SheetTest {
 public:
  explicit SheetTest(const SurfaceSheets& sheets);
  bool sameSheet(const Vec3& p, std::uint32_t triangleOfP, const Vec3& q, std::uint32_t triangleOfQ);

 private:
  bool connected(const Vec3& p, std::uint32_t from, std::uint32_t to, float radius);

  const SurfaceSheets& sheets_;
  std::vector<std::uint32_t> mark_, queue_;
  std::uint32_t stamp_ = 0;
};

}  // namespace prt
