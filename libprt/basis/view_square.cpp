#include "libprt/basis/view_square.h"

#include "libprt/core/error.h"
#include "libprt/core/warp.h"

#include <string>

namespace prt {

Vec3 viewFromSquare(const Vec2& p) {
  const Vec2 disc = sampleConcentricDisc(p);
  const float r2 = std::min(1.0f, dot(disc, disc)), scale = std::sqrt(2 - r2);
  return {disc.x * scale, disc.y * scale, 1 - r2};
}

Vec2 squareFromView(const Vec3& d) {
  Vec2 flat(d.x, d.y);
  if (d.z < 0) flat /= std::max(length(flat), 1e-20f);
  return clamp(inverseConcentricDisc(flat / std::sqrt(1 + std::max(0.0f, d.z))), Vec2(0), Vec2(1));
}

ViewSquare::ViewSquare(int side) : side_(side) {
  if (side < 1 || side > 256)
    throw ValueError("cannot keep " + std::to_string(side) + " views a side", "views", "use 1 to 256");
}

Vec3 ViewSquare::centre(int index) const {
  return viewFromSquare((Vec2(float(index % side_), float(index / side_)) + 0.5f) / float(side_));
}

int ViewSquare::nearest(const Vec3& d) const {
  const Vec2 p = squareFromView(d) * float(side_);
  return std::min(int(p.y), side_ - 1) * side_ + std::min(int(p.x), side_ - 1);
}

std::array<ViewSquare::Corner, 4> ViewSquare::bilinear(const Vec3& d) const {
  const Vec2 p = clamp(squareFromView(d) * float(side_) - 0.5f, Vec2(0), Vec2(float(side_ - 1)));
  const int x = std::min(int(p.x), std::max(0, side_ - 2)), y = std::min(int(p.y), std::max(0, side_ - 2));
  const int right = std::min(x + 1, side_ - 1), up = std::min(y + 1, side_ - 1);
  const float fx = p.x - float(x), fy = p.y - float(y);
  return {{{y * side_ + x, (1 - fx) * (1 - fy)},
           {y * side_ + right, fx * (1 - fy)},
           {up * side_ + x, (1 - fx) * fy},
           {up * side_ + right, fx * fy}}};
}

}  // namespace prt
