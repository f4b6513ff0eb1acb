#pragma once
// A coarse copy of a surface made of its clusters: each is a fan of triangles about its centre, rims are few
// straight pieces between the places where clusters meet. What is cut there can be cut on the surface itself,
// edge by edge, because every coarse piece stands for a path of edges. Internal to automatic cutting.

#include "libprt/atlas/clusters.h"

#include <array>

namespace prt {

/// A stretch of rim between two nodes, places where three clusters or more meet, or the border: one cluster
/// on each side.
struct RimArc {
  std::array<std::uint32_t, 2> nodes;     ///< vertices of the surface
  std::array<std::uint32_t, 2> clusters;  ///< left and right of it; right is kNowhere at a border
  std::vector<std::uint32_t> edges;       ///< of the surface, from the first node to the second
  std::vector<std::uint32_t> pieces;      ///< edges of the coarse surface, in the same order
  double length = 0;
  double cost = 0;  ///< of a seam along it
};

struct ClusterComplex {
  Surface coarse;
  std::vector<std::uint32_t> clusterOfTriangle;       ///< of the coarse triangles
  std::vector<std::vector<std::uint32_t>> triangles;  ///< coarse ones of each cluster
  std::vector<double> area;                           ///< of each cluster, on the surface
  std::vector<RimArc> arcs;
  /// Vertices of the surface that coarse vertices stand for; kNowhere for centres, which come last, cluster
  /// by cluster.
  std::vector<std::uint32_t> surfaceVertex;

  std::uint32_t centre(std::uint32_t cluster) const {
    return std::uint32_t(surfaceVertex.size() - triangles.size()) + cluster;
  }
};

ClusterComplex makeClusterComplex(const Surface& surface, const Clusters& clusters,
                                  std::span<const float> costs, Job& job);

}  // namespace prt
