#include "ui/viewport/viewport.h"

#include "ui/model/error_estimate.h"
#include "ui/model/field_editor.h"
#include "ui/model/session.h"
#include "ui/viewport/cpu_canvas.h"
#include "ui/viewport/error_legend.h"
#include "ui/viewport/field_overlay.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/viewport/manipulator.h"
#include "ui/viewport/overlay.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QPointingDevice>
#include <QWheelEvent>

#include <utility>

namespace prt::ui {

namespace {
constexpr float kDegreesPerPixel = 0.4f;     // of turning the environment
constexpr float kStepsPerHeight = 12;        // of zooming by a drag over the whole view
constexpr float kStepsPerMagnification = 6;  // of a pinch
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
    if (drag_ == DragAction::None && !held_) canvas_->setInteracting(false);
  });
  chooseCanvas();
  connect(&session_.relighter(), &Relighter::changed, this, &Viewport::refresh);
  connect(&session_.view(), &ViewState::changed, this, [this] {
    refresh();
    Q_EMIT hintChanged(hint());
  });
  connect(&session_.layers(), &SurfaceLayers::changed, this, [this] { canvas_->invalidateLayers(); });
  // These change what is written on the picture, not the picture.
  connect(&session_, &Session::statusChanged, this, [this] { canvas_->widget()->update(); });
  connect(&session_, &Session::selectionChanged, this, [this] { canvas_->widget()->update(); });
  connect(&session_.errors(), &ErrorEstimate::changed, this, [this] { canvas_->widget()->update(); });
  connect(&session_.field(), &FieldEditor::changed, this, [this] { canvas_->widget()->update(); });
}

// ---- who draws ----

void Viewport::setDrawing(Drawing drawing) {
  if (drawing == drawing_) return;
  drawing_ = drawing;
  const bool active = isActiveWindow();
  chooseCanvas();
  if (active) {  // Qt makes the window anew for its first OpenGL widget, and it loses the keyboard
    activateWindow();
    setFocus();
  }
  Q_EMIT drawingChanged();
}

CanvasContext Viewport::canvasContext() {
  return {session_.relighter(), session_.view(), session_.layers(), session_.jobs(),
          [this](QPainter& p) { paintOver(p); }};
}

void Viewport::chooseCanvas() {
  const GlSupport support = drawing_ == Drawing::Cpu ? GlSupport::None : GlCanvas::support();
  if (drawing_ == Drawing::OpenGl && support == GlSupport::None)
    session_.report(Severity::Warning, tr("This machine has no OpenGL 4.5: the CPU goes on drawing."));
  // Without a graphics card OpenGL is the CPU too, and slower at it.
  if (support == GlSupport::None || (support == GlSupport::Software && drawing_ == Drawing::Automatic))
    return useCpu();
  if (dynamic_cast<GlCanvas*>(canvas_)) return;
  auto* canvas = new GlCanvas(canvasContext(), this);
  connect(
      canvas, &GlCanvas::failed, this,
      [this](const QString& message) {
        session_.report(Severity::Warning, tr("The CPU draws from now on: %1.").arg(message));
        useCpu();
      },
      Qt::QueuedConnection);
  show(canvas);
}

void Viewport::useCpu() {
  if (dynamic_cast<CpuCanvas*>(canvas_)) return;
  auto* canvas = new CpuCanvas(canvasContext(), this);
  connect(
      canvas, &CpuCanvas::failed, this,
      [this](const QString& message) { session_.report(Severity::Error, message); }, Qt::QueuedConnection);
  show(canvas);
}

void Viewport::show(Canvas* canvas) {
  if (canvas_) {
    canvas_->widget()->hide();
    canvas_->widget()->deleteLater();
  }
  canvas_ = canvas;
  canvas->setThorough(pictureMode_);
  canvas->widget()->setGeometry(rect());
  canvas->widget()->lower();  // messages stay on top
  canvas->widget()->show();
}

void Viewport::refresh() {
  canvas_->invalidate();
}

void Viewport::resizeEvent(QResizeEvent*) {
  canvas_->widget()->setGeometry(rect());
}

// ---- mouse ----

QString Viewport::hint() const {
  switch (drag_) {
    case DragAction::Orbit:
      return tr("Orbiting");
    case DragAction::Pan:
      return tr("Panning");
    case DragAction::Zoom:
      return tr("Zooming");
    case DragAction::TurnLight:
      return tr("Turning the environment: %1\u00b0").arg(session_.environmentAngle(), 0, 'f', 1);
    case DragAction::None:
      break;
  }
  for (const Manipulator* each : {held_, hovered_})
    if (each && !each->hint().isEmpty()) return each->hint();
  return navigationHint(session_.view().navigation());
}

QList<Binding> Viewport::bindings() const {
  QList<Binding> all;
  for (const auto& [keys, what] : navigationKeys(session_.view().navigation())) all << Binding{keys, what};
  for (const Manipulator* each : manipulators_) all << each->bindings();
  all << Binding{tr("Click"), tr("select the object")} << Binding{tr("Right click"), tr("menu")}
      << Binding{tr("Drop"), tr("a mesh or project opens, an HDR becomes the light")};
  return all;
}

void Viewport::setPictureMode(bool on) {
  pictureMode_ = on;
  canvas_->setThorough(on);
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  setFocus();
  if (drag_ != DragAction::None || held_ || pressManipulator(event)) return;
  press_.reset();
  drag_ = dragAction(session_.view().navigation(), event->button(), event->modifiers());
  if (drag_ == DragAction::None) {
    press_ = Press{event->position(), event->button()};
    return;
  }
  dragButton_ = event->button();
  last_ = dragFrom_ = event->position();
  if (drag_ == DragAction::TurnLight) session_.document().beginGesture(tr("Turn environment"));
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
  if (press_ && (event->position() - press_->at).manhattanLength() >= QApplication::startDragDistance())
    press_.reset();
  if (drag_ == DragAction::None) return event->buttons() ? void() : hoverManipulators(event->position());
  drag(event->position() - std::exchange(last_, event->position()));
  interact();
  Q_EMIT hintChanged(hint());
}

void Viewport::drag(const QPointF& moved) {
  const float dx = float(moved.x()), dy = float(moved.y()), scale = 1.0f / float(height());
  switch (drag_) {
    case DragAction::Orbit:
      return session_.view().orbit(dx * scale, dy * scale);
    case DragAction::Pan:
      return session_.view().pan(dx * scale, dy * scale);
    case DragAction::Zoom:
      return zoom((dx - dy) * scale * kStepsPerHeight, dragFrom_);
    case DragAction::TurnLight:
      return turnLight(dx);
    case DragAction::None:
      return;
  }
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (held_ && event->button() == Qt::LeftButton) return letGo(true, event->position());
  if (event->button() == dragButton_) endDrag();
  const auto press = std::exchange(press_, std::nullopt);
  if (press && press->button == event->button()) click(*press, event->globalPosition(), event->modifiers());
}

void Viewport::click(const Press& press, const QPointF& globalAt, Qt::KeyboardModifiers modifiers) {
  if (press.button == Qt::MiddleButton) return;
  if (const int object = objectAt(press.at); object >= 0) session_.selectObject(object);
  if (press.button == Qt::LeftButton) Q_EMIT clicked(press.at, modifiers);
  if (press.button == Qt::RightButton && modifiers == Qt::NoModifier)
    Q_EMIT menuRequested(globalAt.toPoint());
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

void Viewport::endDrag() {
  if (drag_ == DragAction::None) return;
  if (drag_ == DragAction::TurnLight) session_.document().endGesture();
  drag_ = DragAction::None;
  dragButton_ = Qt::NoButton;
  settle_.start();
  Q_EMIT hintChanged(hint());
}

// To the right is to the right: what stands behind the model follows the pointer.
void Viewport::turnLight(float pixels) {
  session_.setEnvironmentAngle(session_.environmentAngle() - pixels * kDegreesPerPixel);
}

void Viewport::zoom(float steps, const QPointF& at) {
  session_.view().zoom(steps, float(at.x() - 0.5 * width()) / float(height()),
                       float(0.5 * height() - at.y()) / float(height()));
}

void Viewport::wheelEvent(QWheelEvent* event) {
  // Some mice tell pixels too: what it is counts.
  const bool fingers =
      !event->pixelDelta().isNull() && event->device()->type() == QInputDevice::DeviceType::TouchPad;
  const QPointF turned = fingers ? QPointF(event->pixelDelta()) : QPointF(event->angleDelta());
  const WheelMove move = wheelMove(fingers, turned.x(), turned.y(), event->modifiers());
  const float scale = 1.0f / float(height());
  if (move.zoomSteps != 0) zoom(float(move.zoomSteps), event->position());
  if (move.panX != 0 || move.panY != 0)
    session_.view().pan(float(move.panX) * scale, float(move.panY) * scale);
  if (move.orbitX != 0 || move.orbitY != 0)
    session_.view().orbit(float(move.orbitX) * scale, float(move.orbitY) * scale);
  interact();
  event->accept();
}

bool Viewport::event(QEvent* event) {
  if (event->type() != QEvent::NativeGesture) return QWidget::event(event);
  const auto* gesture = static_cast<QNativeGestureEvent*>(event);
  if (gesture->gestureType() != Qt::ZoomNativeGesture) return QWidget::event(event);
  zoom(float(gesture->value()) * kStepsPerMagnification, gesture->position());
  interact();
  return true;
}

// The mouse's menu comes when the button goes up without a drag.
void Viewport::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() == QContextMenuEvent::Keyboard) Q_EMIT menuRequested(mapToGlobal(rect().center()));
  event->accept();
}

// The camera's pixels are those of the screen.
std::optional<SurfaceHit> Viewport::pick(const QPointF& at) const {
  const auto& scene = session_.relighter().scene();
  if (!scene) return std::nullopt;
  const double scale = devicePixelRatioF();
  return pickSurface(*scene, session_.view().camera(), float(at.x() * scale), float(at.y() * scale),
                     qRound(width() * scale), qRound(height() * scale));
}

int Viewport::objectAt(const QPointF& at) const {
  const auto hit = pick(at);
  const int found = hit ? int(hit->object) : -1;
  const auto& around = session_.relighter().surroundings().scene;
  if (!around) return found;
  const Camera& camera = session_.view().camera();
  const double scale = devicePixelRatioF();
  const auto beside = pickSurface(*around, camera, float(at.x() * scale), float(at.y() * scale),
                                  qRound(width() * scale), qRound(height() * scale));
  if (!beside) return found;
  const Vec3 back = camera.axes().normal;
  return hit && dot(hit->position, back) > dot(beside->position, back) ? found : int(beside->object);
}

// ---- manipulators ----

void Viewport::addManipulator(Manipulator* manipulator) {
  manipulator->setParent(this);
  manipulators_.push_back(manipulator);
  connect(manipulator, &Manipulator::changed, this, [this] { canvas_->widget()->update(); });
}

void Viewport::paintOver(QPainter& painter) {
  const ViewGeometry view(session_.view().camera(), size());
  if (session_.relighter().scene()) {
    paintField(painter, view, session_);
    for (Manipulator* each : manipulators_)
      if (each->enabled()) each->paint(painter, view);
  }
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

// ---- files ----

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

}  // namespace prt::ui
