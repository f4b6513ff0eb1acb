#include "libprt/synthesis/vertex_connection.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>

namespace prt {
namespace {

double angleBetween(const DVec3& a, const DVec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

DVec3 along(const Surface& s, std::uint32_t half) {
  return DVec3(s.positions[s.to(half)]) - DVec3(s.positions[s.from(half)]);
}

/// Cotangent weights of edges and areas of vertices.
void weigh(VertexConnection& c, Job& job) {
  const Surface& s = c.surface;
  c.weight.assign(s.edgeCount(), 0);
  c.mass.assign(s.positions.size(), 0);
  CancelCheck check(job);
  for (std::uint32_t half = 0; half < 3 * s.triangleCount(); ++half) {
    check();
    const double angle = double(c.cornerAngle[previousHalf(half)]);  // opposite to this side
    c.weight[s.edge[half]] += 0.5 / std::tan(std::clamp(angle, 0.02, kPi - 0.02));
    c.mass[s.from(half)] += s.area(half / 3) / 3;
  }
  double mean = 0;
  for (double& w : c.weight) w = std::max(w, 0.05);
  for (const double m : c.mass) mean += m / double(c.mass.size());
  for (double& m : c.mass) m = std::max(m, 1e-6 * mean);
}

void findComponents(VertexConnection& c) {
  const Surface& s = c.surface;
  c.component.assign(s.positions.size(), kNowhere);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < s.positions.size(); ++seed) {
    if (c.component[seed] != kNowhere) continue;
    c.component[seed] = c.components;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t v = stack.back();
      stack.pop_back();
      for (std::uint32_t i = s.spokeStart[v]; i < s.spokeStart[v + 1]; ++i) {
        const std::uint32_t other = s.across(s.spokes[i], v);
        if (c.component[other] == kNowhere) c.component[other] = c.components, stack.push_back(other);
      }
    }
    ++c.components;
  }
}

}  // namespace

VertexConnection::VertexConnection(const Surface& s, Job& job) : surface(s) {
  const std::uint32_t halves = std::uint32_t(3 * s.triangleCount());
  cornerAngle.resize(halves);
  for (std::uint32_t h = 0; h < halves; ++h)
    cornerAngle[h] = float(angleBetween(along(s, h), -along(s, previousHalf(h))));
  // The first half-edge of each fan: at a border the one with nothing on its right.
  std::vector<std::uint32_t> first(s.positions.size(), kNowhere);
  for (std::uint32_t h = 0; h < halves; ++h)
    if (first[s.from(h)] == kNowhere || s.twin[h] == kNowhere) first[s.from(h)] = h;
  scale.assign(s.positions.size(), 1);
  start.assign(halves, 0);
  back.assign(halves, 0);
  CancelCheck check(job);
  for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
    check();
    if (first[v] == kNowhere) continue;
    double sum = 0;
    std::uint32_t h = first[v];
    bool closed = false;
    do {  // counter-clockwise
      start[h] = sum;
      sum += double(cornerAngle[h]);
      const std::uint32_t incoming = previousHalf(h);
      back[incoming] = sum;
      h = s.twin[incoming];
      closed = h == first[v];
    } while (h != kNowhere && !closed);
    if (closed && sum > 0) scale[v] = float(2 * kPi / sum);
    h = first[v];
    do {
      start[h] *= double(scale[v]);
      back[previousHalf(h)] *= double(scale[v]);
      h = s.twin[previousHalf(h)];
    } while (h != kNowhere && h != first[v]);
  }
  weigh(*this, job);
  findComponents(*this);
}

DVec3 VertexConnection::direction(std::uint32_t corner, double angle) const {
  const Surface& s = surface;
  const DVec3 edge = along(s, corner), n = s.areaNormal(corner / 3);
  if (!(dot(edge, edge) > 0) || !(dot(n, n) > 0)) return DVec3(0);
  const double turn = std::remainder(angle - start[corner], 2 * kPi) / double(scale[s.from(corner)]);
  const DVec3 x = normalize(edge), y = cross(normalize(n), x);
  return std::cos(turn) * x + std::sin(turn) * y;
}

double VertexConnection::angleOf(std::uint32_t corner, const DVec3& vector) const {
  const Surface& s = surface;
  const DVec3 edge = along(s, corner), n = s.areaNormal(corner / 3);
  if (!(dot(edge, edge) > 0) || !(dot(n, n) > 0)) return start[corner];
  const DVec3 x = normalize(edge), y = cross(normalize(n), x);
  return start[corner] + std::atan2(dot(vector, y), dot(vector, x)) * double(scale[s.from(corner)]);
}

double VertexConnection::curvature(std::uint32_t t) const {
  double sum = -kPi;
  for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c)
    sum += double(cornerAngle[c]) * double(scale[surface.from(c)]);
  return sum;
}

}  // namespace prt
