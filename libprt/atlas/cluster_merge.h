#pragma once
// Greedy growth of charts from clusters: of all seams, the one that costs least stretch per visible length is
// mended next, as long as what it leaves is a disk that unfolds without overlap. Internal to automatic
// cutting.

#include "libprt/atlas/cluster_complex.h"

#include <memory>

namespace prt {

struct MergeOptions {
  double stretch = 1.10;       ///< bound on the L2 stretch over all charts together
  double chartStretch = 1.25;  ///< and of each one
  double chartArea = 1;        ///< largest part of the surface that one chart may be
  /// Charts that fill their convex hulls pack well, and unfold easily: hull that becomes no chart counts like
  /// stretch, and so much of it for a length of seam (all relative to the surface) is too much.
  double wasteWeight = 1.5, wasteBound = 0.06;
  double chartBonus = 0.03;  ///< what one chart less is worth, as seam length in roots of the surface's area
};

class ClusterMerge {
 public:
  /// Keeps a reference to the complex.
  ClusterMerge(const ClusterComplex& complex, const MergeOptions& options);
  ~ClusterMerge();

  /// Merges until the bound is reached. Reports its progress from 0 to 1 through `job`. Throws Cancelled.
  void run(Job& job);

  /// Whether an arc is still cut.
  bool isSeam(std::uint32_t arc) const;
  /// Chart of each cluster, any numbers, as the merging left it.
  const std::vector<std::uint32_t>& chartOfCluster() const;
  /// Cuts the chart of a cluster again where it was joined last. False when it is one cluster.
  bool undoLast(std::uint32_t cluster);
  /// Clusters that hang together with one, as the seams are now.
  std::size_t chartSize(std::uint32_t cluster) const;
  /// Flat place of each corner of a coarse triangle in its chart.
  const std::array<DVec2, 3>& uvOf(std::uint32_t coarseTriangle) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace prt
