#include "ui/viewport/viewport.h"

#include "ui/model/session.h"
#include "ui/model/error_estimate.h"
#include "ui/viewport/cpu_canvas.h"
#include "ui/viewport/error_legend.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/viewport/manipulator.h"
#include "ui/viewport/overlay.h"

#include <QContextMenuEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <utility>

namespace prt::ui {

namespace {
constexpr float kDegreesPerPixel = 0.4f;  // of turning the environment
constexpr int kSettleMilliseconds = 180;
}  // namespace

Viewport::Viewport(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName(QStringLiteral("viewport"));
  setFocusPolicy(Qt::StrongFocus);
  setAcceptDrops(true);
  setMouseTracking(true);
  setMinimumSize(320, 240);
  settle_.setSingleShot(true);
  settle_.setInterval(kSettleMilliseconds);
  connect(&settle_, &QTimer::timeout, this, [this] {
    if (drag_ == Drag::None) canvas_->setInteracting(false);
  });
  chooseCanvas();
  connect(&session_.relighter(), &Relighter::changed, this, &Viewport::refresh);
  connect(&session_.view(), &ViewState::changed, this, &Viewport::refresh);
  connect(&session_, &Session::statusChanged, this, &Viewport::refresh);
  connect(&session_.layers(), &SurfaceLayers::changed, this, &Viewport::refresh);
  connect(&session_.errors(), &ErrorEstimate::changed, this, &Viewport::refresh);
}

void Viewport::chooseCanvas() {
  if (!GlCanvas::available()) return useCpu(tr("this machine has no OpenGL 4.5"));
  auto* canvas =
      new GlCanvas({session_.relighter(), session_.view(), session_.layers(),
                   [this](QPainter& p) { paintOver(p); }}, this);
  canvas_ = canvas;
  connect(
      canvas, &GlCanvas::failed, this, [this](const QString& message) { useCpu(message); },
      Qt::QueuedConnection);
}

void Viewport::useCpu(const QString& why) {
  if (canvas_) canvas_->widget()->deleteLater();
  auto* canvas =
      new CpuCanvas({session_.relighter(), session_.view(), session_.layers(),
                   [this](QPainter& p) { paintOver(p); }}, this);
  canvas_ = canvas;
  canvas->setGeometry(rect());
  canvas->show();
  session_.report(Severity::Warning, tr("The viewport draws with the CPU: %1.").arg(why));
}

QString Viewport::hint() const {
  switch (drag_) {
    case Drag::Orbit:
      return tr("Orbiting \u2014 Shift pans");
    case Drag::Pan:
      return tr("Panning");
    case Drag::TurnLight:
      return tr("Turning the environment: %1\u00b0").arg(session_.environmentAngle(), 0, 'f', 1);
    case Drag::None:
      break;
  }
  for (const Manipulator* each : {held_, hovered_})
    if (each && !each->hint().isEmpty()) return each->hint();
  return tr(
      "Shift+drag turns the light   \u00b7   Alt+drag or middle orbits   \u00b7   +Shift pans   \u00b7   "
      "wheel zooms   \u00b7   F frames   \u00b7   R resets");
}

QList<Binding> Viewport::bindings() const {
  QList<Binding> all{{tr("Shift + drag"), tr("turn the environment, with either button")},
                     {tr("Alt + drag or Middle drag"), tr("orbit; with Shift as well, pan")},
                     {tr("Wheel"), tr("zoom towards the pointer")}};
  for (const Manipulator* each : manipulators_) all << each->bindings();
  all << Binding{tr("Drop"), tr("a mesh or project opens, an HDR becomes the light")};
  return all;
}

void Viewport::setPictureMode(bool on) {
  pictureMode_ = on;
  canvas_->setThorough(on);
}

void Viewport::resizeEvent(QResizeEvent*) {
  canvas_->widget()->setGeometry(rect());
}

Viewport::Drag Viewport::dragOf(Qt::MouseButton button, Qt::KeyboardModifiers modifiers) const {
  const bool shift = modifiers & Qt::ShiftModifier, alt = modifiers & Qt::AltModifier;
  if (button == Qt::MiddleButton || (alt && button == Qt::LeftButton)) return shift ? Drag::Pan : Drag::Orbit;
  if (shift && (button == Qt::LeftButton || button == Qt::RightButton)) return Drag::TurnLight;
  return Drag::None;
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  setFocus();
  if (drag_ != Drag::None || held_ || pressManipulator(event)) return;
  drag_ = dragOf(event->button(), event->modifiers());
  if (drag_ == Drag::None) return;
  dragButton_ = event->button();
  last_ = event->position();
  if (drag_ == Drag::TurnLight) session_.document().beginGesture(tr("Turn environment"));
  interact();
  Q_EMIT hintChanged(hint());
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  if (held_) {
    held_->move(event->position(), event->modifiers(), {session_.view().camera(), size()});
    interact();
    Q_EMIT hintChanged(hint());
    return;
  }
  if (drag_ == Drag::None) return hoverManipulators(event->position());
  const QPointF moved = event->position() - last_;
  last_ = event->position();
  const float scale = 1.0f / float(height());
  const float dx = float(moved.x()), dy = float(moved.y());
  if (drag_ == Drag::Orbit) session_.view().orbit(dx * scale, dy * scale);
  if (drag_ == Drag::Pan) session_.view().pan(dx * scale, dy * scale);
  if (drag_ == Drag::TurnLight) turnLight(dx);
  interact();
  Q_EMIT hintChanged(hint());
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (held_ && event->button() == Qt::LeftButton) return letGo(true, event->position());
  if (event->button() == dragButton_) endDrag();
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
  const ViewGeometry view(session_.view().camera(), size());
  for (Manipulator* each : manipulators_)
    if (event->button() == Qt::LeftButton && each->enabled() && each->doubleClick(event->position(), view))
      return;
  mousePressEvent(event);
}

void Viewport::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && held_) return letGo(false);
  for (Manipulator* each : manipulators_)
    if (!held_ && each->enabled() && each->keyPress(event->key())) return;
  QWidget::keyPressEvent(event);
}

void Viewport::leaveEvent(QEvent*) {
  hoverManipulators({});
}

void Viewport::focusOutEvent(QFocusEvent*) {
  letGo(false);
  endDrag();
}

// ---- manipulators ----

void Viewport::addManipulator(Manipulator* manipulator) {
  manipulator->setParent(this);
  manipulators_.push_back(manipulator);
  connect(manipulator, &Manipulator::changed, this, &Viewport::refresh);
}

void Viewport::paintOver(QPainter& painter) {
  const ViewGeometry view(session_.view().camera(), size());
  if (session_.relighter().scene())
    for (Manipulator* each : manipulators_)
      if (each->enabled()) each->paint(painter, view);
  paintOverlay(painter, size(), session_, pictureMode_ ? nullptr : canvas_);
  paintErrorLegend(painter, size(), session_);
}

bool Viewport::pressManipulator(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || event->modifiers() & Qt::AltModifier) return false;
  const ViewGeometry view(session_.view().camera(), size());
  for (Manipulator* each : manipulators_) {
    if (!each->enabled() || !each->press(event->position(), event->modifiers(), view)) continue;
    held_ = each;
    setCursor(each->cursor());
    Q_EMIT hintChanged(hint());
    return true;
  }
  return false;
}

void Viewport::hoverManipulators(std::optional<QPointF> at) {
  const ViewGeometry view(session_.view().camera(), size());
  Manipulator* taken = nullptr;
  for (Manipulator* each : manipulators_)
    if (each->hover(taken || !each->enabled() ? std::nullopt : at, view)) taken = each;
  const bool same = taken == hovered_ && !taken;
  hovered_ = taken;
  if (same) return;
  if (taken)
    setCursor(taken->cursor());
  else
    unsetCursor();
  Q_EMIT hintChanged(hint());
}

// The held manipulator's drag is over: kept, or taken back.
void Viewport::letGo(bool keep, const QPointF& at) {
  if (!held_) return;
  Manipulator* held = std::exchange(held_, nullptr);
  if (keep)
    held->release(at, {session_.view().camera(), size()});
  else
    held->cancel();
  settle_.start();
  hoverManipulators(keep ? std::optional(at) : std::nullopt);
  Q_EMIT hintChanged(hint());
}

void Viewport::endDrag() {
  if (drag_ == Drag::None) return;
  if (drag_ == Drag::TurnLight) session_.document().endGesture();
  drag_ = Drag::None;
  dragButton_ = Qt::NoButton;
  settle_.start();
  Q_EMIT hintChanged(hint());
}

// To the right is to the right: what stands behind the model follows the pointer.
void Viewport::turnLight(float pixels) {
  session_.setEnvironmentAngle(session_.environmentAngle() - pixels * kDegreesPerPixel);
}

void Viewport::wheelEvent(QWheelEvent* event) {
  const QPointF at = event->position();
  const float x = float(at.x() - 0.5 * width()) / float(height()),
              y = float(0.5 * height() - at.y()) / float(height());
  const QPoint turned = event->angleDelta();
  session_.view().zoom(float(turned.y() != 0 ? turned.y() : turned.x()) / 120.0f, x, y);
  interact();
  event->accept();
}

// Right drags turn the light: no menu after them.
void Viewport::contextMenuEvent(QContextMenuEvent* event) {
  event->accept();
}

void Viewport::dragEnterEvent(QDragEnterEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) return event->acceptProposedAction();
}

void Viewport::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) session_.open(url.toLocalFile());
  event->acceptProposedAction();
}

void Viewport::interact() {
  canvas_->setInteracting(true);
  settle_.start();
}

void Viewport::refresh() {
  canvas_->invalidate();
}

}  // namespace prt::ui
