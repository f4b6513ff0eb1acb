#include "libprt/synthesis/surface_point.h"

#include <algorithm>

namespace prt {
namespace {

struct Corners {
  DVec3 p[3];
  Corners(const Surface& surface, std::uint32_t t) {
    for (int i = 0; i < 3; ++i) p[i] = DVec3(surface.positions[surface.triangles[t][i]]);
  }
};

/// How weights of all three corners change along a vector in the plane of a triangle; false without area.
bool weightsAlong(const Corners& c, const DVec3& way, double (&change)[3]) {
  const DVec3 e1 = c.p[1] - c.p[0], e2 = c.p[2] - c.p[0];
  const double a = dot(e1, e1), b = dot(e1, e2), d = dot(e2, e2), det = a * d - b * b;
  if (!(det > 1e-24 * a * d)) return false;
  const double x = dot(e1, way), y = dot(e2, way);
  change[1] = (d * x - b * y) / det;
  change[2] = (a * y - b * x) / det;
  change[0] = -change[1] - change[2];
  return true;
}

/// A vector in the plane of one triangle turned about the edge into that of the next.
DVec3 turnedOver(const DVec3& way, const DVec3& edge, const DVec3& normal, const DVec3& nextNormal) {
  const DVec3 e = normalize(edge), m = cross(normalize(normal), e), next = cross(normalize(nextNormal), e);
  return dot(way, e) * e + dot(way, m) * next;
}

}  // namespace

Vec3 positionAt(const Surface& surface, const SurfacePoint& point) {
  const UVec3& t = surface.triangles[point.triangle];
  return interpolated(surface.positions[t.x], surface.positions[t.y], surface.positions[t.z],
                      point.barycentric);
}

Vec2 nearestInTriangle(const DVec3& p, const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {float(d1 / (d1 - d3)), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, float(d2 / (d2 - d6))};
  const double e = d4 - d3, f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0) return {float(f / (e + f)), float(e / (e + f))};
  const double sum = va + vb + vc;
  return sum > 0 ? Vec2(float(vb / sum), float(vc / sum)) : Vec2(0);
}

SurfacePoint walk(const Surface& surface, SurfacePoint at, const DVec3& displacement) {
  DVec3 way = displacement;
  double w[3] = {1 - double(at.barycentric.x) - double(at.barycentric.y), double(at.barycentric.x),
                 double(at.barycentric.y)};
  int entered = -1;  // the weight that is zero because the way came in over that side
  constexpr int kMostTriangles = 256;
  for (int step = 0; step < kMostTriangles; ++step) {
    const Corners c(surface, at.triangle);
    double change[3];
    if (!weightsAlong(c, way, change)) break;
    // The first weight to reach zero names the side that the way leaves by.
    int side = -1;
    double part = 1;
    for (int i = 0; i < 3; ++i)
      if (i != entered && change[i] < 0 && -w[i] / change[i] < part)
        part = std::max(0.0, -w[i] / change[i]), side = i;
    for (int i = 0; i < 3; ++i) w[i] = std::max(0.0, w[i] + part * change[i]);
    if (side < 0) break;
    w[side] = 0;
    const std::uint32_t half = 3 * at.triangle + std::uint32_t((side + 1) % 3), twin = surface.twin[half];
    if (twin == kNowhere) break;
    way = (1 - part) * way;
    const DVec3 here = surface.areaNormal(at.triangle), there = surface.areaNormal(twin / 3);
    if (!(dot(there, there) > 0)) break;
    way = turnedOver(way, c.p[(side + 2) % 3] - c.p[(side + 1) % 3], here, there);
    // The twin runs the other way: its start is our edge's end.
    const double atStart = w[(side + 1) % 3], atEnd = w[(side + 2) % 3];
    at.triangle = twin / 3;
    const int start = int(twin % 3);
    w[start] = atEnd, w[(start + 1) % 3] = atStart, w[(start + 2) % 3] = 0;
    entered = (start + 2) % 3;
  }
  const double sum = w[0] + w[1] + w[2];
  at.barycentric = Vec2(float(w[1] / sum), float(w[2] / sum));
  return at;
}

SurfaceSheets::SurfaceSheets(const Surface& s) : surface(s) {
  normal.reserve(s.triangleCount());
  for (std::uint32_t t = 0; t < s.triangleCount(); ++t) {
    const DVec3 n = s.areaNormal(t);
    const double size = length(n);
    normal.push_back(size > 0 ? Vec3(n / size) : Vec3(0));
  }
  component.assign(s.triangleCount(), kNowhere);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0, count = 0; seed < s.triangleCount(); ++seed) {
    if (component[seed] != kNowhere) continue;
    component[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::uint32_t half = 3 * t; half < 3 * t + 3; ++half)
        if (const std::uint32_t twin = s.twin[half]; twin != kNowhere && component[twin / 3] == kNowhere) {
          component[twin / 3] = count;
          stack.push_back(twin / 3);
        }
    }
    ++count;
  }
}

SheetTest::SheetTest(const SurfaceSheets& sheets)
    : sheets_(sheets), mark_(sheets.surface.triangleCount(), 0) {}

bool SheetTest::sameSheet(const Vec3& p, std::uint32_t a, const Vec3& q, std::uint32_t b) {
  if (a == b) return true;
  if (sheets_.component[a] != sheets_.component[b]) return false;
  // Level ground: the way between them lies in both planes.
  const Vec3 way = q - p, &n = sheets_.normal[a], &m = sheets_.normal[b];
  const float distance = length(way);
  if (dot(n, m) > 0.95f && std::abs(dot(way, n)) <= 0.1f * distance &&
      std::abs(dot(way, m)) <= 0.1f * distance)
    return true;
  return connected(p, a, b, 1.5f * distance);
}

bool SheetTest::connected(const Vec3& p, std::uint32_t from, std::uint32_t to, float radius) {
  const Surface& s = sheets_.surface;
  ++stamp_;
  queue_.assign(1, from);
  mark_[from] = stamp_;
  constexpr std::size_t kMostTriangles = 4096;
  for (std::size_t i = 0; i < queue_.size() && queue_.size() < kMostTriangles; ++i)
    for (std::uint32_t half = 3 * queue_[i]; half < 3 * queue_[i] + 3; ++half) {
      const std::uint32_t twin = s.twin[half];
      if (twin == kNowhere) continue;
      const std::uint32_t t = twin / 3;
      if (t == to) return true;
      if (mark_[t] == stamp_) continue;
      mark_[t] = stamp_;
      const Corners c(s, t);
      const Vec3 nearest = positionAt(s, {t, nearestInTriangle(DVec3(p), c.p[0], c.p[1], c.p[2])});
      if (distance(nearest, p) <= radius) queue_.push_back(t);
    }
  return false;
}

}  // namespace prt
