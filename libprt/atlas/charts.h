#pragma once
// Charts: the pieces that a cut leaves of a surface, what keeps one from being a disk, and the cut that
// would make it one.

#include "libprt/atlas/seams.h"

#include <span>
#include <string>
#include <vector>

namespace prt {

/// Why a chart cannot be laid flat in one piece.
enum class ChartFault {
  None,        ///< a disk
  Closed,      ///< no boundary at all, or one of a single edge
  Boundaries,  ///< more than one boundary loop
  Handles      ///< a handle (genus above 0), whatever its boundaries
};

/// A connected piece with vertices of its own: the two sides of a cut, and fans of triangles that touch in
/// a vertex only, are different vertices here.
struct Chart {
  std::vector<std::uint32_t> faces;               ///< [f] triangles of the surface, in rising order
  std::vector<UVec3> triangles;                   ///< [f] the same over the chart's vertices
  std::vector<std::uint32_t> vertices;            ///< [n] the surface vertex of each
  std::vector<std::vector<std::uint32_t>> loops;  ///< boundary loops, the surface on the left
  double area = 0;

  int euler = 0;  ///< vertices - edges + triangles: 1 for a disk
  int handles() const { return (2 - int(loops.size()) - euler) / 2; }
  ChartFault fault() const;
};

struct Charts {
  std::vector<std::uint32_t> chartOf;  ///< [F]
  std::vector<Chart> charts;           ///< in the order of their first triangles
};

/// Floods every chart up to seams and borders. Near linear; throws Cancelled.
Charts makeCharts(const Surface& surface, const Seams& seams, Job& job);

/// One chart from some triangles, which must be edge-connected without crossing seams. Cost is that of the
/// piece, not of the surface.
Chart makeChart(const Surface& surface, const Seams& seams, std::span<const std::uint32_t> faces);

/// "chart 1" for the first: how errors and messages name it.
std::string chartName(std::size_t chart);
/// The first boundary in coordinates of the chart's vertices; empty where there is none.
std::vector<DVec2> outlineOf(const Chart& chart, std::span<const DVec2> uv);
/// "closed: no boundary to unfold from", "2 boundaries instead of 1", "1 handle"; "a disk" for none.
std::string faultText(const Chart& chart);

/// Edges whose cutting makes the chart a disk; none when it is one. Boundaries are joined by shortest ways, a
/// handle gets the shortest loops or ways found by tree and cotree (Erickson and Whittlesey 2005: from the
/// boundary, or else from the best of a few far apart vertices); a closed surface without handles is slit
/// between two far ends. `costs` is [E]: seamCosts(). Throws Cancelled.
std::vector<std::uint32_t> suggestedCut(const Surface& surface, const Chart& chart,
                                        std::span<const float> costs, Job& job);

/// Applies suggestedCut() until every chart is a disk; `added` receives the edges cut.
Charts makeDisks(const Surface& surface, Seams& seams, std::span<const float> costs, Job& job,
                 std::vector<std::uint32_t>* added = nullptr);

}  // namespace prt
