#include "libprt/atlas/stretch.h"

#include "libprt/atlas/orientation.h"

#include <algorithm>
#include <limits>

namespace prt {

TriangleStretch triangleStretch(const std::array<DVec3, 3>& q, const std::array<DVec2, 3>& p) {
  const double area2 = signedArea2(p[0], p[1], p[2]);
  if (!(area2 > 0)) return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const DVec3 s = (q[0] * (p[1].y - p[2].y) + q[1] * (p[2].y - p[0].y) + q[2] * (p[0].y - p[1].y)) / area2;
  const DVec3 t = (q[0] * (p[2].x - p[1].x) + q[1] * (p[0].x - p[2].x) + q[2] * (p[1].x - p[0].x)) / area2;
  const double a = dot(s, s), b = dot(s, t), c = dot(t, t);
  return {std::sqrt(0.5 * (a + c)), std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)))};
}

StretchSum& StretchSum::operator+=(const StretchSum& other) {
  squares += other.squares;
  area += other.area;
  flatArea += other.flatArea;
  worst = std::max(worst, other.worst);
  return *this;
}

StretchSum StretchSum::scaled(double factor) const {
  return {squares / (factor * factor), area, flatArea * factor * factor, worst / factor};
}

void addStretch(StretchSum& sum, const std::array<DVec3, 3>& q, const std::array<DVec2, 3>& p) {
  const TriangleStretch stretch = triangleStretch(q, p);
  const double area = 0.5 * glm::length(glm::cross(q[1] - q[0], q[2] - q[0]));
  sum.area += area;
  sum.flatArea += 0.5 * std::max(0.0, signedArea2(p[0], p[1], p[2]));
  if (area > 0) {
    sum.squares += stretch.l2 * stretch.l2 * area;
    sum.worst = std::max(sum.worst, stretch.lInf);
  }
}

StretchSum stretchOf(std::span<const DVec3> positions, std::span<const DVec2> uv,
                     std::span<const UVec3> triangles) {
  StretchSum sum;
  for (const UVec3& t : triangles)
    addStretch(sum, {positions[t.x], positions[t.y], positions[t.z]}, {uv[t.x], uv[t.y], uv[t.z]});
  return sum;
}

}  // namespace prt
