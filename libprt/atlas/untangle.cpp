#include "libprt/atlas/untangle.h"

#include "libprt/atlas/boundary_polygon.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>

namespace prt {
namespace {

class Untangler {
 public:
  Untangler(const FlatChart& chart, std::vector<DVec2>& uv, Job& job)
      : chart_(chart),
        uv_(uv),
        check_(job),
        start_(uv.size() + 1, 0),
        neighbours_(2 * chart.edges.size()),
        onRim_(uv.size(), 0) {
    for (const auto& [a, b] : chart.edges) ++start_[a + 1], ++start_[b + 1];
    for (std::size_t v = 0; v < uv.size(); ++v) start_[v + 1] += start_[v];
    std::vector<std::uint32_t> fill(start_.begin(), start_.end() - 1);
    for (const auto& [a, b] : chart.edges) neighbours_[fill[a]++] = b, neighbours_[fill[b]++] = a;
    for (std::uint32_t v : chart.rim) onRim_[v] = 1;
  }

  /// Relaxes what is turned over, in wider and wider rings.
  bool turnBack() {
    constexpr int kRounds = 16;
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<std::uint32_t> flipped = flippedTriangles(chart_, uv_);
      if (flipped.empty()) return true;
      std::vector<std::uint32_t> seeds;
      for (std::uint32_t t : flipped)
        for (int i = 0; i < 3; ++i) seeds.push_back(chart_.triangles[t][i]);
      relax(rings(seeds, round / 3), 12, 0);
      if (round % 2 == 1) reshapeRim(flipped);
    }
    return flippedTriangles(chart_, uv_).empty();
  }

  /// Draws the rim inwards where it crosses itself.
  bool part() {
    constexpr int kRounds = 24;
    for (int round = 0; round < kRounds; ++round) {
      std::vector<DVec2> boundary;
      for (std::uint32_t v : chart_.rim) boundary.push_back(uv_[v]);
      const std::vector<std::uint32_t> crossing = crossingSides(boundary);
      if (crossing.empty()) return true;
      if (round > 6 && 4 * crossing.size() > chart_.rim.size()) return false;  // no small matter
      std::vector<std::uint32_t> seeds;
      for (std::uint32_t side : crossing)
        for (std::size_t end : {std::size_t(side), (side + 1) % chart_.rim.size()})
          seeds.push_back(chart_.rim[end]);
      relax(rings(seeds, 1 + round / 6), 2, 0.25);
      if (!turnBack()) return false;
    }
    return false;
  }

  /// Boundary vertices of triangles turned over go where the triangles' shapes have them, seen from the side
  /// opposite: an ear between two boundary sides has no neighbours to lie between.
  void reshapeRim(const std::vector<std::uint32_t>& flipped) {
    for (std::uint32_t t : flipped)
      for (int i = 0; i < 3; ++i) {
        const UVec3& c = chart_.triangles[t];
        const std::uint32_t v = c[i], b = c[(i + 1) % 3], d = c[(i + 2) % 3];
        if (!onRim_[v]) continue;
        const DVec3 side = chart_.positions[d] - chart_.positions[b],
                    apex = chart_.positions[v] - chart_.positions[b];
        const double length2 = dot(side, side);
        if (!(length2 > 0)) continue;
        const double along = dot(apex, side) / length2;
        const double height = std::max(glm::length(glm::cross(side, apex)) / length2, 1e-3);
        const DVec2 flat = uv_[d] - uv_[b];
        uv_[v] = uv_[b] + along * flat + height * DVec2(-flat.y, flat.x);
      }
  }

 private:
  std::vector<std::uint32_t> rings(const std::vector<std::uint32_t>& seeds, int count) const {
    std::vector<std::uint32_t> region;
    std::vector<bool> inside(uv_.size(), false);
    const auto add = [&](std::uint32_t v) {
      if (!inside[v]) inside[v] = true, region.push_back(v);
    };
    for (std::uint32_t v : seeds) add(v);
    std::size_t begin = 0;
    for (int ring = 0; ring < count; ++ring) {
      const std::size_t end = region.size();
      for (std::size_t i = begin; i < end; ++i)
        for (std::uint32_t k = start_[region[i]]; k < start_[region[i] + 1]; ++k) add(neighbours_[k]);
      begin = end;
    }
    std::sort(region.begin(), region.end());
    return region;
  }

  void relax(const std::vector<std::uint32_t>& region, int sweeps, double rimShare) {
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (std::uint32_t v : region) {
        check_();
        if (onRim_[v] && rimShare == 0) continue;
        DVec2 sum(0);
        for (std::uint32_t k = start_[v]; k < start_[v + 1]; ++k) sum += uv_[neighbours_[k]];
        const DVec2 mean = sum / double(start_[v + 1] - start_[v]);
        uv_[v] = onRim_[v] ? uv_[v] + rimShare * (mean - uv_[v]) : mean;
      }
  }

  const FlatChart& chart_;
  std::vector<DVec2>& uv_;
  CancelCheck check_;
  std::vector<std::uint32_t> start_, neighbours_;
  std::vector<std::uint8_t> onRim_;
};

}  // namespace

bool untangle(const FlatChart& chart, std::vector<DVec2>& uv, Job& job) {
  Untangler untangler(chart, uv, job);
  return untangler.turnBack() && untangler.part();
}

}  // namespace prt
