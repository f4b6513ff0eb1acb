#include "ui/widgets/chart_view.h"

#include "ui/model/chart_colors.h"
#include "ui/widgets/distances.h"
#include "ui/widgets/theme.h"

#include "libprt/shade/color_map.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <utility>

namespace prt::ui {

namespace {

constexpr double kMargin = 10, kGrab = 8, kSnap = 6;  // pixels
constexpr double kTurnArm = 22;                       // pixels from the box to the handle that turns
constexpr double kTurnSnap = 2.5;                     // degrees around multiples of 15
constexpr double kZoomStep = 1.2, kLeastZoom = 10, kMostZoom = 1e6;
constexpr float kSquares = 32;

QColor toColor(const Rgb& c) {
  return QColor::fromRgbF(std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f),
                          std::clamp(c.z, 0.0f, 1.0f));
}

DVec2 turned(const DVec2& v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

}  // namespace

ChartView::ChartView(ChartEditor& charts, QWidget* parent) : QWidget(parent), charts_(charts) {
  setObjectName(QStringLiteral("chartView"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setToolTip(tr(
      "The charts in the atlas. Drag moves a chart, its box scales it, the handle turns it; a double click "
      "shows it alone. The wheel zooms, the middle button pans."));
  connect(&charts_, &ChartEditor::changed, this, &ChartView::follow);
  connect(&charts_, &ChartEditor::selectionChanged, this, [this] {
    if (one_) fitted_ = true;
    follow();
  });
}

void ChartView::follow() {
  stale_ = true;
  if (grip_ == Grip::Move || grip_ == Grip::Scale || grip_ == Grip::Turn || grip_ == Grip::Corner)
    if (chart_ >= int(charts_.items().size())) endDrag(false);
  update();
}

void ChartView::setShowsOne(bool one) {
  if (one == one_) return;
  endDrag(false);
  one_ = one;
  fitted_ = stale_ = true;
  hoveredCorner_ = -1;
  update();
  Q_EMIT showsOneChanged(one);
}

// ---- the plane ----

void ChartView::fit() {
  fitted_ = stale_ = true;
  update();
}

void ChartView::fitNow() {
  DVec2 low(0), high(1);
  const int chart = charts_.selected();
  if (one_ && chart >= 0 && charts_.items()[std::size_t(chart)].map) {
    low = DVec2(1e300), high = DVec2(-1e300);
    for (const DVec2& p : charts_.items()[std::size_t(chart)].map->uv) low = min(low, p), high = max(high, p);
  }
  const DVec2 size = max(high - low, DVec2(1e-12));
  middle_ = 0.5 * (low + high);
  zoom_ = std::min((width() - 2 * kMargin) / size.x, (height() - 2 * kMargin) / size.y);
}

QPointF ChartView::toView(const DVec2& p) const {
  return {0.5 * width() + (p.x - middle_.x) * zoom_, 0.5 * height() - (p.y - middle_.y) * zoom_};
}

DVec2 ChartView::toPlane(const QPointF& at) const {
  return {middle_.x + (at.x() - 0.5 * width()) / zoom_, middle_.y - (at.y() - 0.5 * height()) / zoom_};
}

ChartWindow ChartView::window() const {
  const double ratio = devicePixelRatioF();
  return {toPlane(QPointF(0, height())), 1 / (zoom_ * ratio), int(std::lround(width() * ratio)),
          int(std::lround(height() * ratio))};
}

bool ChartView::movable(int chart) const {
  return !one_ && chart >= 0 && chart < int(charts_.items().size()) && charts_.movable() &&
         charts_.items()[std::size_t(chart)].map && charts_.items()[std::size_t(chart)].placement &&
         !charts_.items()[std::size_t(chart)].settings.locked;
}

QRectF ChartView::boxOf(int chart, const ChartPlacement& placement) const {
  DVec2 low(1e300), high(-1e300);
  for (const DVec2& p : charts_.items()[std::size_t(chart)].map->uv) {
    const DVec2 q = placement(p);
    low = min(low, q), high = max(high, q);
  }
  return QRectF(toView({low.x, high.y}), toView({high.x, low.y}));
}

std::optional<QRectF> ChartView::scaleBox() const {
  const int chart = charts_.selected();
  if (!movable(chart)) return {};
  return boxOf(chart, *charts_.items()[std::size_t(chart)].placement);
}

std::optional<QPointF> ChartView::turnHandle() const {
  const auto box = scaleBox();
  if (!box) return {};
  const double above = box->top() - kTurnArm;
  return QPointF(box->center().x(), above > kGrab ? above : box->bottom() + kTurnArm);
}

QPointF ChartView::cornerAt(int corner) const {
  const int chart = charts_.selected();
  const auto corners = charts_.cornersOf(chart);
  if (corner < 0 || corner >= int(corners.size())) return {};
  const auto& rim = charts_.charts().charts[std::size_t(chart)].loops.front();
  return toView(charts_.items()[std::size_t(chart)].map->uv[rim[corners[std::size_t(corner)]]]);
}

// ---- painting ----

QString ChartView::emptyText() const {
  if (!charts_.ready()) return tr("Reading the surface\u2026");
  const int chart = charts_.selected();
  if (one_ && chart >= 0 && charts_.items()[std::size_t(chart)].map) return {};
  if (one_) return chart < 0 ? tr("Select a chart\nin the atlas or on the model.") : tr("Not laid flat yet.");
  if (charts_.items().empty())
    return tr("No charts yet.\nAuto cut makes them, or press K\nand draw cuts on the model.");
  const auto bad = [](const ChartItem& item) { return item.bad(); };
  if (std::all_of(charts_.items().begin(), charts_.items().end(), bad))
    return tr("No chart can be laid flat yet.\nCut further, or as suggested.");
  return {};
}

void ChartView::paintEvent(QPaintEvent*) {
  if (fitted_) fitNow();
  QPainter painter(this);
  painter.fillRect(rect(), theme().window);
  const int chart = charts_.selected();
  const bool nothing =
      charts_.items().empty() || (one_ && (chart < 0 || !charts_.items()[std::size_t(chart)].map));
  if (!nothing) {
    const ChartWindow w = window();
    if (std::exchange(stale_, false) || picture_.width() != w.width || picture_.height() != w.height) {
      const ChartPixels pixels = rasterCharts(charts_.charts(), charts_.items(), shownChart(), w);
      const auto shade = charts_.shade();
      const float squares = one_ ? float(kSquares * commonScale(charts_.items())) : kSquares;
      const auto colors =
          chartPixelColors(pixels, charts_.colors(), w, shade == ChartShade::Checker, squares,
                           theme().window.rgb(), one_ ? theme().window.rgb() : theme().field.rgb());
      picture_ = QImage(w.width, w.height, QImage::Format_RGB32);
      std::copy(colors.begin(), colors.end(), reinterpret_cast<std::uint32_t*>(picture_.bits()));
    }
    painter.drawImage(rect(), picture_);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  if (!one_) {
    painter.setPen(QPen(theme().line, 1));
    painter.setBrush(nothing ? QBrush(theme().field) : QBrush(Qt::NoBrush));
    painter.drawRect(QRectF(toView({0, 1}), toView({1, 0})));
  }
  if (!nothing) {
    paintOutlines(painter);
    if (one_)
      paintCorners(painter);
    else
      paintHandles(painter);
    paintLegend(painter);
  }
  if (const QString text = emptyText(); !text.isEmpty()) {
    painter.setPen(theme().muted);
    painter.drawText(rect(), Qt::AlignCenter, text);
  }
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

void ChartView::paintOutlines(QPainter& painter) const {
  QPainterPath plain, bad, chosen;
  for (int c = 0; c < int(charts_.items().size()); ++c) {
    const ChartItem& item = charts_.items()[std::size_t(c)];
    if ((one_ && c != charts_.selected()) || !item.map || (!one_ && !item.placement)) continue;
    const ChartPlacement placement = one_ ? ChartPlacement{} : *item.placement;
    QPainterPath& path = c == charts_.selected() && !one_ ? chosen : item.overlaps ? bad : plain;
    for (const auto& loop : charts_.charts().charts[std::size_t(c)].loops) {
      QPolygonF polygon;
      for (const std::uint32_t v : loop) polygon << toView(placement(item.map->uv[v]));
      path.addPolygon(polygon);
      path.closeSubpath();
    }
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(255, 247, 224, 190), 1));
  painter.drawPath(plain);
  painter.setPen(QPen(theme().failed, 1.25));
  painter.drawPath(bad);
  painter.setPen(QPen(QColor(0, 0, 0, 150), 3.5));
  painter.drawPath(chosen);
  painter.setPen(QPen(pictureTheme().accent, 2));
  painter.drawPath(chosen);
}

void ChartView::paintHandles(QPainter& painter) const {
  const auto box = scaleBox();
  if (!box) return;
  const QColor accent = pictureTheme().accent;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(accent, 1, Qt::DashLine));
  painter.drawRect(*box);
  const QPointF turn = *turnHandle();
  painter.drawLine(QPointF(turn.x(), turn.y() < box->top() ? box->top() : box->bottom()), turn);
  painter.setPen(QPen(QColor(0, 0, 0, 160), 1));
  painter.setBrush(accent);
  painter.drawEllipse(turn, 4.5, 4.5);
  for (const QPointF& corner : {box->topLeft(), box->topRight(), box->bottomLeft(), box->bottomRight()})
    painter.drawRect(QRectF(corner - QPointF(3.5, 3.5), QSizeF(7, 7)));
}

void ChartView::paintCorners(QPainter& painter) const {
  const auto corners = charts_.cornersOf(charts_.selected());
  for (int i = 0; i < int(corners.size()); ++i) {
    const bool hot = i == (grip_ == Grip::Corner ? corner_ : hoveredCorner_);
    painter.setPen(QPen(QColor(0, 0, 0, 170), 1.5));
    painter.setBrush(hot ? pictureTheme().accent : QColor(Qt::white));
    painter.drawEllipse(cornerAt(i), hot ? 6 : 4.5, hot ? 6 : 4.5);
  }
}

void ChartView::paintLegend(QPainter& painter) const {
  const ChartShade shade = charts_.shade();
  if (shade != ChartShade::Stretch && shade != ChartShade::Density) return;
  const QRectF bar(kMargin, height() - 16, 84, 6);
  const bool stretch = shade == ChartShade::Stretch;
  const QString low = stretch ? QStringLiteral("1") : tr("1/%1").arg(kMostDensity);
  const QString high = stretch ? QString::number(kMostStretch) : QStringLiteral("%1\u00d7").arg(kMostDensity);
  const QFontMetricsF metrics(painter.font());
  const double lowWidth = metrics.horizontalAdvance(low), highWidth = metrics.horizontalAdvance(high);
  painter.setPen(Qt::NoPen);
  painter.setBrush(pictureVeil());
  painter.drawRoundedRect(QRectF(bar.left() - 6, bar.top() - 6, bar.width() + lowWidth + highWidth + 24, 18),
                          3, 3);
  const QRectF scale = bar.translated(lowWidth + 4, 0);
  for (int i = 0; i < int(scale.width()); ++i) {
    const double t = (i + 0.5) / scale.width();
    painter.setBrush(toColor(stretch ? magnitudeColor(float(t)) : densityColor(t)));
    painter.drawRect(QRectF(scale.left() + i, scale.top(), 1.5, scale.height()));
  }
  painter.setPen(pictureTheme().text);
  painter.drawText(QRectF(bar.left(), bar.top() - 6, lowWidth, 18), Qt::AlignVCenter, low);
  painter.drawText(QRectF(scale.right() + 4, bar.top() - 6, highWidth + 4, 18), Qt::AlignVCenter, high);
}

// A square whatever is written below it: a column that is short of room would press it flat, in the middle of
// a drag.
void ChartView::resizeEvent(QResizeEvent*) {
  if (minimumHeight() != width()) setFixedHeight(width());
  stale_ = true;
}

// ---- mouse ----

ChartView::Grip ChartView::gripAt(const QPointF& at) {
  hoveredCorner_ = -1;
  if (one_) {
    const auto corners = charts_.cornersOf(charts_.selected());
    for (int i = 0; i < int(corners.size()); ++i)
      if (distance(cornerAt(i), at) <= kGrab) hoveredCorner_ = i;
    return hoveredCorner_ >= 0 && charts_.movable() ? Grip::Corner : Grip::None;
  }
  if (const auto turn = turnHandle(); turn && distance(*turn, at) <= kGrab) return Grip::Turn;
  if (const auto box = scaleBox())
    for (const QPointF& corner : {box->topLeft(), box->topRight(), box->bottomLeft(), box->bottomRight()})
      if (distance(corner, at) <= kGrab) return Grip::Scale;
  const int under = chartUnder(charts_.charts(), charts_.items(), -1, charts_.selected(), toPlane(at));
  return under >= 0 ? Grip::Move : Grip::None;
}

void ChartView::mousePressEvent(QMouseEvent* event) {
  setFocus();
  pressedAt_ = last_ = event->position();
  dragging_ = false;
  if (event->button() == Qt::MiddleButton) {
    grip_ = Grip::Pan;
    return;
  }
  if (event->button() != Qt::LeftButton || grip_ != Grip::None) return;
  grip_ = gripAt(event->position());
  if (grip_ == Grip::Move)
    charts_.select(
        chartUnder(charts_.charts(), charts_.items(), -1, charts_.selected(), toPlane(event->position())));
  chart_ = charts_.selected();
  corner_ = hoveredCorner_;
  if (grip_ == Grip::None) {
    grip_ = Grip::Pan;
    if (!one_) charts_.select(-1);
    return;
  }
  if (grip_ == Grip::Corner) cornersAtPress_ = charts_.cornersOf(chart_);
  if (grip_ != Grip::Corner && !movable(chart_)) grip_ = Grip::None;
  if (movable(chart_)) atPress_ = *charts_.items()[std::size_t(chart_)].placement;
}

void ChartView::beginDrag() {
  dragging_ = true;
  if (grip_ == Grip::Move) charts_.beginMove(tr("Move chart"));
  if (grip_ == Grip::Scale) charts_.beginMove(tr("Scale chart"));
  if (grip_ == Grip::Turn) charts_.beginMove(tr("Turn chart"));
  if (grip_ == Grip::Corner) charts_.beginMove(tr("Move corner"));
}

void ChartView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (grip_ == Grip::None) {
    if (event->buttons()) return;
    const int corner = hoveredCorner_;
    const Grip grip = gripAt(at);
    if (std::exchange(hovered_, grip) != grip || corner != hoveredCorner_) update();
    setCursor(grip == Grip::Move    ? Qt::SizeAllCursor
              : grip == Grip::Scale ? Qt::SizeFDiagCursor
              : grip == Grip::None  ? Qt::ArrowCursor
                                    : Qt::PointingHandCursor);
    return;
  }
  if (!dragging_) {
    if ((at - pressedAt_).manhattanLength() < QApplication::startDragDistance() / 2) return;
    beginDrag();
  }
  if (grip_ == Grip::Pan) {
    const QPointF moved = at - last_;
    middle_ -= DVec2(moved.x(), -moved.y()) / zoom_;
    fitted_ = false;
    stale_ = true;
  } else if (grip_ == Grip::Corner) {
    dragCorner(at);
  } else {
    dragChart(at, event->modifiers());
  }
  last_ = at;
  update();
}

void ChartView::dragChart(const QPointF& at, Qt::KeyboardModifiers modifiers) {
  const bool snap = !(modifiers & Qt::ControlModifier);
  // About the middle of the box that is seen; the pan of a view does not change while a chart is dragged.
  const DVec2 pivot = toPlane(boxOf(chart_, atPress_).center());
  const DVec2 local = turned(pivot - atPress_.offset, -atPress_.angle) / atPress_.scale;
  const DVec2 from = toPlane(pressedAt_) - pivot, to = toPlane(at) - pivot;
  ChartPlacement p = atPress_;
  if (grip_ == Grip::Move) {
    p.offset += to - from;
    if (snap) p.offset += snapped(p);
  } else if (grip_ == Grip::Scale) {
    p.scale *= std::max(glm::length(to), 1e-9) / std::max(glm::length(from), 1e-9);
  } else {
    p.angle += std::atan2(to.y, to.x) - std::atan2(from.y, from.x);
    const double step = radians(15.0), nearest = std::round(p.angle / step) * step;
    if (snap && (modifiers & Qt::ShiftModifier || std::abs(p.angle - nearest) < radians(kTurnSnap)))
      p.angle = nearest;
  }
  if (grip_ != Grip::Move) p.offset = pivot - p.scale * turned(local, p.angle);
  charts_.setPlacement(chart_, p);
}

// To the sides of the square and of other charts' boxes, a gutter away from them.
DVec2 ChartView::snapped(const ChartPlacement& placement) const {
  const QRectF box = boxOf(chart_, placement);
  const double gutter = charts_.gutter(), reach = kSnap / zoom_;
  const DVec2 low = toPlane(box.bottomLeft()), high = toPlane(box.topRight());
  DVec2 best(0), least(reach);
  const auto attract = [&](int axis, double mine, double line) {
    const double off = line - mine;
    if (std::abs(off) < least[axis]) least[axis] = std::abs(off), best[axis] = off;
  };
  const auto lines = [&](const DVec2& from, const DVec2& to, double apart) {
    for (int axis = 0; axis < 2; ++axis) {
      attract(axis, low[axis], to[axis] + apart);
      attract(axis, high[axis], from[axis] - apart);
      if (apart != gutter) continue;
      attract(axis, low[axis], from[axis]);  // flush with it
      attract(axis, high[axis], to[axis]);
    }
  };
  for (int axis = 0; axis < 2; ++axis) {
    attract(axis, low[axis], gutter);
    attract(axis, high[axis], 1 - gutter);
  }
  for (int c = 0; c < int(charts_.items().size()); ++c) {
    const ChartItem& item = charts_.items()[std::size_t(c)];
    if (c == chart_ || !item.map || !item.placement) continue;
    const QRectF other = boxOf(c, *item.placement);
    lines(toPlane(other.bottomLeft()), toPlane(other.topRight()), 2 * gutter);
  }
  return best;
}

std::optional<std::size_t> ChartView::boundaryAt(const QPointF& at, double reach) const {
  const int chart = charts_.selected();
  if (chart < 0 || !charts_.items()[std::size_t(chart)].map) return {};
  const Chart& shape = charts_.charts().charts[std::size_t(chart)];
  if (shape.loops.size() != 1) return {};
  std::optional<std::size_t> nearest;
  double least = reach;
  for (std::size_t i = 0; i < shape.loops[0].size(); ++i) {
    const double away = distance(toView(charts_.items()[std::size_t(chart)].map->uv[shape.loops[0][i]]), at);
    if (away < least) least = away, nearest = i;
  }
  return nearest;
}

// Along the boundary between its neighbours.
void ChartView::dragCorner(const QPointF& at) {
  const auto place = boundaryAt(at, 1e9);
  if (!place) return;
  std::vector<std::uint32_t> corners = cornersAtPress_;
  corners[std::size_t(corner_)] = std::uint32_t(*place);
  std::vector<std::uint32_t> sorted = corners;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = corners.size();
  // Still in the same order round the boundary, none on another.
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return;
  const auto first = std::size_t(std::min_element(corners.begin(), corners.end()) - corners.begin());
  for (std::size_t i = 0; i < n; ++i)
    if (corners[(first + i) % n] != sorted[i]) return;
  charts_.setCorners(chart_, sorted, tr("Move corner"));
}

void ChartView::endDrag(bool keep) {
  const Grip grip = std::exchange(grip_, Grip::None);
  if (!std::exchange(dragging_, false) || grip == Grip::Pan || grip == Grip::None) return;
  if (keep)
    charts_.endMove();
  else
    charts_.cancelMove();
}

void ChartView::mouseReleaseEvent(QMouseEvent*) {
  endDrag(true);
  update();
}

void ChartView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (!one_) {
    const int under =
        chartUnder(charts_.charts(), charts_.items(), -1, charts_.selected(), toPlane(event->position()));
    if (under < 0) return fit();
    charts_.select(under);
    return setShowsOne(true);
  }
  const int chart = charts_.selected();
  const auto place = boundaryAt(event->position(), kGrab);
  if (!place || !charts_.movable()) return setShowsOne(false);
  std::vector<std::uint32_t> corners = charts_.cornersOf(chart);
  if (std::find(corners.begin(), corners.end(), std::uint32_t(*place)) != corners.end()) return;
  corners.push_back(std::uint32_t(*place));
  charts_.setCorners(chart, corners, tr("Add corner"));
}

void ChartView::wheelEvent(QWheelEvent* event) {
  const DVec2 under = toPlane(event->position());
  zoom_ = std::clamp(zoom_ * std::pow(kZoomStep, event->angleDelta().y() / 120.0), kLeastZoom / 4, kMostZoom);
  middle_ += under - toPlane(event->position());
  fitted_ = false;
  stale_ = true;
  update();
  event->accept();
}

void ChartView::leaveEvent(QEvent*) {
  hovered_ = Grip::None;
  hoveredCorner_ = -1;
  update();
}

// ---- keys ----

void ChartView::nudge(const DVec2& texels) {
  const int chart = charts_.selected();
  if (!movable(chart)) return;
  ChartPlacement p = *charts_.items()[std::size_t(chart)].placement;
  p.offset += texels * charts_.texel();
  charts_.setPlacement(chart, p);
}

void ChartView::keyPressEvent(QKeyEvent* event) {
  const double step = event->modifiers() & Qt::ShiftModifier ? 10 : 1;
  switch (event->key()) {
    case Qt::Key_Escape:
      if (dragging_) {
        endDrag(false);
      } else if (one_) {
        setShowsOne(false);
      } else {
        charts_.select(-1);
      }
      return update();
    case Qt::Key_Home:
      return fit();
    case Qt::Key_Left:
      return nudge({-step, 0});
    case Qt::Key_Right:
      return nudge({step, 0});
    case Qt::Key_Up:
      return nudge({0, step});
    case Qt::Key_Down:
      return nudge({0, -step});
    case Qt::Key_Delete:
    case Qt::Key_Backspace: {
      std::vector<std::uint32_t> corners = charts_.cornersOf(charts_.selected());
      if (!one_ || hoveredCorner_ < 0 || corners.size() <= 3) return;
      corners.erase(corners.begin() + hoveredCorner_);
      hoveredCorner_ = -1;
      return charts_.setCorners(charts_.selected(), corners, tr("Remove corner"));
    }
    default:
      QWidget::keyPressEvent(event);
  }
}

QList<Binding> ChartView::bindings() {
  return {{tr("Drag"), tr("moves a chart; it snaps to others and to the square, not with Ctrl")},
          {tr("Drag the box's corner"), tr("scales it")},
          {tr("Drag the handle"), tr("turns it; with Shift in steps of 15\u00b0")},
          {tr("Arrows"), tr("move it by a texel, with Shift by ten")},
          {tr("Double click"), tr("shows a chart alone; on its boundary adds a corner")},
          {tr("Delete"), tr("removes the corner under the pointer")},
          {tr("Wheel, middle drag"), tr("zoom, pan; Home shows all")}};
}

}  // namespace prt::ui
