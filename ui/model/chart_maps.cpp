#include "ui/model/chart_maps.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <chrono>
#include <mutex>

namespace prt::ui {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenMaps = std::chrono::milliseconds(60);  // that are told, of one chart
constexpr int kRoughTexels = 64;
constexpr std::size_t kFew = 200;  // charts that are packed in a moment

class Layer {
 public:
  Layer(const ChartWork& work, const ChartNews& news, Job& job)
      : work_(work),
        news_(news),
        job_(job),
        maps_(work.known),
        latest_(work.known),
        running_(work.charts->charts.size()) {}

  void run() {
    if (work_.live) return followCorners();
    suggest();
    layFlat();
    pack();
  }

 private:
  struct Running {
    std::unique_ptr<FlatChart> flat;
    std::unique_ptr<Flattening> map;
    Clock::time_point told;
    bool more = false;  // steps to be made
  };
  const std::vector<Chart>& charts() const { return work_.charts->charts; }
  FlattenOptions optionsOf(std::size_t c, const FlatChart& flat) const {
    FlattenOptions options =
        flattenOptionsFor(flat, work_.settings[c], flattenOptionsOf(work_.recipe.charts));
    options.name = chartName(c);
    return options;
  }

  // The boundary and what it drags along in one solve, then on towards the minimum.
  void followCorners() {
    LiveChart& live = *work_.live;
    const std::lock_guard alone(live.busy);
    const std::size_t c = work_.liveChart;
    try {
      if (!live.map) {
        live.flat = std::make_unique<FlatChart>(work_.on->surface, charts()[c], chartName(c));
        live.map = std::make_unique<Flattening>(*live.flat, optionsOf(c, *live.flat), job_);
      } else {
        live.map->setCorners(cornersAt(live.flat->rimLengths, work_.settings[c].corners), job_);
      }
      Clock::time_point told = tellMap(c, *live.map, false);
      bool first = true;
      while (live.map->step(job_)) {
        if (first || Clock::now() - told >= kBetweenMaps) told = tellMap(c, *live.map, false);
        first = false;
      }
      tellMap(c, *live.map, false);
    } catch (const Error& error) {
      live.map.reset();
      news_.failed(c, error.problem());
    }
  }

  void suggest() {
    for (std::size_t c = 0; c < charts().size(); ++c) {
      if (charts()[c].fault() == ChartFault::None) continue;
      std::vector<std::uint32_t> edges =
          suggestedCut(work_.on->surface, charts()[c], work_.on->alongCreases, job_);
      const std::lock_guard lock(mutex_);
      news_.suggested(c, std::move(edges));
    }
  }

  // First all of them a little, small ones first, then each to its end, large ones first.
  void layFlat() {
    std::vector<std::size_t> order;
    double triangles = 0;
    for (std::size_t c = 0; c < charts().size(); ++c) {
      if (maps_[c] || work_.leave[c]) continue;
      order.push_back(c);
      triangles += double(charts()[c].faces.size());
    }
    if (order.empty()) return;
    job_.begin("laying charts flat", 2 * triangles, "triangles");
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return charts()[a].faces.size() < charts()[b].faces.size();
    });
    each(order, [this](std::size_t c) { start(c); });
    if (work_.roughly && charts().size() <= kFew) packRoughly();
    job_.begin("laying charts flat", 2 * triangles, "triangles", triangles);
    std::reverse(order.begin(), order.end());
    each(order, [this](std::size_t c) { finish(c); });
  }

  template <class Step>
  void each(const std::vector<std::size_t>& order, const Step& step) {
    parallelFor(job_, 0, order.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        try {
          step(order[i]);
        } catch (const Error& error) {
          running_[order[i]] = {};
          const std::lock_guard lock(mutex_);
          latest_[order[i]].reset();
          news_.failed(order[i], error.problem());
        }
        job_.advance(double(charts()[order[i]].faces.size()));
      }
    });
  }

  void start(std::size_t c) {
    Running& run = running_[c];
    run.flat = std::make_unique<FlatChart>(work_.on->surface, charts()[c], chartName(c));
    run.map = std::make_unique<Flattening>(*run.flat, optionsOf(c, *run.flat), job_);
    tell(c, false);
    run.more = run.map->step(job_);
    tell(c, false);
  }

  void finish(std::size_t c) {
    Running& run = running_[c];
    if (!run.map) return;
    while (run.more && (run.more = run.map->step(job_)))
      if (Clock::now() - run.told >= kBetweenMaps) tell(c, false);
    run.map->finish(job_);
    tell(c, true);
    run = {};
  }

  void tell(std::size_t c, bool final) { running_[c].told = tellMap(c, *running_[c].map, final); }

  Clock::time_point tellMap(std::size_t c, const Flattening& from, bool final) {
    auto map = std::make_shared<FlatMap>();
    map->uv = from.uv();
    map->stretch = from.stretch();
    map->corners = from.corners();
    map->final = final;
    const std::lock_guard lock(mutex_);
    if (final) maps_[c] = map;
    latest_[c] = map;
    news_.map(c, std::move(map));
    return Clock::now();
  }

  std::vector<std::size_t> usable() const {
    std::vector<std::size_t> charts;
    for (std::size_t c = 0; c < latest_.size(); ++c)
      if (latest_[c]) charts.push_back(c);
    return charts;
  }

  // So that new charts are seen at once: coarsely, in a few directions, and no matter when they do not fit.
  void packRoughly() {
    if (usable().empty()) return;
    try {
      news_.packed(packSome(usable(), {.size = kRoughTexels, .gutter = 0, .turns = 4}));
    } catch (const Error&) {
    }
  }

  void pack() {
    if (usable().empty()) return;
    const bool all =
        std::all_of(maps_.begin(), maps_.end(), [](const FlatMapPtr& map) { return map != nullptr; });
    const AtlasRecipe& atlas = work_.recipe.atlas;
    try {
      news_.packed(all ? packAll() : packSome(usable(), {atlas.size, atlas.gutter, atlas.turns}));
    } catch (const Error& error) {
      news_.notPacked(error.what());
    }
  }

  PackedCharts packAll() {
    FlatCharts flat;
    flat.seams = work_.seams;
    flat.charts = *work_.charts;
    for (const FlatMapPtr& map : maps_) {
      flat.uv.push_back(map->uv);
      flat.stretch.push_back(map->stretch);
    }
    auto atlas = std::make_shared<Atlas>(
        packAtlas(flat, packingOf(work_.recipe, *work_.on->scene, flat, work_.settings), job_));
    PackedCharts packed{atlas->placements, atlas, {}};
    packed.facts = atlasFacts(work_.on->scene->mesh, work_.on->surface, *atlas, job_);
    return packed;
  }

  PackedCharts packSome(const std::vector<std::size_t>& which, const PackOptions& options) {
    std::vector<PackChart> outlines;
    std::vector<ChartPlacement> locked;
    for (const std::size_t c : which) {
      const StretchSum& s = latest_[c]->stretch;
      outlines.push_back(
          {outlineOf(charts()[c], latest_[c]->uv), charts()[c].area, s.flatArea, work_.settings[c].weight});
      locked.push_back(work_.settings[c].place.value_or(ChartPlacement{}));
    }
    const auto placed = packCharts(outlines, locked, options, job_);
    PackedCharts packed;
    packed.placements.assign(maps_.size(), ChartPlacement{.scale = 0});
    for (std::size_t i = 0; i < which.size(); ++i) packed.placements[which[i]] = placed[i];
    return packed;
  }

  const ChartWork& work_;
  const ChartNews& news_;
  Job& job_;
  std::vector<FlatMapPtr> maps_, latest_;  // final ones; those told last
  std::vector<Running> running_;
  std::mutex mutex_;
};

}  // namespace

void layCharts(const ChartWork& work, const ChartNews& news, Job& job) {
  Layer(work, news, job).run();
}

}  // namespace prt::ui
