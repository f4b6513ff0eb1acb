#include "ui/viewport/cut_tool.h"

#include "ui/model/scene_rays.h"
#include "ui/widgets/distances.h"
#include "ui/widgets/theme.h"

#include <QGuiApplication>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace prt::ui {

namespace {

constexpr double kCatch = 9;        // pixels from which a clicked vertex or a seam is caught
constexpr double kEraseReach = 14;  // pixels from a cut that erasing takes
constexpr double kFaint = 0.22;     // opacity of what the model hides
constexpr float kLift = 3e-3f;      // of the distance to the eye, towards it

QColor suggestedColor() {
  return QColor(0x6f, 0xc3, 0xdf);
}

}  // namespace

CutTool::CutTool(ChartEditor& charts, const SceneRays& rays, Pick pick, QObject* parent)
    : Manipulator(parent), charts_(charts), rays_(rays), pick_(std::move(pick)) {
  setEnabled(charts_.cutting());
  connect(&charts_, &ChartEditor::cutChanged, this, [this] {
    const bool cutting = charts_.cutting() && charts_.ready();
    if (!cutting || (hovered_ && *hovered_ >= charts_.on()->surface.vertexCount())) hovered_.reset();
    hoveredCut_.reset();
    setEnabled(charts_.cutting());
    Q_EMIT changed();
  });
}

bool CutTool::hidden(const Vec3& point, const ViewGeometry& view) const {
  const Vec3 eye = view.sightTo(point).origin;
  return rays_.blocked(eye, point + kLift * (eye - point));
}

// ---- painting ----

void CutTool::paint(QPainter& painter, const ViewGeometry& view) {
  if (!charts_.ready()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = pictureTheme();
  for (const ChartItem& item : charts_.items())
    if (!item.fault.isEmpty()) paintEdges(painter, view, item.suggestion, suggestedColor(), Qt::DashLine);
  if (hoveredCut_) {
    const bool alone = modifiers_ & Qt::ShiftModifier;
    const std::vector<std::uint32_t> chain =
        alone ? std::vector{*hoveredCut_} : seamChain(charts_.on()->surface, charts_.seams(), *hoveredCut_);
    paintEdges(painter, view, chain, t.failed, Qt::SolidLine);
  }
  const CutPath* path = charts_.path();
  if (hovered_ && !hoveredCut_) {
    if (path && !path->empty()) paintWay(painter, view, charts_.preview(*hovered_), t.accent, Qt::SolidLine);
    paintDot(painter, view, *hovered_, 4, t.accent);
  }
  if (path)
    for (const std::uint32_t place : path->places())
      paintDot(painter, view, place, place == path->last() ? 5 : 3.5,
               place == path->last() ? t.accent : t.text);
  painter.restore();
}

void CutTool::paintWay(QPainter& painter, const ViewGeometry& view, const std::vector<std::uint32_t>& way,
                       const QColor& color, Qt::PenStyle style) const {
  const Surface& surface = charts_.on()->surface;
  std::vector<std::uint32_t> edges;
  for (std::size_t i = 1; i < way.size(); ++i) edges.push_back(surface.edgeBetween(way[i - 1], way[i]));
  paintEdges(painter, view, edges, color, style);
}

void CutTool::paintEdges(QPainter& painter, const ViewGeometry& view, const std::vector<std::uint32_t>& edges,
                         const QColor& color, Qt::PenStyle style) const {
  const Surface& surface = charts_.on()->surface;
  for (const std::uint32_t e : edges) {
    if (e == kNowhere || e >= surface.edgeCount()) continue;
    const UVec2 ends = surface.ends(e);
    const Vec3 &a = surface.positions[ends.x], &b = surface.positions[ends.y];
    const auto from = view.project(a), to = view.project(b);
    if (!from || !to) continue;
    painter.setOpacity(hidden(0.5f * (a + b), view) ? kFaint : 1);
    painter.setPen(QPen(QColor(0, 0, 0, 140), 4.5, Qt::SolidLine, Qt::RoundCap));
    if (style == Qt::SolidLine) painter.drawLine(*from, *to);
    painter.setPen(QPen(color, 2.25, style, Qt::RoundCap));
    painter.drawLine(*from, *to);
  }
}

void CutTool::paintDot(QPainter& painter, const ViewGeometry& view, std::uint32_t vertex, double radius,
                       const QColor& color) const {
  const Vec3& point = charts_.on()->surface.positions[vertex];
  const auto at = view.project(point);
  if (!at) return;
  painter.setOpacity(hidden(point, view) ? kFaint : 1);
  painter.setPen(QPen(QColor(0, 0, 0, 160), 1.5));
  painter.setBrush(color);
  painter.drawEllipse(*at, radius, radius);
}

// ---- mouse ----

std::optional<std::uint32_t> CutTool::vertexAt(const QPointF& at, const ViewGeometry& view) const {
  const auto hit = pick_(at);
  if (!hit || !charts_.ready() || hit->back) return {};
  const auto nearest = charts_.vertexAt(*hit);
  if (!nearest) return {};
  const Surface& surface = charts_.on()->surface;
  const auto away = [&](std::uint32_t vertex) {
    const auto place = view.project(surface.positions[vertex]);
    return place ? distance(*place, at) : 1e9;
  };
  if (const CutPath* path = charts_.path())
    for (const std::uint32_t place : path->places())
      if (away(place) <= kCatch) return place;
  // A vertex of a seam near by: of those around the triangle.
  std::optional<std::uint32_t> caught;
  double least = kCatch;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = surface.triangles[hit->triangle][k];
    for (std::uint32_t i = surface.spokeStart[v]; i < surface.spokeStart[v + 1]; ++i) {
      const std::uint32_t other = surface.across(surface.spokes[i], v);
      if (away(other) < least && charts_.onSeamOrBorder(other)) caught = other, least = away(other);
    }
  }
  return caught ? caught : nearest;
}

std::optional<std::uint32_t> CutTool::cutEdgeAt(const QPointF& at, const ViewGeometry& view) const {
  const auto hit = pick_(at);
  if (!hit) return {};
  const auto edge = charts_.cutEdgeAt(*hit);
  if (!edge) return {};
  const Surface& surface = charts_.on()->surface;
  const UVec2 ends = surface.ends(*edge);
  const auto from = view.project(surface.positions[ends.x]), to = view.project(surface.positions[ends.y]);
  return from && to && distanceToPiece(at, *from, *to) <= kEraseReach ? edge : std::nullopt;
}

bool CutTool::hover(std::optional<QPointF> at, const ViewGeometry& view) {
  modifiers_ = QGuiApplication::keyboardModifiers();
  std::optional<std::uint32_t> vertex, cut;
  if (at && charts_.ready()) {
    if (modifiers_ & Qt::ControlModifier)
      cut = cutEdgeAt(*at, view);
    else
      vertex = vertexAt(*at, view);
  }
  const bool same = vertex == hovered_ && cut == hoveredCut_;
  hovered_ = vertex;
  hoveredCut_ = cut;
  if (!same) Q_EMIT changed();
  return vertex || cut;
}

bool CutTool::press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) {
  if (!charts_.ready()) return false;
  modifiers_ = modifiers;
  const bool erases = modifiers & Qt::ControlModifier;
  if (!erases && modifiers != Qt::NoModifier) return false;  // Shift turns the environment
  if (erases ? !cutEdgeAt(at, view) : !vertexAt(at, view)) return false;
  pressedAt_ = at;
  return true;
}

void CutTool::move(const QPointF& at, Qt::KeyboardModifiers, const ViewGeometry& view) {
  if (modifiers_ & Qt::ControlModifier) return;
  const auto vertex = vertexAt(at, view);
  if (std::exchange(hovered_, vertex) != vertex) Q_EMIT changed();
}

// A drag is a click where it ends: the hand may shake, or look for the place with the button down.
void CutTool::release(const QPointF& at, const ViewGeometry& view) {
  if (!std::exchange(pressedAt_, std::nullopt)) return;
  if (modifiers_ & Qt::ControlModifier) {
    if (const auto edge = cutEdgeAt(at, view)) charts_.erase(*edge, modifiers_ & Qt::ShiftModifier);
  } else if (const auto vertex = vertexAt(at, view)) {
    charts_.click(*vertex);
  }
}

void CutTool::cancel() {
  pressedAt_.reset();
}

bool CutTool::doubleClick(const QPointF& at, const ViewGeometry& view) {
  if (!charts_.path() || charts_.path()->empty() || !vertexAt(at, view)) return false;
  charts_.endPath();
  return true;
}

bool CutTool::keyPress(int key) {
  const bool drawing = charts_.path() && !charts_.path()->empty();
  switch (key) {
    case Qt::Key_Escape:
      if (drawing)
        charts_.endPath();
      else
        charts_.setCutting(false);
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      charts_.endPath();
      return true;
    case Qt::Key_Backspace:
      if (!drawing) return false;
      charts_.takeBack();
      return true;
    default:
      return false;
  }
}

QString CutTool::hint() const {
  if (!charts_.ready()) return tr("Reading the surface\u2026");
  if (hoveredCut_) return tr("Click erases this cut as far as it goes; with Shift this piece alone");
  if (charts_.path() && !charts_.path()->empty())
    return tr(
        "Click cuts to there   \u00b7   on the first point it closes the loop   \u00b7   Enter ends   \u00b7 "
        "  "
        "Backspace takes back");
  return tr("Click where the cut begins   \u00b7   Ctrl erases   \u00b7   Esc leaves");
}

QList<Binding> CutTool::bindings() const {
  return {{tr("K, then click"), tr("cut charts: from click to click, the shortest way over the surface")},
          {tr("Ctrl click"), tr("while cutting: erase a cut; with Shift one edge of it")},
          {tr("Enter, Esc"), tr("while cutting: end the path; leave the tool")}};
}

}  // namespace prt::ui
