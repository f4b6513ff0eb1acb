#include "ui/viewport/surface_brush.h"

#include "ui/widgets/distances.h"

#include <QGuiApplication>
#include <QPainter>

#include <cmath>
#include <utility>

namespace prt::ui {

namespace {

constexpr double kStep = 5;     // pixels between places of a drag
constexpr int kMostSteps = 32;  // of one move of the mouse
constexpr double kClick = 4;    // pixels that a click may move

}  // namespace

SurfaceBrush::SurfaceBrush(Painting& painting, Brush brush, Pick pick, QObject* parent)
    : Manipulator(parent), painting_(painting), brush_(brush), pick_(std::move(pick)) {
  setEnabled(painting_.brush() == brush_);
  connect(&painting_, &Painting::brushChanged, this, [this] {
    under_.reset(), pointer_.reset(), last_.reset();
    setEnabled(painting_.brush() == brush_);
  });
}

std::optional<SurfaceHit> SurfaceBrush::hitAt(const QPointF& at) const {
  auto hit = pick_(at);
  if (hit && hit->back) hit.reset();
  return hit;
}

bool SurfaceBrush::hover(std::optional<QPointF> at, const ViewGeometry& view) {
  const bool had = std::exchange(pointer_, at).has_value();
  takesAway_ = QGuiApplication::keyboardModifiers() & Qt::ControlModifier;
  under_ = at && painting_.on() ? hitAt(*at) : std::nullopt;
  if (had || at) {
    hovered(view);
    Q_EMIT changed();
  }
  return under_.has_value();
}

bool SurfaceBrush::press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry&) {
  // Shift turns the environment.
  if (!painting_.on() || (modifiers != Qt::NoModifier && modifiers != Qt::ControlModifier)) return false;
  const auto hit = hitAt(at);
  if (!hit) return false;
  takesAway_ = modifiers & Qt::ControlModifier;
  pressedAt_ = at;
  pointer_ = last_ = at;
  under_ = hit;
  moved_ = false;
  begin(*hit, takesAway_);
  return true;
}

void SurfaceBrush::move(const QPointF& at, Qt::KeyboardModifiers, const ViewGeometry&) {
  if (!last_) return;
  moved_ = moved_ || distance(at, pressedAt_) >= kClick;
  const QPointF from = *last_;
  const int steps = std::clamp(int(std::ceil(distance(from, at) / kStep)), 1, kMostSteps);
  for (int i = 1; i <= steps; ++i) {
    under_ = hitAt(from + (at - from) * (double(i) / steps));
    if (under_) goOn(*under_);
  }
  pointer_ = last_ = at;
  Q_EMIT changed();
}

void SurfaceBrush::release(const QPointF& at, const ViewGeometry& view) {
  if (!last_) return;
  if (at != *last_) move(at, {}, view);
  last_.reset();
  if (moved_)
    finish();
  else
    click(at, view);
  Q_EMIT changed();
}

void SurfaceBrush::cancel() {
  if (std::exchange(last_, std::nullopt)) drop();
  Q_EMIT changed();
}

bool SurfaceBrush::keyPress(int key) {
  if (key != Qt::Key_Escape) return false;
  painting_.take(Brush::None);
  return true;
}

void SurfaceBrush::paintRing(QPainter& painter, const ViewGeometry& view, float radius,
                             const QColor& color) const {
  const auto& on = painting_.on();
  if (!under_ || !on || under_->triangle >= on->surface.triangleCount()) return;
  constexpr int kSides = 48;
  const Frame frame = frameFromNormal(on->normalAt({under_->triangle, under_->barycentric}));
  QPolygonF ring;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    const auto at = view.project(under_->position + radius * (float(std::cos(angle)) * frame.tangent +
                                                              float(std::sin(angle)) * frame.bitangent));
    if (!at) return;
    ring << *at;
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 120), 3));
  painter.drawPolygon(ring);
  painter.setPen(QPen(color, 1.25));
  painter.drawPolygon(ring);
}

}  // namespace prt::ui
