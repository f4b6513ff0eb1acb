// Cuts that turn charts into disks (charts.h).

#include "libprt/atlas/charts.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/union_find.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>

namespace prt {
namespace {

/// A chart's edges, inner ones only, and shortest paths over its own vertices.
class ChartGraph {
 public:
  ChartGraph(const Surface& surface, const Chart& chart, std::span<const float> costs, Job& job)
      : chart_(chart), check_(job) {
    const std::size_t n = chart.vertices.size();
    onBoundary.assign(n, false);
    for (const auto& loop : chart.loops)
      for (std::uint32_t v : loop) onBoundary[v] = true;
    // Each inner edge has two half-edges in the chart; the later one finds the earlier in `first`.
    std::unordered_map<std::uint32_t, std::uint32_t> first;
    first.reserve(3 * chart.faces.size());
    for (std::uint32_t t = 0; t < chart.faces.size(); ++t)
      for (std::uint32_t i = 0; i < 3; ++i) {
        check_();
        const std::uint32_t edge = surface.edge[3 * chart.faces[t] + i];
        const std::uint32_t a = chart.triangles[t][int(i)], b = chart.triangles[t][int((i + 1) % 3)];
        const auto [place, isNew] = first.try_emplace(edge, std::uint32_t(edges.size()));
        if (isNew) {
          edges.push_back({a, b, t, kNowhere, edge, double(costs[edge])});
        } else if (Edge& other = edges[place->second]; other.a == b && other.b == a) {
          other.right = t;
        }
      }
    std::erase_if(edges, [&](const Edge& e) { return e.right == kNowhere || isSlit(e); });  // cut or border
    start.assign(n + 1, 0);
    for (const Edge& e : edges) ++start[e.a + 1], ++start[e.b + 1];
    for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
    spokes.resize(2 * edges.size());
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      spokes[fill[edges[e].a]++] = e, spokes[fill[edges[e].b]++] = e;
  }

  /// Distances and the tree of shortest paths. Boundary vertices are never passed through unless sources.
  void search(const std::vector<std::uint32_t>& sources) {
    const double far = std::numeric_limits<double>::infinity();
    cost.assign(chart_.vertices.size(), far);
    edgeTo.assign(chart_.vertices.size(), kNowhere);
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    for (std::uint32_t s : sources) cost[s] = 0, heap.push({0, s});
    while (!heap.empty()) {
      check_();
      const auto [c, v] = heap.top();
      heap.pop();
      if (c > cost[v]) continue;
      for (std::uint32_t i = start[v]; i < start[v + 1]; ++i) {
        const Edge& e = edges[spokes[i]];
        const std::uint32_t other = e.a == v ? e.b : e.a;
        if (c + e.cost >= cost[other]) continue;
        cost[other] = c + e.cost;
        edgeTo[other] = spokes[i];
        heap.push({cost[other], other});
      }
    }
  }

  /// Edges (of the surface) from a vertex up the tree.
  void climb(std::uint32_t vertex, std::vector<std::uint32_t>& cut) const {
    while (edgeTo[vertex] != kNowhere) {
      const Edge& e = edges[edgeTo[vertex]];
      cut.push_back(e.edge);
      vertex = e.a == vertex ? e.b : e.a;
    }
  }

  /// The reached vertex that is farthest.
  std::uint32_t farthest() const {
    std::uint32_t best = 0;
    for (std::uint32_t v = 0; v < cost.size(); ++v)
      if (std::isfinite(cost[v]) && cost[v] > cost[best]) best = v;
    return best;
  }

  struct Edge {
    std::uint32_t a, b;         // vertices of the chart
    std::uint32_t left, right;  // triangles of the chart
    std::uint32_t edge;         // of the surface
    double cost;
  };
  std::vector<Edge> edges;
  std::vector<std::uint32_t> start, spokes;
  std::vector<bool> onBoundary;
  std::vector<double> cost;
  std::vector<std::uint32_t> edgeTo;

 private:
  /// A cut along one edge alone, whose two sides have the same ends.
  bool isSlit(const Edge& e) const {
    for (const auto& loop : chart_.loops)
      if (loop.size() == 2 && std::minmax(loop[0], loop[1]) == std::minmax(e.a, e.b)) return true;
    return false;
  }

  const Chart& chart_;
  CancelCheck check_;
};

struct Cut {
  std::vector<std::uint32_t> edges;
  double cost = 0;
};

/// Tree and cotree: what neither the shortest-path tree nor the largest spanning tree of the dual takes
/// closes the shortest loops and boundary-to-boundary ways; cut along them the chart is a disk.
Cut treeCotree(ChartGraph& graph, const Chart& chart, const std::vector<std::uint32_t>& sources) {
  graph.search(sources);
  std::vector<bool> inTree(graph.edges.size(), false);
  for (std::uint32_t e : graph.edgeTo)
    if (e != kNowhere) inTree[e] = true;
  std::vector<std::uint32_t> order;
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
    if (!inTree[e]) order.push_back(e);
  const auto loopCost = [&](std::uint32_t e) {
    return graph.cost[graph.edges[e].a] + graph.cost[graph.edges[e].b] + graph.edges[e].cost;
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
    return loopCost(x) != loopCost(y) ? loopCost(x) > loopCost(y) : x < y;
  });
  UnionFind duals(chart.faces.size());
  Cut cut;
  for (std::uint32_t e : order) {
    const ChartGraph::Edge& edge = graph.edges[e];
    if (duals.find(edge.left) != duals.find(edge.right)) {
      duals.join(edge.left, edge.right);
      continue;
    }
    cut.edges.push_back(edge.edge);
    graph.climb(edge.a, cut.edges);
    graph.climb(edge.b, cut.edges);
  }
  std::sort(cut.edges.begin(), cut.edges.end());
  cut.edges.erase(std::unique(cut.edges.begin(), cut.edges.end()), cut.edges.end());
  return cut;
}

double costOf(const Cut& cut, std::span<const float> costs) {
  double sum = 0;
  for (std::uint32_t e : cut.edges) sum += costs[e];
  return sum;
}

/// Closed surfaces have no boundary to start from: the best of a few vertices that are far apart.
Cut bestLoops(ChartGraph& graph, const Chart& chart, std::span<const float> costs) {
  constexpr int kTries = 6;
  std::vector<std::uint32_t> sources{0};
  Cut best;
  for (int i = 0; i < kTries; ++i) {
    Cut cut = treeCotree(graph, chart, {sources.back()});
    cut.cost = costOf(cut, costs);
    if (i == 0 || cut.cost < best.cost) best = std::move(cut);
    graph.search(sources);
    sources.push_back(graph.farthest());
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> suggestedCut(const Surface& surface, const Chart& chart,
                                        std::span<const float> costs, Job& job) {
  if (chart.fault() == ChartFault::None) return {};
  ChartGraph graph(surface, chart, costs, job);
  if (!chart.loops.empty()) {
    std::vector<std::uint32_t> rim;
    for (const auto& loop : chart.loops) rim.insert(rim.end(), loop.begin(), loop.end());
    Cut cut = treeCotree(graph, chart, rim);
    if (chart.fault() == ChartFault::Closed) graph.climb(graph.farthest(), cut.edges);  // a longer slit
    return cut.edges;
  }
  if (chart.handles() > 0) return bestLoops(graph, chart, costs).edges;
  // A sphere: between its two far ends.
  graph.search({0});
  const std::uint32_t one = graph.farthest();
  graph.search({one});
  std::vector<std::uint32_t> slit;
  graph.climb(graph.farthest(), slit);
  return slit;
}

Charts makeDisks(const Surface& surface, Seams& seams, std::span<const float> costs, Job& job,
                 std::vector<std::uint32_t>* added) {
  // One cut makes a disk; a second round only meets a slit sphere that had a slit of one edge.
  constexpr int kRounds = 4;
  Charts charts = makeCharts(surface, seams, job);
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (const Chart& chart : charts.charts)
      for (std::uint32_t e : suggestedCut(surface, chart, costs, job)) {
        seams.set(e);
        if (added) added->push_back(e);
        changed = true;
      }
    if (!changed) break;
    charts = makeCharts(surface, seams, job);
  }
  return charts;
}

}  // namespace prt
