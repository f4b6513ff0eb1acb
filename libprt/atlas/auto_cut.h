#pragma once
// Charts for who does not want to cut: few disks whose seams lie in creases and valleys, laid flat with the
// stretch of all of them together below a bound.
//
// The surface is taken apart into small compact clusters; a coarse copy of them is merged greedily, always
// the seam whose mending costs least stretch for its visible length, until the bound is met; the seams are
// carried over to the surface, edge by edge, and drawn tight; the charts are laid flat, and those that
// stretch more than the coarse copy foretold are cut again where they were joined last.

#include "libprt/atlas/flatten.h"

#include <functional>
#include <string>

namespace prt {

struct AutoCutOptions {
  double stretch = 1.10;       ///< L2 stretch over all charts together, more than 1
  double chartStretch = 1.30;  ///< of a single chart
  std::size_t clusters = 0;    ///< to start from; 0 = by the number of triangles
  FlattenOptions flatten;      ///< of each chart; its boundary is free unless it says otherwise
};

struct FlatCharts {
  Seams seams;
  Charts charts;
  std::vector<std::vector<DVec2>> uv;  ///< of each chart's vertices, in lengths of the surface
  std::vector<StretchSum> stretch;     ///< of each chart
  StretchSum total() const;
};

/// Called when a chart has been laid flat, from any thread, one at a time.
using ChartPreview = std::function<void(std::size_t chart, const std::vector<DVec2>& uv)>;

/// One line that names the chart which adds most when the charts together stretch more than a bound; empty
/// when they keep it.
std::string boundMissed(const FlatCharts& charts, double bound);

/// `costs` is seamCosts(), or any weights of your own per edge, smaller where a seam is seen less. What
/// cannot keep to the bound is cut until it does (logged as boundMissed() says should that ever fail).
/// Deterministic, whatever the number of threads. Throws GeometryError, which names the chart, when one
/// cannot be laid flat; Cancelled.
FlatCharts autoCut(const Surface& surface, std::span<const float> costs, const AutoCutOptions& options,
                   Job& job);

/// How one chart is to be laid flat.
using ChartOptions = std::function<FlattenOptions(std::size_t chart, const FlatChart& flat)>;

/// Lays charts flat, in parallel. Throws GeometryError that names the first one that cannot be.
FlatCharts flattenCharts(const Surface& surface, const Seams& seams, const FlattenOptions& options, Job& job,
                         const ChartPreview& preview = {});
/// The same of charts that are made already, makeCharts() of the seams, each in its own way.
FlatCharts flattenCharts(const Surface& surface, const Seams& seams, Charts charts,
                         const ChartOptions& optionsOf, Job& job, const ChartPreview& preview = {});

}  // namespace prt
