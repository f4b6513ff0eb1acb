#include "ui/model/chart_editor.h"

#include "libprt/core/error.h"
#include "libprt/core/hash.h"
#include "libprt/project/hand_cuts.h"
#include "ui/model/chart_colors.h"
#include "ui/model/chart_mailbox.h"
#include "ui/model/session.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {

constexpr int kTellMilliseconds = 15, kPaintMilliseconds = 50;
constexpr std::size_t kKeptMaps = 4000;
constexpr std::size_t kAtOnce = 200000;  // triangles that are flooded while the interface waits: some 50 ms

// What tells one chart from another: its triangles and where it is cut.
Hash128 shapeOf(const Chart& chart) {
  Hasher hasher;
  hasher.add(chart.faces).add(chart.vertices);
  for (const auto& loop : chart.loops) hasher.add(loop);
  return hasher.result();
}

// And one flat map of it from another.
Hash128 keyOf(const Hash128& shape, const ChartSettings& settings, const ChartsRecipe& recipe) {
  Hasher hasher;
  hasher.add(shape);
  if (settings.hasCorners())
    hasher.add(settings.cornerCount).add(settings.corners);
  else if (recipe.boundary == ChartsBoundary::Polygon)
    hasher.add(recipe.corners);
  return hasher.result();
}

}  // namespace

QString nameOf(ChartShade shade) {
  switch (shade) {
    case ChartShade::Off:
      return QObject::tr("off");
    case ChartShade::Charts:
      return QObject::tr("charts");
    case ChartShade::Checker:
      return QObject::tr("checkerboard");
    case ChartShade::Stretch:
      return QObject::tr("stretch");
    case ChartShade::Density:
      return QObject::tr("texel density");
  }
  return {};
}

ChartEditor::ChartEditor(Session& session, QObject* parent)
    : QObject(parent), session_(session), mailbox_(std::make_shared<Mailbox>()) {
  mailbox_->owner = this;
  touched_.setSingleShot(true);
  touched_.setInterval(kTellMilliseconds);
  repaint_.setSingleShot(true);
  repaint_.setInterval(kPaintMilliseconds);
  connect(&touched_, &QTimer::timeout, this, [this] {
    if (overlapsStale_) findOverlaps();
    Q_EMIT changed();
  });
  connect(&repaint_, &QTimer::timeout, this, &ChartEditor::paint);
  connect(&session_.document(), &Document::opened, this, &ChartEditor::forget);
  connect(&session_.document(), &Document::recipeChanged, this, &ChartEditor::follow);
  connect(&session_.document(), &Document::stateChanged, this, [this] {
    if (!pending_ || session_.document().inGesture()) return;
    live_.reset();
    work();
  });
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &ChartEditor::follow);
}

ChartEditor::~ChartEditor() {
  const std::lock_guard lock(mailbox_->mutex);
  mailbox_->owner = nullptr;
}

void ChartEditor::setWatched(const QObject* who, bool watched) {
  const bool before = this->watched();
  if (watched)
    watchers_.insert(who);
  else
    watchers_.erase(who);
  if (before == this->watched()) return;
  if (this->watched()) follow();
  repaint_.start();
}

void ChartEditor::touch(bool surface) {
  if (!touched_.isActive()) touched_.start();
  if (surface && !repaint_.isActive()) repaint_.start();
}

// ---- reading ----

void ChartEditor::forget() {
  stopWork();
  cancelJob();
  path_.reset();
  on_.reset();
  scene_ = session_.relighter().scene();  // of what was open before
  seams_ = {};
  charts_ = std::make_shared<Charts>();
  items_.clear(), keys_.clear(), shapes_.clear(), maps_.clear(), packed_.clear(), failed_.clear();
  atlas_.reset();
  problems_.clear(), problemTriangles_.clear(), error_.clear();
  read_ = needsSurface_ = chartsStale_ = false;
  selectedFace_ = kNowhere;
  touch(true);
  Q_EMIT cutChanged();
}

void ChartEditor::follow() {
  if (!watched()) return;
  readScene();
  if (on_) readRecipe();
}

void ChartEditor::readScene() {
  const auto& scene = session_.relighter().scene();
  const float creases = session_.document().recipe().charts.creases;
  if (!scene || (scene == scene_ && (creases == creases_ || !on_))) return;
  scene_ = scene;
  creases_ = creases;
  needsSurface_ = true;
  auto made = std::make_shared<std::shared_ptr<const CutSurface>>();
  session_.jobs().startQuietly(
      QStringLiteral("chart surface"), tr("Read the surface for charts"),
      [made, scene, creases](Job& job) { *made = std::make_shared<const CutSurface>(scene, creases, job); },
      [box = mailbox_, made](const JobInfo& info) {
        if (box->owner && info.state == JobState::Done) box->owner->takeSurface(*made);
      });
}

void ChartEditor::takeSurface(std::shared_ptr<const CutSurface> on) {
  if (on->scene != scene_) return;
  needsSurface_ = false;
  on_ = std::move(on);
  path_.reset();
  read_ = false;
  readRecipe();
  Q_EMIT cutChanged();
}

void ChartEditor::readRecipe() {
  const Recipe& recipe = session_.document().recipe();
  std::vector<std::string> texts;
  for (const ObjectRecipe& object : recipe.objects) texts.push_back(object.seams);
  std::vector<ChartSettings> settings;
  try {
    settings = chartSettingsOf(recipe, *on_->scene);
    const bool cuts =
        !read_ || chartsStale_ || texts != seamTexts_ || recipe.charts.mode != chartsRecipe_.mode;
    if (!cuts && settings == settings_ && recipe.charts == chartsRecipe_ && recipe.atlas == atlasRecipe_)
      return;
    error_.clear();
    if (cuts) {
      chartsStale_ = false;
      seams_ = Seams(on_->surface);
      auto charts = std::make_shared<Charts>();
      problems_.clear(), problemTriangles_.clear();
      if (recipe.charts.mode == ChartsMode::Manual) {
        seams_ = drawnSeams(recipe, *on_->scene, on_->surface);
        chartsStale_ = on_->surface.triangleCount() > kAtOnce;
        Job patient;
        if (!chartsStale_) *charts = makeCharts(on_->surface, seams_, patient);
      }
      if (!chartsStale_) charts_ = std::move(charts);
      if (path_) path_->follow(seams_);
    }
    read_ = true;
  } catch (const Error& error) {  // the cut is of another mesh
    error_ = QString::fromUtf8(error.what());
    seams_ = Seams(on_->surface);
    charts_ = std::make_shared<Charts>();
    read_ = false;
  }
  seamTexts_ = std::move(texts);
  chartsRecipe_ = recipe.charts;
  atlasRecipe_ = recipe.atlas;
  settings_ = std::move(settings);
  seamLength_ = seamLength(on_->surface, seams_);
  stopWork();
  atlas_.reset();
  if (recipe.charts.mode == ChartsMode::Imported) return readImported();
  if (chartsStale_) return findCharts();
  makeItems();
  startWork();
  touch(true);
  Q_EMIT cutChanged();
}

// On large surfaces the flood runs behind the interface too; until it is done the old charts are shown.
void ChartEditor::findCharts() {
  auto found = std::make_shared<Charts>();
  const quint64 run = run_;
  job_ = session_.jobs().startQuietly(
      QStringLiteral("charts"), tr("Find charts"),
      [found, on = on_, seams = seams_](Job& job) { *found = makeCharts(on->surface, seams, job); },
      [box = mailbox_, found, run](const JobInfo& info) {
        if (!box->owner || run != box->owner->run_) return;
        ChartEditor& e = *box->owner;
        e.job_ = 0;
        if (info.state != JobState::Done) return e.touch(true);
        e.chartsStale_ = false;
        e.charts_ = found;
        e.makeItems();
        e.startWork();
        e.touch(true);
        Q_EMIT e.cutChanged();
      });
  touch(true);
  Q_EMIT cutChanged();
}

void ChartEditor::makeItems() {
  const std::size_t count = charts_->charts.size();
  const std::vector<ChartItem> before = std::move(items_);
  const std::vector<Hash128> shapesBefore = std::exchange(shapes_, {});
  std::map<Hash128, std::size_t> known;
  for (std::size_t c = 0; c < before.size() && c < shapesBefore.size(); ++c) known[shapesBefore[c]] = c;
  std::vector<ChartSettings> settings = settingsOfCharts(*charts_, settings_);
  items_.assign(count, {});
  keys_.clear();
  for (std::size_t c = 0; c < count; ++c) {
    const Chart& chart = charts_->charts[c];
    ChartItem& item = items_[c];
    item.settings = std::move(settings[c]);
    if (chart.fault() != ChartFault::None) item.fault = QString::fromStdString(faultText(chart));
    shapes_.push_back(shapeOf(chart));
    keys_.push_back(keyOf(shapes_[c], item.settings, chartsRecipe_));
    if (const auto final = maps_.find(keys_[c]); final != maps_.end()) item.map = final->second;
    if (const auto failed = failed_.find(keys_[c]); failed != failed_.end()) item.error = failed->second;
    const auto old = known.find(shapes_[c]);
    if (old == known.end()) continue;
    if (!item.map && before[old->second].map) {  // while corners move, what stood there last
      auto stale = std::make_shared<FlatMap>(*before[old->second].map);
      stale->final = false;
      item.map = std::move(stale);
    }
    item.suggestion = before[old->second].suggestion;
  }
  placeAll();
}

// Where the recipe puts it, else where it was packed last.
void ChartEditor::place(std::size_t chart) {
  ChartItem& item = items_[chart];
  item.placement.reset();
  if (!item.map) return;
  if (item.settings.place) {
    item.placement = item.settings.place;
  } else if (const auto packed = packed_.find(shapes_[chart]); packed != packed_.end()) {
    item.placement = packed->second;
  }
}

void ChartEditor::placeAll() {
  for (std::size_t c = 0; c < items_.size(); ++c) place(c);
  findOverlaps();
}

void ChartEditor::findOverlaps() {
  overlapsStale_ = false;
  constexpr int kCells = 512;
  std::vector<std::vector<DVec2>> outlines;
  std::vector<ChartPlacement> placements;
  std::vector<std::size_t> which;
  bool byHand = false;
  for (std::size_t c = 0; c < items_.size(); ++c) {
    items_[c].overlaps = false;
    if (!items_[c].map || !items_[c].placement) continue;
    byHand = byHand || items_[c].settings.place;
    outlines.push_back(outlineOf(charts_->charts[c], items_[c].map->uv));
    placements.push_back(*items_[c].placement);
    which.push_back(c);
  }
  if (!byHand) return;
  for (const PlacementProblem& problem : placementProblems(outlines, placements, kCells))
    items_[which[problem.chart]].overlaps = items_[which[problem.other]].overlaps = true;
}

// ---- working ----

void ChartEditor::startWork() {
  pending_ = false;
  if (items_.empty()) return;
  const bool flat = std::all_of(items_.begin(), items_.end(),
                                [](const ChartItem& i) { return i.bad() || (i.map && i.map->final); });
  // While a chart is dragged nothing but its place changes: the rest can wait.
  if (!session_.document().inGesture()) {
    live_.reset();
    return work();
  }
  if (!flat) followCorners();
  pending_ = true;
}

// Of a chart whose corner is dragged, previews only: the map that counts is made from the beginning when it
// is let go, as baking makes it.
void ChartEditor::followCorners() {
  std::optional<std::size_t> moved;
  for (std::size_t c = 0; c < items_.size(); ++c) {
    const ChartItem& item = items_[c];
    if (item.bad() || (item.map && item.map->final)) continue;
    if (moved || item.settings.corners.empty()) return work();
    moved = c;
  }
  if (!live_ || live_->shape != shapes_[*moved]) {
    live_ = std::make_shared<LiveChart>();
    live_->shape = shapes_[*moved];
  }
  work(live_, *moved);
}

void ChartEditor::work(std::shared_ptr<LiveChart> live, std::size_t liveChart) {
  stopWork();
  pending_ = false;
  if (!on_ || items_.empty()) return;
  auto request = std::make_shared<ChartWork>();
  request->on = on_;
  request->seams = seams_;
  request->charts = charts_;
  request->recipe = session_.document().recipe();
  request->live = std::move(live);
  request->liveChart = liveChart;
  for (const ChartItem& item : items_) {
    request->leave.push_back(item.bad());
    request->roughly = request->roughly || (!item.bad() && !item.placement);
    request->settings.push_back(item.settings);
    request->known.push_back(item.map && item.map->final ? item.map : nullptr);
  }
  const quint64 run = run_;
  const auto news = std::make_shared<ChartNews>();
  const auto box = mailbox_;
  // Results of a run that was overtaken are dropped.
  const auto post = [box, run](auto call) {
    box->post([run, call](ChartEditor& e) {
      if (run == e.run_) call(e);
    });
  };
  news->map = [post](std::size_t c, FlatMapPtr map) {
    post([c, map](ChartEditor& e) { e.takeMap(c, map); });
  };
  news->failed = [post](std::size_t c, const std::string& why) {
    post([c, why](ChartEditor& e) {
      e.items_[c].error = e.failed_[e.keys_[c]] = QString::fromStdString(why);
      e.items_[c].map.reset();
      e.items_[c].placement.reset();
      e.touch(true);
    });
  };
  news->suggested = [post](std::size_t c, std::vector<std::uint32_t> edges) {
    post([c, edges](ChartEditor& e) {
      e.items_[c].suggestion = edges;
      e.touch(false);
      Q_EMIT e.cutChanged();
    });
  };
  news->packed = [post](PackedCharts packed) { post([packed](ChartEditor& e) { e.takePacked(packed); }); };
  news->notPacked = [post](const std::string& why) {
    post([why](ChartEditor& e) {
      e.error_ = QString::fromStdString(why);
      e.touch(false);
    });
  };
  job_ = session_.jobs().startQuietly(
      QStringLiteral("charts"), tr("Lay charts flat"),
      [request, news](Job& job) { layCharts(*request, *news, job); },
      [box, run](const JobInfo&) {
        // Behind what the job told: that is queued.
        box->post([run](ChartEditor& e) {
          if (run != e.run_) return;
          e.job_ = 0;
          e.touch(true);
        });
      });
  touch(false);
}

void ChartEditor::stopWork() {
  ++run_;
  if (job_) session_.jobs().cancel(std::exchange(job_, 0));
}

void ChartEditor::takeMap(std::size_t chart, FlatMapPtr map) {
  ChartItem& item = items_[chart];
  item.map = map;
  if (map->final) {
    if (maps_.size() > kKeptMaps) maps_.clear();
    maps_[keys_[chart]] = std::move(map);
  }
  place(chart);
  overlapsStale_ = true;
  touch(shade_ == ChartShade::Stretch || shade_ == ChartShade::Checker || shade_ == ChartShade::Density);
}

void ChartEditor::takePacked(const PackedCharts& packed) {
  packed_.clear();
  for (std::size_t c = 0; c < items_.size(); ++c)
    if (packed.placements[c].scale > 0) packed_[shapes_[c]] = packed.placements[c];
  atlas_ = packed.atlas;
  facts_ = packed.facts;
  placeAll();
  touch(true);
}

void ChartEditor::cancelJob() {
  if (autoJob_) session_.jobs().cancel(std::exchange(autoJob_, 0));
  stopWork();
  touch(false);
}

// ---- what is shown ----

int ChartEditor::chartAt(std::uint32_t triangle) const {
  return triangle < charts_->chartOf.size() ? int(charts_->chartOf[triangle]) : -1;
}

int ChartEditor::selected() const {
  return chartAt(selectedFace_);
}

void ChartEditor::select(int chart) {
  const std::uint32_t face =
      chart >= 0 && chart < int(items_.size()) ? items_[std::size_t(chart)].settings.face : kNowhere;
  if (chart == selected() && (chart < 0) == (selectedFace_ == kNowhere)) return;
  selectedFace_ = face;
  if (face != kNowhere && on_) session_.selectObject(int(on_->scene->triangleObject[face]));
  touch(true);
  Q_EMIT selectionChanged();
}

void ChartEditor::setShade(ChartShade shade) {
  if (shade == shade_) return;
  shade_ = shade;
  touch(true);
}

ChartNumbers ChartEditor::numbers() const {
  ChartNumbers numbers;
  numbers.charts = int(items_.size());
  StretchSum sum;
  double most = 0;
  int stretched = -1;
  for (int c = 0; c < int(items_.size()); ++c) {
    const ChartItem& item = items_[std::size_t(c)];
    numbers.notDisks += item.bad();
    numbers.overlaps += item.overlaps;
    if (!item.map || !item.placement) continue;
    sum += item.map->stretch.scaled(item.placement->scale);
    const double l2 = item.map->stretch.l2(), excess = (l2 * l2 - 1) * item.map->stretch.area;
    if (excess > most) most = excess, stretched = c;
  }
  numbers.l2 = sum.l2();
  numbers.lInf = sum.lInf();
  if (movable() && settled() && numbers.l2 > autoCutOptionsOf(chartsRecipe_).stretch)
    numbers.stretched = stretched;
  if (on_ && !items_.empty()) numbers.seam = seamLength_ / std::sqrt(on_->surface.totalArea());
  if (atlas_) numbers.filled = facts_.filled;
  numbers.final = settled();
  return numbers;
}

std::vector<Rgb> ChartEditor::colors() const {
  if (!on_ || items_.empty()) return {};
  return chartColors(*on_, *charts_, items_, shade_, selected(), problemTriangles_);
}

// Colours and seams on the surface.
void ChartEditor::paint() {
  SurfacePaint paint;
  const bool shown = watched() && on_ && on_->scene == session_.relighter().scene();
  if (shown && (shade_ != ChartShade::Off || cutting_)) {
    if (shade_ != ChartShade::Off) paint.colors = colors();
    if (shade_ == ChartShade::Checker && !paint.colors.empty())
      paint.uv = chartCoordinates(on_->surface, *charts_, items_);
    paint.seams.color = Rgb(1.0f, 0.97f, 0.88f);
    paint.seams.hidden = 0.05f;
    for (const std::uint32_t e : seams_.edges()) {
      const UVec2 ends = on_->surface.ends(e);
      paint.seams.edges.push_back(on_->surface.positions[ends.x]);
      paint.seams.edges.push_back(on_->surface.positions[ends.y]);
    }
  }
  // A picture of the model takes longer than all else here: none without a reason.
  const SurfacePaint& old = session_.layers().paintOf(PaintOwner::Charts);
  const bool same = paint.colors == old.colors && paint.uv == old.uv && paint.seams.edges == old.seams.edges;
  if (!same) session_.layers().setPaint(PaintOwner::Charts, std::move(paint));
}

}  // namespace prt::ui
