#include "libprt/mesh/generate.h"
#include "libprt/mesh/generate_check.h"
#include "libprt/mesh/generate_grid.h"

#include <algorithm>

namespace prt {
namespace {

/// Catmull-Rom spline through control points, sampled densely; the ends are repeated.
std::vector<DVec2> spline(const std::vector<DVec2>& controls, int samplesPerSpan) {
  std::vector<DVec2> line;
  const int last = int(controls.size()) - 1;
  const auto at = [&](int i) { return controls[std::clamp(i, 0, last)]; };
  for (int span = 0; span < last; ++span)
    for (int k = 0; k < samplesPerSpan; ++k) {
      const double t = double(k) / samplesPerSpan;
      const DVec2 a = at(span - 1), b = at(span), c = at(span + 1), d = at(span + 2);
      line.push_back(b +
                     0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
    }
  line.push_back(controls.back());
  return line;
}

/// Outer wall from the edge of the foot to the lip, for a height of 1.
std::vector<DVec2> outerWall(const VaseOptions& o) {
  const double belly = o.belly, neck = o.neck;
  const double foot = 0.62 * belly, lip = std::max(1.55 * neck, neck + 0.04);
  return spline({{foot, 0.0},
                 {foot * 0.97, 0.035},
                 {foot * 0.93, 0.075},
                 {belly * 0.84, 0.20},
                 {belly, 0.40},
                 {belly * 0.86, 0.57},
                 {neck + 0.30 * (belly - neck), 0.72},
                 {neck, 0.84},
                 {neck + 0.25 * (lip - neck), 0.92},
                 {lip, 0.985}},
                24);
}

/// Unit normal on the right of a polyline at a point.
DVec2 rightNormal(const std::vector<DVec2>& line, std::size_t i) {
  const DVec2 along = line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
  return normalize(DVec2(along.y, -along.x));
}

/// The whole profile: up the outside, round the lip, down the inside to the floor's centre.
std::vector<DVec2> wholeProfile(const VaseOptions& o) {
  const std::vector<DVec2> outer = outerWall(o);
  const double half = 0.5 * o.thickness, floor = 0.05 + o.thickness;
  std::vector<DVec2> line{{0.0, 0.012}, {outer[0].x * 0.75, 0.012}, {outer[0].x * 0.9, 0.0}};  // hollow foot
  line.insert(line.end(), outer.begin(), outer.end());

  const DVec2 lipNormal = rightNormal(outer, outer.size() - 1), lipUp(-lipNormal.y, lipNormal.x);
  const DVec2 lipCenter = outer.back() - half * lipNormal;
  for (int i = 1; i < 8; ++i) {
    const double angle = kPi * i / 8;
    line.push_back(lipCenter + half * (std::cos(angle) * lipNormal + std::sin(angle) * lipUp));
  }
  DVec2 last = lipCenter;
  for (std::size_t i = outer.size(); i-- > 0;) {
    const DVec2 inner = outer[i] - 2 * half * rightNormal(outer, i);
    if (inner.y < floor) break;
    line.push_back(inner);
    last = inner;
  }
  line.push_back({0.85 * last.x, floor});
  line.push_back({0.0, floor});
  return line;
}

/// `count` + 1 points at equal arc length along a polyline.
std::vector<DVec2> resampled(const std::vector<DVec2>& line, int count) {
  std::vector<double> lengthTo{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    lengthTo.push_back(lengthTo.back() + distance(line[i], line[i - 1]));
  std::vector<DVec2> points;
  std::size_t span = 1;
  for (int k = 0; k <= count; ++k) {
    const double target = lengthTo.back() * k / count;
    while (span + 1 < line.size() && lengthTo[span] < target) ++span;
    const double t = (target - lengthTo[span - 1]) / (lengthTo[span] - lengthTo[span - 1]);
    points.push_back(mix(line[span - 1], line[span], t));
  }
  points.front().x = points.back().x = 0;
  return points;
}

/// Rounds the corners of a dense polyline whose ends lie on the axis: they slide along it.
void smooth(std::vector<DVec2>& line, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<DVec2> next = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      next[i] = 0.25 * (line[i - 1] + 2.0 * line[i] + line[i + 1]);
    next.front().y = 0.5 * (line[0].y + line[1].y);
    next.back().y = 0.5 * (line[line.size() - 1].y + line[line.size() - 2].y);
    line = std::move(next);
  }
}

}  // namespace

TriMesh makeVase(const VaseOptions& options) {
  requireLength("height", options.height);
  requireRange("belly", options.belly, 0.1f, 1.0f);
  requireRange("neck", options.neck, 0.05f, options.belly);
  requireRange("thickness", options.thickness, 0.005f, 0.04f);
  requireRange("segments", options.segments, 3, 4096);
  requireRange("rings", options.rings, 24, 4096);

  std::vector<DVec2> dense = resampled(wholeProfile(options), 1200);
  smooth(dense, 24);
  std::vector<DVec2> line = resampled(dense, options.rings);
  double low = line[0].y, high = line[0].y;
  for (const DVec2& p : line) low = std::min(low, p.y), high = std::max(high, p.y);
  const double scale = options.height / (high - low);
  for (DVec2& p : line) p = scale * (p - DVec2(0, low));

  std::vector<ProfilePoint> profile;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool pole = i == 0 || i + 1 == line.size();
    const DVec2 normal = pole ? DVec2(0, i == 0 ? -1 : 1) : rightNormal(line, i);
    profile.push_back({line[i], normal, double(i) / (line.size() - 1)});
  }
  return revolve(profile, options.segments);
}

}  // namespace prt
