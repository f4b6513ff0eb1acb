#include "libprt/atlas/stretch_sweep.h"

#include "libprt/atlas/orientation.h"
#include "libprt/mesh/cancel_check.h"

#include <limits>

namespace prt {
namespace {

/// What a triangle adds as a function of its first corner: squared edges opposite, and the other two corners.
/// L2^2 A' = A' / (8 A^2) * sum of |q_i| |..| terms, which in edges of the flat triangle e and inner products
/// of the space triangle is A' / (8 A^2) (|E2|^2 |e1|^2 - 2 E1.E2 e1.e2 + |E1|^2 |e2|^2).
struct Corner {
  DVec2 p1, p2;
  double e11, e12, e22, area;

  double value(const DVec2& p) const {
    const DVec2 a = p1 - p, b = p2 - p;
    const double flat = a.x * b.y - a.y * b.x;
    if (!(flat > 0)) return std::numeric_limits<double>::infinity();
    return area * (e22 * dot(a, a) - 2 * e12 * dot(a, b) + e11 * dot(b, b)) / (2 * flat * flat);
  }
  DVec2 gradient(const DVec2& p) const {
    const DVec2 a = p1 - p, b = p2 - p;
    const double flat = a.x * b.y - a.y * b.x;
    const double squares = e22 * dot(a, a) - 2 * e12 * dot(a, b) + e11 * dot(b, b);
    const DVec2 dSquares = -2.0 * (e22 * a - e12 * (a + b) + e11 * b);
    const DVec2 dFlat{a.y - b.y, b.x - a.x};
    return area / (2 * flat * flat) * (dSquares - dFlat * (2 * squares / flat));
  }
};

}  // namespace

void sweepStretch(const FlatChart& chart, std::vector<DVec2>& uv, int sweeps, Job& job) {
  const std::size_t n = chart.positions.size();
  std::vector<std::uint32_t> start(n + 1, 0), corners(3 * chart.triangles.size());
  for (const UVec3& t : chart.triangles)
    for (int i = 0; i < 3; ++i) ++start[t[i] + 1];
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) corners[fill[chart.triangles[t][int(i)]]++] = 3 * t + i;
  std::vector<bool> onRim(n, false);
  for (std::uint32_t v : chart.rim) onRim[v] = true;

  CancelCheck check(job);
  std::vector<Corner> around;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    job.checkCancelled();
    for (std::uint32_t v = 0; v < n; ++v) {
      check();
      if (onRim[v]) continue;
      around.clear();
      double shortest = std::numeric_limits<double>::infinity();
      for (std::uint32_t i = start[v]; i < start[v + 1]; ++i) {
        const UVec3& t = chart.triangles[corners[i] / 3];
        const std::uint32_t b = t[int((corners[i] + 1 - corners[i] / 3 * 3) % 3)];
        const std::uint32_t c = t[int((corners[i] + 2 - corners[i] / 3 * 3) % 3)];
        const DVec3 e1 = chart.positions[b] - chart.positions[v],
                    e2 = chart.positions[c] - chart.positions[v];
        const double area = 0.5 * glm::length(glm::cross(e1, e2));
        around.push_back({uv[b], uv[c], dot(e1, e1), dot(e1, e2), dot(e2, e2), area});
        shortest = std::min(shortest, glm::distance(uv[v], uv[b]));
      }
      double value = 0;
      DVec2 gradient(0);
      for (const Corner& corner : around) value += corner.value(uv[v]), gradient += corner.gradient(uv[v]);
      const double slope = glm::length(gradient);
      if (!(slope > 0) || !std::isfinite(slope)) continue;
      constexpr int kHalvings = 6;
      double step = 0.25 * shortest;
      for (int i = 0; i < kHalvings; ++i, step *= 0.4) {
        const DVec2 next = uv[v] - gradient * (step / slope);
        double after = 0;
        bool positive = true;
        for (const Corner& corner : around) {
          after += corner.value(next);
          positive = positive && surelyPositive(next, corner.p1, corner.p2);
        }
        if (!positive || !(after < value)) continue;
        uv[v] = next;
        break;
      }
    }
  }
}

}  // namespace prt
