// Cuts by hand, by suggestion, by itself and by imported coordinates: the half of the chart editor that
// changes seams.

#include "libprt/core/error.h"
#include "libprt/project/hand_cuts.h"
#include "ui/model/chart_mailbox.h"
#include "ui/model/session.h"

#include <QLocale>

#include <algorithm>
#include <array>
#include <utility>

namespace prt::ui {

namespace {

double distanceToEdge(const Surface& surface, std::uint32_t edge, const Vec3& point) {
  const UVec2 ends = surface.ends(edge);
  const DVec3 a(surface.positions[ends.x]), along = DVec3(surface.positions[ends.y]) - a,
                                            to = DVec3(point) - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(to, along) / square, 0.0, 1.0) : 0;
  return glm::length(to - t * along);
}

// "12 triangles lie over others, the first at u 0.25, v 0.5".
QStringList problemTexts(const std::vector<UvProblem>& problems) {
  QStringList lines;
  for (const auto kind : {UvProblem::Kind::Overlap, UvProblem::Kind::Flipped, UvProblem::Kind::Outside,
                          UvProblem::Kind::Missing}) {
    const auto is = [&](const UvProblem& p) { return p.kind == kind; };
    const auto first = std::find_if(problems.begin(), problems.end(), is);
    if (first == problems.end()) continue;
    const QString what = kind == UvProblem::Kind::Overlap ? QObject::tr("places where triangles overlap: %1")
                         : kind == UvProblem::Kind::Flipped ? QObject::tr("triangles turned over: %1")
                         : kind == UvProblem::Kind::Outside
                             ? QObject::tr("triangles outside of the square: %1")
                             : QObject::tr("triangles without area: %1");
    lines << QObject::tr("%1, the first at u %2, v %3")
                 .arg(what.arg(
                     QLocale().toString(qlonglong(std::count_if(problems.begin(), problems.end(), is)))))
                 .arg(double(first->at.x), 0, 'f', 3)
                 .arg(double(first->at.y), 0, 'f', 3);
  }
  return lines;
}

}  // namespace

void ChartEditor::setCutting(bool on) {
  if (on == cutting_) return;
  cutting_ = on;
  if (!on) path_.reset();
  setWatched(&touched_, on);  // the tool looks, whether or not the dock does
  touch(true);
  Q_EMIT cutChanged();
}

void ChartEditor::setFollowCreases(bool on) {
  if (on == followCreases_) return;
  followCreases_ = on;
  Q_EMIT cutChanged();
}

std::optional<std::uint32_t> ChartEditor::vertexAt(const SurfaceHit& hit) const {
  if (!on_ || hit.triangle >= on_->surface.triangleCount()) return {};
  const std::array<float, 3> weights{1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x,
                                     hit.barycentric.y};
  const auto most = std::max_element(weights.begin(), weights.end()) - weights.begin();
  return on_->surface.triangles[hit.triangle][int(most)];
}

std::optional<std::uint32_t> ChartEditor::cutEdgeAt(const SurfaceHit& hit) const {
  if (!on_ || hit.triangle >= on_->surface.triangleCount()) return {};
  const Surface& surface = on_->surface;
  std::optional<std::uint32_t> nearest;
  double least = 0;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = surface.triangles[hit.triangle][k];
    for (std::uint32_t i = surface.spokeStart[v]; i < surface.spokeStart[v + 1]; ++i) {
      const std::uint32_t e = surface.spokes[i];
      if (!seams_[e]) continue;
      const double away = distanceToEdge(surface, e, hit.position);
      if (nearest && away >= least) continue;
      nearest = e;
      least = away;
    }
  }
  return nearest;
}

bool ChartEditor::onSeamOrBorder(std::uint32_t vertex) const {
  const Surface& surface = on_->surface;
  for (std::uint32_t i = surface.spokeStart[vertex]; i < surface.spokeStart[vertex + 1]; ++i)
    if (seams_[surface.spokes[i]] || surface.isBorder(surface.spokes[i])) return true;
  return false;
}

std::vector<std::uint32_t> ChartEditor::preview(std::uint32_t vertex) {
  if (!on_ || !path_ || path_->empty()) return {};
  Job patient;
  return path_->wayTo(vertex, followCreases_, patient);
}

void ChartEditor::click(std::uint32_t vertex) {
  if (!on_) return;
  if (!path_) path_.emplace(on_);
  if (path_->empty()) {
    path_->begin(vertex);
    Q_EMIT cutChanged();
    return;
  }
  if (vertex == path_->last()) return endPath();
  Job patient;
  const std::vector<std::uint32_t> way = path_->wayTo(vertex, followCreases_, patient);
  if (way.empty()) {
    Q_EMIT told(tr("There is no way over the surface to there."), true);
    return;
  }
  const bool ends = path_->closes(vertex) || onSeamOrBorder(vertex);
  Seams next = seams_;
  cutPath(on_->surface, way, next);
  path_->add(way);
  editSeams(tr("Cut"), next);
  if (ends) endPath();
  Q_EMIT cutChanged();
}

void ChartEditor::endPath() {
  if (!path_ || path_->empty()) return;
  path_->clear();
  Q_EMIT cutChanged();
}

void ChartEditor::takeBack() {
  if (!path_ || path_->empty()) return;
  if (path_->places().size() == 1) return endPath();
  if (session_.document().undoName() == tr("Cut")) session_.document().undo();
}

void ChartEditor::erase(std::uint32_t edge, bool alone) {
  if (!on_ || edge >= seams_.size() || !seams_[edge]) return;
  Seams next = seams_;
  if (alone)
    next.set(edge, false);
  else
    for (const std::uint32_t e : seamChain(on_->surface, seams_, edge)) next.set(e, false);
  endPath();
  editSeams(alone ? tr("Erase piece of cut") : tr("Erase cut"), next);
}

void ChartEditor::removeAllCuts() {
  if (!on_) return;
  endPath();
  editSeams(tr("Remove all cuts"), Seams(on_->surface));
}

void ChartEditor::applySuggestion(int chart) {
  if (!on_ || chart < 0 || chart >= int(items_.size()) || items_[std::size_t(chart)].suggestion.empty())
    return;
  Seams next = seams_;
  for (const std::uint32_t e : items_[std::size_t(chart)].suggestion) next.set(e);
  editSeams(tr("Cut as suggested"), next);
}

void ChartEditor::applyAllSuggestions() {
  if (!on_) return;
  Seams next = seams_;
  for (const ChartItem& item : items_)
    for (const std::uint32_t e : item.suggestion)
      if (!item.fault.isEmpty()) next.set(e);
  editSeams(tr("Cut as suggested"), next);
}

// Whatever cut before, these are cuts by hand now.
void ChartEditor::editSeams(const QString& name, const Seams& seams) {
  Recipe next = session_.document().recipe();
  next.charts.mode = ChartsMode::Manual;
  for (std::size_t o = 0; o < next.objects.size(); ++o)
    if (next.objects[o].visible) next.objects[o].seams = seamsOfObject(*on_->scene, on_->surface, seams, o);
  session_.document().edit(name, next);
}

void ChartEditor::autoCut() {
  if (!on_ || autoJob_) return;
  struct Result {
    Seams seams;
  };
  auto result = std::make_shared<Result>();
  const auto work = [result, on = on_,
                     options = autoCutOptionsOf(session_.document().recipe().charts)](Job& job) {
    result->seams = prt::autoCut(on->surface, on->alongCreases, options, job).seams;
  };
  const auto finish = [box = mailbox_, result, on = on_](const JobInfo& info) {
    if (!box->owner) return;
    ChartEditor& e = *box->owner;
    if (info.id != e.autoJob_) return;
    e.autoJob_ = 0;
    if (info.state == JobState::Failed) Q_EMIT e.told(info.error, true);
    if (info.state == JobState::Done && on == e.on_) {
      const Gesture gesture(e.session_.document(), tr("Cut automatically"));
      Recipe next = e.session_.document().recipe();
      for (ObjectRecipe& object : next.objects)
        if (object.visible) object.charts.clear();  // of charts that are no more
      e.session_.document().edit(tr("Cut automatically"), next);
      e.editSeams(tr("Cut automatically"), result->seams);
    }
    e.touch(true);
  };
  endPath();
  autoJob_ = session_.jobs().start(QStringLiteral("auto cut"), tr("Cut charts"), work, finish);
  touch(false);
}

bool ChartEditor::hasCoordinates() const {
  return on_ && !on_->scene->mesh.uv.empty();
}

void ChartEditor::useImported() {
  Recipe next = session_.document().recipe();
  next.charts.mode = ChartsMode::Imported;
  session_.document().edit(tr("Use imported coordinates"), next);
}

// The charts of the meshes' own coordinates: laid flat and packed already, or not one-to-one.
void ChartEditor::readImported() {
  makeItems();
  touch(true);
  Q_EMIT cutChanged();
  if (!hasCoordinates()) {
    error_ = tr("The mesh has no texture coordinates.");
    return;
  }
  struct Result {
    Seams seams;
    Charts charts;
    std::vector<FlatMapPtr> maps;
    ImportedAtlas imported;
    AtlasFacts facts;
  };
  auto result = std::make_shared<Result>();
  const auto work = [result, on = on_, recipe = session_.document().recipe()](Job& job) {
    const TriMesh& mesh = on->scene->mesh;
    result->imported = importAtlas(mesh, {recipe.atlas.size, recipe.atlas.gutter, recipe.atlas.turns}, job);
    const Atlas& atlas = result->imported.atlas;
    result->seams = seamsOfCoordinates(on->surface, atlas.uvTriangles);
    result->charts = makeCharts(on->surface, result->seams, job);
    for (const Chart& chart : result->charts.charts) {
      auto map = std::make_shared<FlatMap>();
      map->uv.resize(chart.vertices.size());
      for (std::size_t t = 0; t < chart.faces.size(); ++t)
        for (int k = 0; k < 3; ++k)
          map->uv[chart.triangles[t][k]] = DVec2(atlas.uv[atlas.uvTriangles[chart.faces[t]][k]]);
      std::vector<DVec3> at;
      for (const std::uint32_t v : chart.vertices) at.emplace_back(on->surface.positions[v]);
      map->stretch = stretchOf(at, map->uv, chart.triangles);
      map->final = true;
      result->maps.push_back(std::move(map));
    }
    if (result->imported.problems.empty()) result->facts = atlasFacts(mesh, on->surface, atlas, job);
  };
  const quint64 run = run_;
  job_ = session_.jobs().startQuietly(
      QStringLiteral("charts"), tr("Read texture coordinates"), work,
      [box = mailbox_, result, run](const JobInfo& info) {
        if (!box->owner || run != box->owner->run_) return;
        ChartEditor& e = *box->owner;
        e.job_ = 0;
        if (info.state == JobState::Failed) e.error_ = info.error;
        if (info.state != JobState::Done) return e.touch(true);
        e.seams_ = std::move(result->seams);
        e.charts_ = std::make_shared<Charts>(std::move(result->charts));
        e.seamLength_ = seamLength(e.on_->surface, e.seams_);
        e.makeItems();
        for (std::size_t c = 0; c < e.items_.size(); ++c) {
          ChartItem& item = e.items_[c];
          item.fault.clear();  // a tube may be laid out as a ring: it is one-to-one that counts
          item.settings.place.reset();
          item.map = result->maps[c];
          item.placement = ChartPlacement{};
          item.overlaps = false;
        }
        e.problems_ = problemTexts(result->imported.problems);
        for (const UvProblem& problem : result->imported.problems) {
          e.problemTriangles_.insert(problem.triangle);
          if (problem.other != kNowhere) e.problemTriangles_.insert(problem.other);
        }
        if (result->imported.problems.empty())
          e.atlas_ = std::make_shared<Atlas>(std::move(result->imported.atlas));
        e.facts_ = result->facts;
        e.touch(true);
        Q_EMIT e.cutChanged();
      });
}

}  // namespace prt::ui
