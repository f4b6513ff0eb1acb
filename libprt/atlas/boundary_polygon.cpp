#include "libprt/atlas/boundary_polygon.h"

#include "libprt/atlas/orientation.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <numeric>

namespace prt {
namespace {

/// Half of the angle that a chord takes of a circle of diameter `diameter`.
double halfAngle(double chord, double diameter) {
  return std::asin(std::min(1.0, chord / diameter));
}

/// Halves of the angles of all sides, their longest measured the long way round when `outside`.
std::vector<double> halfAngles(std::span<const double> sides, double diameter, std::size_t longest,
                               bool outside) {
  std::vector<double> angles(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) angles[i] = halfAngle(sides[i], diameter);
  if (outside) angles[longest] = kPi - angles[longest];
  return angles;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Diameter for which the half angles add up to pi, by bisection (ALGORITHMS 8).
double diameterOf(std::span<const double> sides, std::size_t longest, bool outside) {
  double low = sides[longest], high = low;
  const auto tooSmall = [&](double diameter) {  // the polygon would not close yet
    const double total = sum(halfAngles(sides, diameter, longest, outside));
    return outside ? total < kPi : total > kPi;
  };
  do high *= 2;
  while (tooSmall(high) && high < 1e9 * sides[longest]);
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (tooSmall(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool onSegment(const DVec2& p, const DVec2& a, const DVec2& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segmentsMeet(const DVec2& a, const DVec2& b, const DVec2& c, const DVec2& d) {
  const double abc = signedArea2(a, b, c), abd = signedArea2(a, b, d);
  const double cda = signedArea2(c, d, a), cdb = signedArea2(c, d, b);
  if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 && cda != 0 && cdb != 0)
    return true;
  return (abc == 0 && onSegment(c, a, b)) || (abd == 0 && onSegment(d, a, b)) ||
         (cda == 0 && onSegment(a, c, d)) || (cdb == 0 && onSegment(b, c, d));
}

/// Calls found(s, t) for pairs of sides that meet, until it returns false. A pair may come twice.
template <class Found>
void meetingSides(std::span<const DVec2> polygon, const Found& found) {
  const std::size_t n = polygon.size();
  if (n < 4) return;
  DVec2 low = polygon[0], high = polygon[0];
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    low = min(low, polygon[i]), high = max(high, polygon[i]);
    total += glm::distance(polygon[i], polygon[(i + 1) % n]);
  }
  // Sides are sorted into square cells; only sides of one cell are compared.
  const double span = std::max({high.x - low.x, high.y - low.y, 1e-300});
  const double cell = std::max(1.5 * total / double(n), span / 4096);
  const auto cellOf = [&](double value) { return std::uint64_t(std::max(0.0, value / cell)); };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;
  for (std::uint32_t i = 0; i < n; ++i) {
    const DVec2 a = polygon[i] - low, b = polygon[(i + 1) % n] - low;
    const DVec2 from = min(a, b), to = max(a, b);
    for (std::uint64_t y = cellOf(from.y); y <= cellOf(to.y); ++y)
      for (std::uint64_t x = cellOf(from.x); x <= cellOf(to.x); ++x) entries.push_back({(y << 32) | x, i});
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first;
    while (last < entries.size() && entries[last].first == entries[first].first) ++last;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t j = i + 1; j < last; ++j) {
        const std::size_t s = entries[i].second, t = entries[j].second;
        if (t == s + 1 || (s == 0 && t == n - 1)) continue;
        if (segmentsMeet(polygon[s], polygon[(s + 1) % n], polygon[t], polygon[(t + 1) % n]) && !found(s, t))
          return;
      }
    first = last;
  }
}

}  // namespace

std::vector<DVec2> polygonOnCircle(std::span<const double> sides) {
  const double total = std::accumulate(sides.begin(), sides.end(), 0.0);
  const auto longest = std::size_t(std::max_element(sides.begin(), sides.end()) - sides.begin());
  if (sides.size() < 3 || !(sides[longest] < total - sides[longest]))
    throw ValueError("a polygon wants three sides or more, each shorter than the others together",
                     "chart corners", "add corners");
  const bool outside = sum(halfAngles(sides, sides[longest], longest, false)) < kPi;
  const double diameter = diameterOf(sides, longest, outside);
  const std::vector<double> angles = halfAngles(sides, diameter, longest, outside);
  // What rounding leaves of the full turn is shared out, so that the polygon closes.
  const double correction = kPi / sum(angles);
  std::vector<DVec2> corners;
  double angle = 0;
  for (double half : angles) {
    corners.push_back(0.5 * diameter * DVec2(std::cos(angle), std::sin(angle)));
    angle += 2 * half * correction;
  }
  return corners;
}

std::vector<std::uint32_t> spreadCorners(std::span<const double> lengths, int count) {
  const std::size_t n = lengths.size();
  const std::size_t wanted = std::min(n, std::size_t(std::max(count, 3)));
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<std::uint32_t> corners;
  double at = 0;
  for (std::uint32_t v = 0; v < n && corners.size() < wanted; ++v) {
    const double target = total * double(corners.size()) / double(wanted);
    const std::size_t left = n - v, missing = wanted - corners.size();
    // The vertex nearest to the target, or any when they run out.
    if (at + 0.5 * lengths[v] >= target || left <= missing) corners.push_back(v);
    at += lengths[v];
  }
  return corners;
}

std::vector<std::uint32_t> usableCorners(std::span<const double> lengths,
                                         std::vector<std::uint32_t> corners) {
  const std::size_t n = lengths.size();
  for (std::uint32_t c : corners)
    if (c >= n)
      throw ValueError("corner " + std::to_string(c) + " of a boundary of " + std::to_string(n) + " vertices",
                       "chart corners", "give corners on the boundary");
  if (corners.empty()) corners.push_back(0);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() < n) {
    double total = 0, most = -1;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t end = i + 1 < corners.size() ? corners[i + 1] : corners[0] + n;
      double side = 0;
      for (std::size_t v = corners[i]; v < end; ++v) side += lengths[v % n];
      total += side;
      if (side > most && end - corners[i] > 1) most = side, longest = i;
    }
    if (corners.size() >= 3 && most < 0.999 * (total - most)) break;
    if (most < 0) break;  // nothing left to halve
    const std::size_t first = corners[longest];
    const std::size_t end = longest + 1 < corners.size() ? corners[longest + 1] : corners[0] + n;
    std::size_t cut = first + 1;
    double half = lengths[first % n];
    while (cut + 1 < end && half + 0.5 * lengths[cut % n] < 0.5 * most) half += lengths[cut++ % n];
    corners.push_back(std::uint32_t(cut % n));
    std::sort(corners.begin(), corners.end());
  }
  return corners;
}

BoundaryPolygon layOnPolygon(std::span<const double> lengths, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& bow) {
  const std::size_t n = lengths.size(), count = corners.size();
  std::vector<double> sides(count, 0.0);
  const auto end = [&](std::size_t i) { return i + 1 < count ? corners[i + 1] : corners[0] + n; };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t v = corners[i]; v < end(i); ++v) sides[i] += lengths[v % n];
  const std::vector<DVec2> at = polygonOnCircle(sides);
  BoundaryPolygon polygon{std::vector<DVec2>(n), {corners.begin(), corners.end()}, bow};
  polygon.bowed.resize(count, false);
  constexpr double kBow = 0.02;
  for (std::size_t i = 0; i < count; ++i) {
    const DVec2 from = at[i], to = at[(i + 1) % count], along = to - from;
    const DVec2 outwards(along.y, -along.x);
    double done = 0;
    for (std::size_t v = corners[i]; v < end(i); ++v) {
      const double t = sides[i] > 0 ? done / sides[i] : 0;
      polygon.points[v % n] = from + along * t;
      if (polygon.bowed[i]) polygon.points[v % n] += outwards * (4 * kBow * t * (1 - t));
      done += lengths[v % n];
    }
  }
  return polygon;
}

bool selfIntersects(std::span<const DVec2> polygon) {
  bool meets = false;
  meetingSides(polygon, [&](std::size_t, std::size_t) {
    meets = true;
    return false;
  });
  return meets;
}

std::vector<std::uint32_t> crossingSides(std::span<const DVec2> polygon) {
  std::vector<std::uint32_t> sides;
  meetingSides(polygon, [&](std::size_t s, std::size_t t) {
    sides.push_back(std::uint32_t(s));
    sides.push_back(std::uint32_t(t));
    return true;
  });
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

}  // namespace prt
