#pragma once
// What the chart editor does behind the interface: suggests cuts for charts that are no disks, lays the
// others flat, packs them. Results are told as they come, the first maps at once. Without Qt.

#include "libprt/core/hash.h"
#include "libprt/project/atlas_stages.h"
#include "ui/model/cut_path.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace prt::ui {

/// A chart's flat map, in lengths of the surface.
struct FlatMap {
  std::vector<DVec2> uv;  ///< of the chart's vertices
  StretchSum stretch;
  std::vector<std::uint32_t> corners;  ///< of the polygon, indices into the boundary; empty: it is free
  bool final = false;
};
using FlatMapPtr = std::shared_ptr<const FlatMap>;

/// All charts side by side.
struct PackedCharts {
  std::vector<ChartPlacement> placements;  ///< [charts]; scale 0: one that has no map
  std::shared_ptr<const Atlas> atlas;      ///< null while a chart has no map
  AtlasFacts facts;                        ///< of the atlas
};

/// A chart whose corners are being dragged. What was factored for it is kept from one place to the next.
struct LiveChart {
  Hash128 shape;    ///< says which chart it is
  std::mutex busy;  ///< one job at a time
  std::unique_ptr<FlatChart> flat;
  std::unique_ptr<Flattening> map;
};

struct ChartWork {
  std::shared_ptr<const CutSurface> on;
  Seams seams;
  std::shared_ptr<const Charts> charts;
  std::vector<ChartSettings> settings;  ///< [charts]
  std::vector<FlatMapPtr> known;        ///< [charts] null: to be laid flat
  std::vector<std::uint8_t> leave;      ///< [charts] no disk, or failed before
  Recipe recipe;                        ///< charts.* and atlas.*
  std::shared_ptr<LiveChart> live;  ///< then nothing but this chart follows its corners, and no map is final
  std::size_t liveChart = 0;        ///< its number
  bool roughly = false;             ///< pack the first maps too: some chart has no place yet
};

/// Called from any thread, one at a time.
struct ChartNews {
  std::function<void(std::size_t chart, FlatMapPtr map)> map;
  std::function<void(std::size_t chart, const std::string& why)> failed;
  std::function<void(std::size_t chart, std::vector<std::uint32_t> edges)> suggested;
  std::function<void(PackedCharts packed)> packed;
  std::function<void(const std::string& why)> notPacked;
};

/// All of it. Throws Cancelled.
void layCharts(const ChartWork& work, const ChartNews& news, Job& job);

}  // namespace prt::ui
