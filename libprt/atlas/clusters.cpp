#include "libprt/atlas/clusters.h"

#include "libprt/atlas/charts.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/union_find.h"

#include <algorithm>
#include <limits>

namespace prt {
namespace {

struct Entry {
  float cost;
  std::uint32_t face, cluster;
  bool operator<(const Entry& other) const {  // std heaps keep the largest in front
    return cost != other.cost   ? cost > other.cost
           : face != other.face ? face > other.face
                                : cluster > other.cluster;
  }
};

class Lloyd {
 public:
  Lloyd(const Surface& surface, std::span<const float> bends, Job& job) : surface_(surface), job_(job) {
    const std::size_t faces = surface.triangleCount();
    centers_.resize(faces);
    normals_.resize(faces);
    areas_.resize(faces);
    for (std::uint32_t f = 0; f < faces; ++f) {
      const UVec3& t = surface.triangles[f];
      centers_[f] = (surface.positions[t.x] + surface.positions[t.y] + surface.positions[t.z]) / 3.0f;
      const DVec3 n = surface.areaNormal(f);
      const double length = glm::length(n);
      normals_[f] = length > 0 ? Vec3(n / length) : Vec3(0);
      areas_[f] = 0.5 * length;
    }
    crossing_.resize(surface.edgeCount());
    for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
      const std::uint32_t half = surface.halfOf[e], other = surface.twin[half];
      if (other == kNowhere) continue;
      const UVec2 v = surface.ends(e);
      const Vec3 middle = 0.5f * (surface.positions[v.x] + surface.positions[v.y]);
      const float way =
          glm::distance(centers_[half / 3], middle) + glm::distance(middle, centers_[other / 3]);
      const float bend = std::min(1.0f, std::abs(bends[e]) / float(radians(60)));
      crossing_[e] = way * (1 + 4 * bend);
    }
  }

  std::vector<std::uint32_t> run(std::size_t wanted) {
    seed(wanted);
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
      grow();
      recentre();
    }
    grow();
    return std::move(clusterOf_);
  }

 private:
  /// Evenly by area along a space-filling order, and one in each component.
  void seed(std::size_t wanted) {
    const std::size_t faces = surface_.triangleCount();
    Box3 box;
    for (const Vec3& c : centers_) box.extend(c);
    const Vec3 scale = 1023.0f / max(box.high - box.low, Vec3(1e-30f));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(faces);
    for (std::uint32_t f = 0; f < faces; ++f) {
      const UVec3 p((centers_[f] - box.low) * scale);
      std::uint32_t code = 0;
      for (int bit = 0; bit < 10; ++bit)
        for (int k = 0; k < 3; ++k) code |= ((p[k] >> bit) & 1u) << (3 * bit + k);
      order[f] = {code, f};
    }
    std::sort(order.begin(), order.end());
    UnionFind components(faces);
    for (std::uint32_t half = 0; half < 3 * faces; ++half)
      if (surface_.twin[half] != kNowhere) components.join(half / 3, surface_.twin[half] / 3);
    double total = 0, sum = 0;
    for (double a : areas_) total += a;
    std::vector<bool> hasSeed(faces, false);
    for (const auto& [code, f] : order) {
      const double before = sum;
      sum += areas_[f];
      const bool due = std::floor(sum / total * double(wanted)) > std::floor(before / total * double(wanted));
      if (!due) continue;
      seeds_.push_back(f);
      hasSeed[components.find(f)] = true;
    }
    for (std::uint32_t f = 0; f < faces; ++f)
      if (components.find(f) == f && !hasSeed[f]) seeds_.push_back(f);
    means_.assign(seeds_.size(), Vec3(0));
    for (std::size_t c = 0; c < seeds_.size(); ++c) means_[c] = normals_[seeds_[c]];
  }

  void grow() {
    CancelCheck check(job_);
    const std::size_t faces = surface_.triangleCount();
    clusterOf_.assign(faces, kNowhere);
    std::vector<float> cost(faces, std::numeric_limits<float>::infinity());
    std::vector<Entry> heap;
    for (std::uint32_t c = 0; c < seeds_.size(); ++c) {
      cost[seeds_[c]] = 0;
      heap.push_back({0, seeds_[c], c});
    }
    std::make_heap(heap.begin(), heap.end());
    while (!heap.empty()) {
      check();
      std::pop_heap(heap.begin(), heap.end());
      const Entry entry = heap.back();
      heap.pop_back();
      if (clusterOf_[entry.face] != kNowhere) continue;
      clusterOf_[entry.face] = entry.cluster;
      for (std::uint32_t half = 3 * entry.face; half < 3 * entry.face + 3; ++half) {
        const std::uint32_t other = surface_.twin[half];
        if (other == kNowhere || clusterOf_[other / 3] != kNowhere) continue;
        const float turn = 1 - glm::dot(normals_[other / 3], means_[entry.cluster]);
        const float next = entry.cost + crossing_[surface_.edge[half]] * (1 + 3 * turn);
        if (next >= cost[other / 3]) continue;
        cost[other / 3] = next;
        heap.push_back({next, other / 3, entry.cluster});
        std::push_heap(heap.begin(), heap.end());
      }
    }
  }

  /// Each seed moves to the triangle nearest to its patch's centroid.
  void recentre() {
    std::vector<DVec3> sums(seeds_.size(), DVec3(0)), turns(seeds_.size(), DVec3(0));
    std::vector<double> weights(seeds_.size(), 0.0);
    for (std::uint32_t f = 0; f < clusterOf_.size(); ++f) {
      const std::uint32_t c = clusterOf_[f];
      sums[c] += DVec3(centers_[f]) * areas_[f];
      turns[c] += DVec3(normals_[f]) * areas_[f];
      weights[c] += areas_[f];
    }
    std::vector<double> nearest(seeds_.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t f = 0; f < clusterOf_.size(); ++f) {
      const std::uint32_t c = clusterOf_[f];
      if (!(weights[c] > 0)) continue;
      const double distance = glm::distance(DVec3(centers_[f]), sums[c] / weights[c]);
      if (distance < nearest[c]) nearest[c] = distance, seeds_[c] = f;
    }
    for (std::size_t c = 0; c < seeds_.size(); ++c) {
      const double length = glm::length(turns[c]);
      means_[c] = length > 0 ? Vec3(turns[c] / length) : Vec3(0);
    }
  }

  const Surface& surface_;
  Job& job_;
  std::vector<Vec3> centers_, normals_, means_;
  std::vector<double> areas_;
  std::vector<float> crossing_;
  std::vector<std::uint32_t> seeds_, clusterOf_;
};

Seams rimsOf(const Surface& surface, const std::vector<std::uint32_t>& clusterOf) {
  Seams seams(surface);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
    const std::uint32_t half = surface.halfOf[e], other = surface.twin[half];
    seams.set(e, other != kNowhere && clusterOf[half / 3] != clusterOf[other / 3]);
  }
  return seams;
}

/// A disk whose rim passes every vertex once, and that is flat enough to be stood for by a fan of triangles:
/// a cap of a half sphere has half of its area left in its mean plane.
bool isPlain(const Surface& surface, const Chart& chart) {
  if (chart.fault() != ChartFault::None) return false;
  constexpr double kFlat = 0.7;
  DVec3 normals(0);
  for (std::uint32_t f : chart.faces) normals += 0.5 * surface.areaNormal(f);
  if (chart.faces.size() > 1 && glm::length(normals) < kFlat * chart.area) return false;
  std::vector<std::uint32_t> rim;
  for (std::uint32_t v : chart.loops[0]) rim.push_back(chart.vertices[v]);
  std::sort(rim.begin(), rim.end());
  return std::adjacent_find(rim.begin(), rim.end()) == rim.end();
}

/// Triangles of the chart in the order in which a flood from one reaches them.
std::vector<std::uint32_t> flood(const Surface& surface, const std::vector<std::uint32_t>& clusterOf,
                                 std::uint32_t from, std::vector<std::uint32_t>& mark, std::uint32_t stamp) {
  std::vector<std::uint32_t> queue{from};
  mark[from] = stamp;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (std::uint32_t half = 3 * queue[i]; half < 3 * queue[i] + 3; ++half) {
      const std::uint32_t other = surface.twin[half] == kNowhere ? kNowhere : surface.twin[half] / 3;
      if (other == kNowhere || clusterOf[other] != clusterOf[from] || mark[other] == stamp) continue;
      mark[other] = stamp;
      queue.push_back(other);
    }
  return queue;
}

}  // namespace

Clusters makeClusters(const Surface& surface, std::span<const float> bends, std::size_t wanted, Job& job) {
  Clusters result;
  if (surface.triangleCount() == 0) return result;
  result.clusterOf = Lloyd(surface, bends, job).run(std::max<std::size_t>(1, wanted));
  // What is no plain disk is halved between its far ends until it is: single triangles always are.
  std::vector<std::uint32_t> mark(surface.triangleCount(), kNowhere);
  std::uint32_t stamp = 0;
  constexpr int kRounds = 64;  // each halves what is left
  for (int round = 0; round < kRounds; ++round) {
    const Charts charts = makeCharts(surface, rimsOf(surface, result.clusterOf), job);
    result.clusterOf = charts.chartOf;
    result.count = std::uint32_t(charts.charts.size());
    bool changed = false;
    for (const Chart& chart : charts.charts) {
      if (isPlain(surface, chart)) continue;
      changed = true;
      const std::uint32_t one = flood(surface, charts.chartOf, chart.faces[0], mark, stamp++).back();
      const std::vector<std::uint32_t> order = flood(surface, charts.chartOf, one, mark, stamp++);
      // The nearer half by steps from one end is connected; the rest may fall apart, which is well.
      for (std::size_t i = 0; i < (order.size() + 1) / 2; ++i) result.clusterOf[order[i]] = result.count;
      if (order.size() > 1) ++result.count;
    }
    if (!changed) break;
  }
  return result;
}

}  // namespace prt
