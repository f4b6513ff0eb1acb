// Places, weights and corners of single charts, and the atlas as a file: the half of the chart editor that
// changes settings.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_writer.h"
#include "libprt/project/hand_cuts.h"
#include "ui/model/chart_mailbox.h"
#include "ui/model/session.h"

#include <QFileInfo>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

// As the recipe writes it: a ten-millionth of the square is far below a texel.
ChartPlacement rounded(ChartPlacement p) {
  p.offset = {std::round(p.offset.x * 1e7) / 1e7, std::round(p.offset.y * 1e7) / 1e7};
  p.angle = radians(std::round(degrees(std::remainder(p.angle, 2 * kPi)) * 1e4) / 1e4);
  const double unit = std::pow(10.0, std::floor(std::log10(p.scale)) - 7);
  p.scale = rounded(p.scale, unit);
  p.locked = true;
  return p;
}

constexpr double kLeastScale = 1e-6, kMostAcross = 4;  // of the square: a chart cannot be made larger

}  // namespace

std::vector<ChartSettings> ChartEditor::allSettings() const {
  std::vector<ChartSettings> all;
  for (const ChartItem& item : items_) all.push_back(item.settings);
  return all;
}

void ChartEditor::writeSettings(const QString& name, const std::vector<ChartSettings>& settings) {
  if (!on_) return;
  Recipe next = session_.document().recipe();
  setChartSettings(next, *on_->scene, settings);
  session_.document().edit(name, next);
}

void ChartEditor::editSettings(const QString& name, int chart,
                               const std::function<void(ChartSettings&)>& change) {
  if (chart < 0 || chart >= int(items_.size())) return;
  std::vector<ChartSettings> all = allSettings();
  change(all[std::size_t(chart)]);
  writeSettings(name, all);
}

void ChartEditor::beginMove(const QString& name) {
  session_.document().beginGesture(name);
}

void ChartEditor::endMove() {
  session_.document().endGesture();
}

void ChartEditor::cancelMove() {
  session_.document().cancelGesture();
}

void ChartEditor::setPlacement(int chart, ChartPlacement placement) {
  if (chart < 0 || chart >= int(items_.size()) || chartsRecipe_.mode == ChartsMode::Imported) return;
  const ChartItem& moved = items_[std::size_t(chart)];
  if (!moved.map) return;
  DVec2 low(1e300), high(-1e300);
  for (const DVec2& p : moved.map->uv) low = min(low, p), high = max(high, p);
  const double across = std::max({high.x - low.x, high.y - low.y, 1e-300});
  placement.scale = std::clamp(placement.scale, kLeastScale, kMostAcross / across);
  // Everything else stays where it is: what is packed by itself would make room.
  std::vector<ChartSettings> all = allSettings();
  for (std::size_t c = 0; c < items_.size(); ++c)
    if (items_[c].placement && !all[c].place) all[c].place = rounded(*items_[c].placement);
  all[std::size_t(chart)].place = rounded(placement);
  writeSettings(tr("Move chart"), all);
}

void ChartEditor::setLocked(int chart, bool locked) {
  editSettings(locked ? tr("Lock chart") : tr("Unlock chart"), chart, [&](ChartSettings& s) {
    const auto& placement = items_[std::size_t(chart)].placement;
    s.locked = locked;
    if (locked && !s.place && placement) s.place = rounded(*placement);
  });
}

void ChartEditor::setWeight(int chart, double weight) {
  editSettings(tr("Weight of chart"), chart, [&](ChartSettings& s) {
    s.weight = std::clamp(weight, 1e-3, 1e3);
    if (!s.locked) s.place.reset();  // it is packed as large as it weighs
  });
}

void ChartEditor::packAll() {
  if (chartsRecipe_.mode == ChartsMode::Imported) return;
  std::vector<ChartSettings> all = allSettings();
  bool placed = false;
  for (ChartSettings& s : all)
    if (s.place && !s.locked) placed = true, s.place.reset();
  packed_.clear();
  if (placed)
    writeSettings(tr("Pack charts"), all);
  else
    work();
}

void ChartEditor::flattenAll() {
  if (chartsRecipe_.mode == ChartsMode::Imported) return;
  maps_.clear();
  failed_.clear();
  for (ChartItem& item : items_) {
    item.map.reset();
    item.error.clear();
  }
  placeAll();
  work();
}

std::vector<std::uint32_t> ChartEditor::cornersOf(int chart) const {
  if (chart < 0 || chart >= int(items_.size())) return {};
  const ChartItem& item = items_[std::size_t(chart)];
  const Chart& shape = charts_->charts[std::size_t(chart)];
  if (item.settings.corners.empty() || shape.loops.size() != 1)
    return item.map ? item.map->corners : std::vector<std::uint32_t>{};
  return cornersAt(boundaryLengths(chart), item.settings.corners);
}

std::vector<double> ChartEditor::boundaryLengths(int chart) const {
  const Chart& shape = charts_->charts[std::size_t(chart)];
  const auto& rim = shape.loops.front();
  const auto at = [&](std::size_t i) {
    return DVec3(on_->surface.positions[shape.vertices[rim[i % rim.size()]]]);
  };
  std::vector<double> lengths;
  for (std::size_t i = 0; i < rim.size(); ++i) lengths.push_back(glm::distance(at(i), at(i + 1)));
  return lengths;
}

void ChartEditor::setCorners(int chart, const std::vector<std::uint32_t>& corners, const QString& name) {
  if (chart < 0 || chart >= int(items_.size()) || charts_->charts[std::size_t(chart)].loops.size() != 1)
    return;
  const std::vector<double> lengths = boundaryLengths(chart);
  editSettings(name, chart, [&](ChartSettings& s) {
    s.cornerCount = 0;
    s.corners = placesOf(lengths, usableCorners(lengths, corners));
    for (double& place : s.corners) place = std::floor(place * 1e9) / 1e9;
  });
}

void ChartEditor::setCornerCount(int chart, int count) {
  editSettings(tr("Corners of chart"), chart, [&](ChartSettings& s) {
    s.corners.clear();
    s.cornerCount = count < 3 ? 0 : std::min(count, 64);
  });
}

void ChartEditor::exportCoordinates(const QString& file) {
  const bool overlaps =
      std::any_of(items_.begin(), items_.end(), [](const ChartItem& i) { return i.overlaps; });
  if (!atlas_ || overlaps) {
    Q_EMIT told(overlaps ? tr("Charts overlap: move them apart, or pack them.")
                         : tr("Not every chart is laid flat and packed yet."),
                true);
    return;
  }
  session_.jobs().start(
      QStringLiteral("export coordinates"), tr("Write %1").arg(QFileInfo(file).fileName()),
      [file, atlas = atlas_, on = on_](Job& job) {
        TriMesh mesh = on->scene->mesh;
        mesh.uv = atlas->uv;
        mesh.uvTriangles = atlas->uvTriangles;
        writeMesh(file.toStdString(), mesh, {}, job);
      },
      [box = mailbox_, file](const JobInfo& info) {
        if (!box->owner) return;
        if (info.state == JobState::Done)
          Q_EMIT box->owner->told(tr("Written: %1").arg(QFileInfo(file).fileName()), false);
        if (info.state == JobState::Failed) Q_EMIT box->owner->told(info.error, true);
      });
}

}  // namespace prt::ui
