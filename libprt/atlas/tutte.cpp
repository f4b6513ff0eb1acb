#include "libprt/atlas/tutte.h"

#include "libprt/core/error.h"

#include <algorithm>

namespace prt {
namespace {

std::vector<double> cotangentWeights(const FlatChart& chart) {
  std::vector<double> weights(chart.edges.size(), 0.0);
  for (std::size_t t = 0; t < chart.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const UVec3& c = chart.triangles[t];
      const DVec3 a = chart.positions[c[i]] - chart.positions[c[(i + 2) % 3]];
      const DVec3 b = chart.positions[c[(i + 1) % 3]] - chart.positions[c[(i + 2) % 3]];
      const double sine = glm::length(glm::cross(a, b));
      weights[chart.edgeOf[t][i]] += 0.5 * std::clamp(sine > 0 ? glm::dot(a, b) / sine : 10.0, -10.0, 10.0);
    }
  for (double& w : weights) w = std::clamp(w, 0.1, 10.0);
  return weights;
}

}  // namespace

TutteMap::TutteMap(const FlatChart& chart, bool uniform, Job& job)
    : chart_(chart),
      weights_(uniform ? std::vector<double>(chart.edges.size(), 1.0) : cotangentWeights(chart)),
      unknown_(chart.positions.size(), 0) {
  for (std::uint32_t v : chart.rim) unknown_[v] = kNowhere;
  std::uint32_t count = 0;
  for (std::uint32_t& u : unknown_)
    if (u != kNowhere) u = count++;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> inner;
  std::vector<std::uint32_t> innerEdges;
  for (std::uint32_t e = 0; e < chart.edges.size(); ++e) {
    const auto [a, b] = chart.edges[e];
    if (unknown_[a] == kNowhere || unknown_[b] == kNowhere) continue;
    inner.emplace_back(unknown_[a], unknown_[b]);
    innerEdges.push_back(e);
  }
  solver_ = std::make_unique<SparseCholesky<1>>(count, inner, job);
  for (std::size_t i = 0; i < inner.size(); ++i) solver_->addEdge(i, {-weights_[innerEdges[i]]});
  for (std::size_t e = 0; e < chart.edges.size(); ++e)
    for (std::uint32_t v : {chart.edges[e].first, chart.edges[e].second})
      if (unknown_[v] != kNowhere) solver_->addDiagonal(unknown_[v], {weights_[e]});
  solver_->factorise(job);
}

std::vector<DVec2> TutteMap::map(const std::vector<DVec2>& boundary) const {
  std::vector<DVec2> uv(unknown_.size(), DVec2(0));
  for (std::size_t i = 0; i < chart_.rim.size(); ++i) uv[chart_.rim[i]] = boundary[i];
  std::vector<std::array<double, 1>> sides[2];
  const auto count = std::size_t(
      std::count_if(unknown_.begin(), unknown_.end(), [](std::uint32_t u) { return u != kNowhere; }));
  for (auto& side : sides) side.assign(count, {0.0});
  for (std::size_t e = 0; e < chart_.edges.size(); ++e) {
    const auto [a, b] = chart_.edges[e];
    for (const auto& [inner, fixed] : {std::pair(a, b), std::pair(b, a)})
      if (unknown_[inner] != kNowhere && unknown_[fixed] == kNowhere)
        for (int k = 0; k < 2; ++k) sides[k][unknown_[inner]][0] += weights_[e] * uv[fixed][k];
  }
  for (int k = 0; k < 2; ++k) {
    solver_->solve(sides[k]);
    for (std::size_t v = 0; v < uv.size(); ++v)
      if (unknown_[v] != kNowhere) uv[v][k] = sides[k][unknown_[v]][0];
  }
  return uv;
}

std::vector<DVec2> boundaryOnCircle(const FlatChart& chart) {
  double total = 0;
  for (double length : chart.rimLengths) total += length;
  const double radius = std::sqrt(chart.area / kPi);
  // No edge shorter than a hundredth of the mean, so that all points are apart.
  const double least = 0.01 * total / double(chart.rim.size());
  total = 0;
  for (double length : chart.rimLengths) total += std::max(length, least);
  std::vector<DVec2> points;
  double at = 0;
  for (double length : chart.rimLengths) {
    const double angle = 2 * kPi * at / total;
    points.push_back(radius * DVec2(std::cos(angle), std::sin(angle)));
    at += std::max(length, least);
  }
  return points;
}

std::vector<bool> sidesToBow(const FlatChart& chart, std::span<const std::uint32_t> corners) {
  const std::size_t count = corners.size();
  // Sides that each boundary vertex is on: a corner is on two.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides(chart.positions.size(), {kNowhere, kNowhere});
  std::vector<std::uint32_t> place(chart.positions.size(), kNowhere);
  for (std::uint32_t i = 0; i < chart.rim.size(); ++i) {
    place[chart.rim[i]] = i;
    auto side = std::uint32_t(std::upper_bound(corners.begin(), corners.end(), i) - corners.begin());
    side = side == 0 ? std::uint32_t(count - 1) : side - 1;
    sides[chart.rim[i]] = {side, kNowhere};
    if (corners[side] == i) sides[chart.rim[i]].second = std::uint32_t((side + count - 1) % count);
  }
  std::vector<bool> bow(count, false);
  for (const auto& [a, b] : chart.edges) {
    if (place[a] == kNowhere || place[b] == kNowhere) continue;
    const std::uint32_t step =
        (place[b] + std::uint32_t(chart.rim.size()) - place[a]) % std::uint32_t(chart.rim.size());
    if (step == 1 || step + 1 == chart.rim.size()) continue;  // along the boundary itself
    for (std::uint32_t s : {sides[a].first, sides[a].second})
      if (s != kNowhere && (s == sides[b].first || s == sides[b].second)) bow[s] = true;
  }
  return bow;
}

std::vector<DVec2> bijectiveMap(const FlatChart& chart, const std::vector<DVec2>& boundary,
                                const std::string& name, Job& job) {
  std::size_t left = 0;
  for (const bool uniform : {false, true}) {
    std::vector<DVec2> uv = TutteMap(chart, uniform, job).map(boundary);
    left = flippedTriangles(chart, uv).size();
    if (left == 0) return uv;
  }
  throw GeometryError(std::to_string(left) + " of " + std::to_string(chart.triangles.size()) +
                          " triangles cannot be kept from collapsing: it is too deep for its boundary",
                      name, "cut it further, along its length");
}

}  // namespace prt
