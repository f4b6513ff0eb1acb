#include "libprt/atlas/arap.h"

#include "libprt/atlas/sparse_cholesky.h"

#include <algorithm>

namespace prt {
namespace {

struct Triangle {
  DVec2 rest[3];     // edge from corner i to the next, laid flat
  double weight[3];  // half the cotangent opposite of that edge
};

std::vector<Triangle> layFlat(const FlatChart& chart) {
  std::vector<Triangle> flat;
  flat.reserve(chart.triangles.size());
  for (const UVec3& t : chart.triangles) {
    const DVec3 e1 = chart.positions[t.y] - chart.positions[t.x],
                e2 = chart.positions[t.z] - chart.positions[t.x];
    const double base = std::max(glm::length(e1), 1e-150);
    const DVec2 p1(base, 0), p2(glm::dot(e1, e2) / base, glm::length(glm::cross(e1, e2)) / base);
    Triangle triangle{{p1, p2 - p1, -p2}, {}};
    for (int i = 0; i < 3; ++i) {
      const DVec2 a = -triangle.rest[(i + 1) % 3], b = triangle.rest[(i + 2) % 3];
      const double sine = std::abs(a.x * b.y - a.y * b.x), cosine = dot(a, b);
      triangle.weight[i] = 0.5 * std::clamp(sine > 0 ? cosine / sine : 20.0, 0.02, 20.0);
    }
    flat.push_back(triangle);
  }
  return flat;
}

}  // namespace

std::vector<DVec2> asRigidAsPossible(const FlatChart& chart, std::vector<DVec2> uv, int rounds, Job& job) {
  const std::vector<Triangle> flat = layFlat(chart);
  SparseCholesky<1> solver(chart.positions.size(), chart.edges, job);
  double total = 0;
  for (std::size_t t = 0; t < flat.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const double w = flat[t].weight[i];
      solver.edgeBlock(chart.edgeOf[t][i])[0] -= w;
      solver.addDiagonal(chart.triangles[t][i], {w});
      solver.addDiagonal(chart.triangles[t][(i + 1) % 3], {w});
      total += w;
    }
  const double hold = 1e-8 * total / double(chart.positions.size());  // holds the map in its place
  for (std::uint32_t v = 0; v < chart.positions.size(); ++v) solver.addDiagonal(v, {hold});
  if (!solver.factorise(job)) return uv;
  std::vector<std::array<double, 1>> sides[2];
  for (int round = 0; round < rounds; ++round) {
    job.checkCancelled();
    for (int k = 0; k < 2; ++k) {
      sides[k].resize(uv.size());
      for (std::size_t v = 0; v < uv.size(); ++v) sides[k][v][0] = hold * uv[v][k];
    }
    for (std::size_t t = 0; t < flat.size(); ++t) {
      const UVec3& c = chart.triangles[t];
      // The turn that fits the edges best.
      double cosine = 0, sine = 0;
      for (int i = 0; i < 3; ++i) {
        const DVec2 now = uv[c[(i + 1) % 3]] - uv[c[i]], &rest = flat[t].rest[i];
        cosine += flat[t].weight[i] * dot(rest, now);
        sine += flat[t].weight[i] * (rest.x * now.y - rest.y * now.x);
      }
      const double norm = std::hypot(cosine, sine);
      if (norm > 0)
        cosine /= norm, sine /= norm;
      else
        cosine = 1, sine = 0;
      for (int i = 0; i < 3; ++i) {
        const DVec2& rest = flat[t].rest[i];
        const DVec2 edge =
            flat[t].weight[i] * DVec2(cosine * rest.x - sine * rest.y, sine * rest.x + cosine * rest.y);
        for (int k = 0; k < 2; ++k) {
          sides[k][c[(i + 1) % 3]][0] += edge[k];
          sides[k][c[i]][0] -= edge[k];
        }
      }
    }
    for (int k = 0; k < 2; ++k) {
      solver.solve(sides[k]);
      for (std::size_t v = 0; v < uv.size(); ++v) uv[v][k] = sides[k][v][0];
    }
  }
  return uv;
}

}  // namespace prt
