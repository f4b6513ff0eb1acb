#include "libprt/atlas/straighten.h"

#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace prt {
namespace {

class Straightener {
 public:
  Straightener(const Surface& surface, std::span<const float> costs, Seams& seams, Job& job)
      : surface_(surface),
        costs_(costs),
        seams_(seams),
        check_(job),
        valence_(surface.vertexCount(), 0),
        cost_(surface.vertexCount()),
        edgeTo_(surface.vertexCount()),
        seen_(surface.vertexCount(), 0),
        mark_(surface.triangleCount(), 0) {
    for (std::uint32_t e = 0; e < surface.edgeCount(); ++e)
      if (surface.isBorder(e) || seams[e]) count(e, 1);
  }

  void run() {
    std::vector<std::uint32_t> edges = seams_.edges();
    std::vector<bool> done(surface_.edgeCount(), false);
    for (std::uint32_t e : edges) {
      check_();
      if (done[e] || !seams_[e] || surface_.isBorder(e)) continue;
      const UVec2 v = surface_.ends(e);
      for (std::uint32_t start : {v.x, v.y}) {
        if (valence_[start] == 2 || done[e]) continue;
        std::vector<std::uint32_t> chain = follow(e, start);
        for (std::uint32_t c : chain) done[c] = true;
        tighten(start, chain);
      }
    }
  }

 private:
  void count(std::uint32_t edge, int by) {
    valence_[surface_.ends(edge).x] += by;
    valence_[surface_.ends(edge).y] += by;
  }

  std::vector<std::uint32_t> follow(std::uint32_t edge, std::uint32_t from) const {
    std::vector<std::uint32_t> chain{edge};
    std::uint32_t at = surface_.across(edge, from);
    while (valence_[at] == 2) {
      std::uint32_t next = kNowhere;
      for (std::uint32_t i = surface_.spokeStart[at]; i < surface_.spokeStart[at + 1]; ++i) {
        const std::uint32_t spoke = surface_.spokes[i];
        if (seams_[spoke] && !surface_.isBorder(spoke) && spoke != chain.back()) next = spoke;
      }
      if (next == kNowhere) break;
      chain.push_back(next);
      at = surface_.across(next, at);
    }
    return chain;
  }

  void tighten(std::uint32_t start, const std::vector<std::uint32_t>& chain) {
    if (chain.size() < 2) return;
    double cost = 0;
    std::uint32_t end = start;
    for (std::uint32_t e : chain) cost += costs_[e], end = surface_.across(e, end);
    if (end == start || valence_[end] == 1 || valence_[start] == 1) return;
    const std::size_t before = pieces(chain);
    for (std::uint32_t e : chain) change(e, false);
    const std::vector<std::uint32_t> path = shortest(start, end, cost * 0.999);
    if (path.empty()) {
      for (std::uint32_t e : chain) change(e, true);
      return;
    }
    for (std::uint32_t e : path) change(e, true);
    if (before != 0 && pieces(path) == before) return;
    for (std::uint32_t e : path) change(e, false);
    for (std::uint32_t e : chain) change(e, true);
  }

  void change(std::uint32_t edge, bool cut) {
    seams_.set(edge, cut);
    count(edge, cut ? 1 : -1);
  }

  /// Cheapest way over vertices where no cut is, below a bound; empty when there is none.
  std::vector<std::uint32_t> shortest(std::uint32_t from, std::uint32_t to, double bound) {
    ++stamp_;
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    const auto offer = [&](std::uint32_t v, double c, std::uint32_t edge) {
      if (c >= bound || (seen_[v] == stamp_ && cost_[v] <= c)) return;
      seen_[v] = stamp_;
      cost_[v] = c;
      edgeTo_[v] = edge;
      heap.push({c, v});
    };
    offer(from, 0, kNowhere);
    while (!heap.empty()) {
      check_();
      const auto [c, v] = heap.top();
      heap.pop();
      if (c > cost_[v]) continue;
      if (v == to) break;
      if (v != from && valence_[v] != 0) continue;
      for (std::uint32_t i = surface_.spokeStart[v]; i < surface_.spokeStart[v + 1]; ++i) {
        const std::uint32_t spoke = surface_.spokes[i];
        if (!seams_[spoke] && !surface_.isBorder(spoke))
          offer(surface_.across(spoke, v), c + costs_[spoke], spoke);
      }
    }
    std::vector<std::uint32_t> path;
    if (seen_[to] != stamp_) return path;
    for (std::uint32_t v = to; v != from; v = surface_.across(edgeTo_[v], v)) path.push_back(edgeTo_[v]);
    return path;
  }

  /// A number that stands for what lies on the two sides of a cut: triangles, and whether all is disks; 0
  /// when it is not.
  std::size_t pieces(const std::vector<std::uint32_t>& cut) {
    const std::uint32_t half = surface_.halfOf[cut[0]];
    const std::vector<std::uint32_t> left = flood(half / 3);
    if (makeChart(surface_, seams_, left).fault() != ChartFault::None) return 0;
    std::size_t size = left.size();
    if (mark_[surface_.twin[half] / 3] != markStamp_) {
      const std::vector<std::uint32_t> right = flood(surface_.twin[half] / 3);
      if (makeChart(surface_, seams_, right).fault() != ChartFault::None) return 0;
      size += right.size() + surface_.triangleCount();  // two pieces, not one
    }
    return size;
  }

  std::vector<std::uint32_t> flood(std::uint32_t from) {
    ++markStamp_;
    std::vector<std::uint32_t> faces{from};
    mark_[from] = markStamp_;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      check_();
      for (std::uint32_t half = 3 * faces[i]; half < 3 * faces[i] + 3; ++half) {
        const std::uint32_t other = surface_.twin[half];
        if (other == kNowhere || seams_[surface_.edge[half]] || mark_[other / 3] == markStamp_) continue;
        mark_[other / 3] = markStamp_;
        faces.push_back(other / 3);
      }
    }
    return faces;
  }

  const Surface& surface_;
  std::span<const float> costs_;
  Seams& seams_;
  CancelCheck check_;
  std::vector<int> valence_;
  std::vector<double> cost_;
  std::vector<std::uint32_t> edgeTo_, seen_, mark_;
  std::uint32_t stamp_ = 0, markStamp_ = 0;
};

}  // namespace

void straightenSeams(const Surface& surface, std::span<const float> costs, Seams& seams, Job& job) {
  Straightener(surface, costs, seams, job).run();
}

}  // namespace prt
