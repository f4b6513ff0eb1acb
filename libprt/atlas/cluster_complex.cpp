#include "libprt/atlas/cluster_complex.h"

#include "libprt/atlas/charts.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <set>

namespace prt {
namespace {

/// Follows rims from node to node.
class ArcWalker {
 public:
  ArcWalker(const Surface& surface, const Clusters& clusters, std::span<const float> costs)
      : surface_(surface),
        clusters_(clusters),
        costs_(costs),
        isRim_(surface.edgeCount(), 0),
        isNode_(surface.vertexCount(), 0) {
    for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
      const std::uint32_t half = surface.halfOf[e], other = surface.twin[half];
      isRim_[e] = other == kNowhere || clusters.clusterOf[half / 3] != clusters.clusterOf[other / 3];
    }
    for (std::uint32_t v = 0; v < surface.vertexCount(); ++v) {
      int rims = 0;
      bool border = false, inner = false;
      for (std::uint32_t i = surface.spokeStart[v]; i < surface.spokeStart[v + 1]; ++i)
        if (isRim_[surface.spokes[i]]) {
          ++rims;
          (surface.isBorder(surface.spokes[i]) ? border : inner) = true;
        }
      isNode_[v] = rims > 2 || rims == 1 || (border && inner);
    }
  }

  std::vector<RimArc> walk(Job& job) {
    CancelCheck check(job);
    std::vector<RimArc> arcs;
    std::vector<bool> done(surface_.edgeCount(), false);
    for (const bool loops : {false, true})
      for (std::uint32_t e = 0; e < surface_.edgeCount(); ++e) {
        check();
        if (!isRim_[e] || done[e]) continue;
        const UVec2 v = surface_.ends(e);
        std::uint32_t from = v.x;
        if (!isNode_[v.x]) {
          if (isNode_[v.y])
            from = v.y;
          else if (!loops)
            continue;
          else
            isNode_[v.x] = 1;  // a loop without nodes gets one
        }
        arcs.push_back(follow(e, from, done));
      }
    return arcs;
  }

 private:
  RimArc follow(std::uint32_t edge, std::uint32_t from, std::vector<bool>& done) {
    RimArc arc;
    arc.nodes[0] = from;
    // The cluster on the left of the walk.
    const std::uint32_t half = surface_.halfOf[edge], other = surface_.twin[half];
    const std::uint32_t here = clusters_.clusterOf[half / 3];
    const std::uint32_t there = other == kNowhere ? kNowhere : clusters_.clusterOf[other / 3];
    arc.clusters = {here, there};
    if (surface_.from(half) != from && there != kNowhere) arc.clusters = {there, here};
    std::uint32_t at = from;
    while (true) {
      done[edge] = true;
      arc.edges.push_back(edge);
      arc.length += surface_.length(edge);
      arc.cost += costs_[edge];
      at = surface_.across(edge, at);
      if (isNode_[at]) break;
      for (std::uint32_t i = surface_.spokeStart[at]; i < surface_.spokeStart[at + 1]; ++i)
        if (isRim_[surface_.spokes[i]] && !done[surface_.spokes[i]]) {
          edge = surface_.spokes[i];
          break;
        }
      if (done[edge]) break;  // back where a loop began
    }
    arc.nodes[1] = at;
    if (there == kNowhere && surface_.from(half) != from) {  // the cluster is to be on the left
      std::swap(arc.nodes[0], arc.nodes[1]);
      std::reverse(arc.edges.begin(), arc.edges.end());
    }
    return arc;
  }

  const Surface& surface_;
  const Clusters& clusters_;
  std::span<const float> costs_;
  std::vector<std::uint8_t> isRim_, isNode_;
};

/// How many pieces each arc has: more for long ones, at least three round every cluster, and no two pieces
/// between the same ends.
std::vector<std::size_t> pieceCounts(const std::vector<RimArc>& arcs, const std::vector<double>& areas) {
  std::vector<std::size_t> counts(arcs.size(), 1);
  std::vector<std::vector<std::uint32_t>> arcsOf(areas.size());
  for (std::uint32_t i = 0; i < arcs.size(); ++i) {
    double area = areas[arcs[i].clusters[0]];
    for (std::uint32_t c : arcs[i].clusters)
      if (c != kNowhere) area = std::min(area, areas[c]), arcsOf[c].push_back(i);
    const double wanted = 0.8 * std::sqrt(area);
    const double pieces = wanted > 0 ? std::floor(arcs[i].length / wanted + 0.5) : 1;
    counts[i] = std::size_t(std::clamp(pieces, 1.0, double(arcs[i].edges.size())));
    if (arcs[i].nodes[0] == arcs[i].nodes[1]) counts[i] = std::max<std::size_t>(counts[i], 3);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (std::size_t i = 0; i < arcs.size(); ++i)
    if (counts[i] == 1 && !taken.insert(std::minmax(arcs[i].nodes[0], arcs[i].nodes[1])).second)
      counts[i] = 2;
  for (const auto& around : arcsOf) {
    std::size_t pieces = 0;
    for (std::uint32_t i : around) pieces += counts[i];
    for (std::uint32_t i : around)
      while (pieces < 3 && counts[i] < arcs[i].edges.size()) ++counts[i], ++pieces;
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) counts[i] = std::min(counts[i], arcs[i].edges.size());
  return counts;
}

}  // namespace

ClusterComplex makeClusterComplex(const Surface& surface, const Clusters& clusters,
                                  std::span<const float> costs, Job& job) {
  ClusterComplex complex;
  complex.arcs = ArcWalker(surface, clusters, costs).walk(job);
  complex.area.assign(clusters.count, 0.0);
  std::vector<DVec3> centres(clusters.count, DVec3(0));
  for (std::uint32_t f = 0; f < surface.triangleCount(); ++f) {
    const double area = surface.area(f);
    const UVec3& t = surface.triangles[f];
    const DVec3 middle =
        (DVec3(surface.positions[t.x]) + DVec3(surface.positions[t.y]) + DVec3(surface.positions[t.z])) / 3.0;
    complex.area[clusters.clusterOf[f]] += area;
    centres[clusters.clusterOf[f]] += middle * area;
  }
  const std::vector<std::size_t> counts = pieceCounts(complex.arcs, complex.area);

  // Vertices: ends of pieces, then centres.
  std::vector<std::uint32_t> coarseOf(surface.vertexCount(), kNowhere);
  std::vector<Vec3> positions;
  const auto vertex = [&](std::uint32_t v) {
    if (coarseOf[v] == kNowhere) {
      coarseOf[v] = std::uint32_t(positions.size());
      positions.push_back(surface.positions[v]);
      complex.surfaceVertex.push_back(v);
    }
    return coarseOf[v];
  };
  std::vector<std::vector<std::uint32_t>> ends(complex.arcs.size());
  for (std::size_t i = 0; i < complex.arcs.size(); ++i) {
    const RimArc& arc = complex.arcs[i];
    std::uint32_t at = arc.nodes[0];
    std::size_t done = 0;
    double length = 0;
    ends[i].push_back(vertex(at));
    for (std::size_t k = 0; k < arc.edges.size(); ++k) {
      at = surface.across(arc.edges[k], at);
      length += surface.length(arc.edges[k]);
      const std::size_t left = arc.edges.size() - k - 1, missing = counts[i] - done - 1;
      const bool last = left == 0;
      if (last ||
          (missing > 0 && (length >= arc.length * double(done + 1) / double(counts[i]) || left <= missing))) {
        ends[i].push_back(vertex(at));
        ++done;
      }
    }
  }
  const auto firstCentre = std::uint32_t(positions.size());
  for (std::uint32_t c = 0; c < clusters.count; ++c) {
    positions.push_back(Vec3(complex.area[c] > 0 ? centres[c] / complex.area[c] : centres[c]));
    complex.surfaceVertex.push_back(kNowhere);
  }
  std::vector<UVec3> triangles;
  complex.triangles.resize(clusters.count);
  std::vector<std::vector<std::uint32_t>> pieceTriangles(complex.arcs.size());
  for (std::size_t i = 0; i < complex.arcs.size(); ++i)
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t c = complex.arcs[i].clusters[std::size_t(side)];
      if (c == kNowhere) continue;
      for (std::size_t k = 0; k + 1 < ends[i].size(); ++k) {
        std::uint32_t a = ends[i][k], b = ends[i][k + 1];
        if (side == 1) std::swap(a, b);
        if (side == 0) pieceTriangles[i].push_back(std::uint32_t(triangles.size()));
        complex.triangles[c].push_back(std::uint32_t(triangles.size()));
        complex.clusterOfTriangle.push_back(c);
        triangles.push_back({a, b, firstCentre + c});
      }
    }
  complex.coarse = Surface(std::move(positions), std::move(triangles), job);
  for (std::size_t i = 0; i < complex.arcs.size(); ++i)
    for (std::uint32_t t : pieceTriangles[i]) complex.arcs[i].pieces.push_back(complex.coarse.edge[3 * t]);
  return complex;
}

}  // namespace prt
