#include "ui/widgets/panorama.h"

#include "libprt/light/environment.h"
#include "ui/model/probe_picture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/lat_long.h"
#include "ui/widgets/theme.h"

#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr int kPictureWidth = 512;
constexpr double kSmallest = 5;  // pixels: no light is drawn or grabbed smaller
constexpr double kRimReach = 4;  // pixels on either side of a rim
constexpr double kMuted = 0.35;  // opacity of what does not shine

double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(double(length(cross(a, b))), double(dot(a, b)));
}

}  // namespace

Panorama::Panorama(LightEditor& lights, QWidget* parent) : QWidget(parent), lights_(lights) {
  setObjectName(QStringLiteral("panorama"));
  setToolTip(
      tr("Drag the sky to turn it. Double-click adds a circle light; lights are dragged by their middle and "
         "resized "
         "by their rim."));
  setMouseTracking(true);
  setFocusPolicy(Qt::ClickFocus);
  setCursor(Qt::SizeHorCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setMinimumHeight(80);
  connect(&lights_, &LightEditor::changed, this, qOverload<>(&QWidget::update));
}

void Panorama::setEnvironment(const std::shared_ptr<const EnvironmentMap>& map) {
  if (map == map_) return;
  map_ = map;
  // A coarse map, of a sun that is being dragged, makes a coarse picture at once.
  const int width = map ? std::min(kPictureWidth, std::max(2 * map->height(), 64)) : 0;
  picture_ = map ? toQImage(probePicture(*map, width, width / 2)) : QImage();
  update();
}

void Panorama::setAngle(double degrees) {
  if (degrees == angle_) return;
  angle_ = degrees;
  update();
}

// ---- painting ----

void Panorama::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  QPainterPath frame;
  frame.addRoundedRect(QRectF(rect()), 3, 3);
  painter.setClipPath(frame);
  painter.fillRect(rect(), theme().field);
  paintSky(painter);
  std::vector<LightMark> marks = lights_.marks();
  std::stable_partition(marks.begin(), marks.end(), [](const LightMark& m) { return !m.selected; });
  for (const LightMark& mark : marks) paintMark(painter, mark);
}

void Panorama::paintSky(QPainter& painter) const {
  if (picture_.isNull()) {
    painter.setPen(theme().muted);
    painter.drawText(rect(), Qt::AlignCenter, tr("Drop an HDR here,\nor double-click to add a light"));
    return;
  }
  const int index = lights_.environment();
  const bool on = index >= 0 && lights_.lights()[std::size_t(index)].on;
  painter.setOpacity(on ? 1 : kMuted);
  // Counter-clockwise from above moves the sky to the left.
  double left = std::fmod(-angle_ / 360.0 * width(), width());
  if (left > 0) left -= width();
  for (double x = left; x < width(); x += width())
    painter.drawImage(QRectF(x, 0, width(), height()), picture_);
  painter.setOpacity(1);
  painter.setPen(QPen(pictureTheme().accent, 1));
  painter.drawLine(QPointF(0.5 * width(), height() - 6), QPointF(0.5 * width(), height()));
}

void Panorama::paintMark(QPainter& painter, const LightMark& mark) const {
  const Theme& t = pictureTheme();
  const bool hot =
      (hovered_.light == mark.light && hovered_.part != Part::None) || dragged_.light == mark.light;
  const QPointF at = toStrip(mark.direction, size());
  if (mark.sun) {
    for (const double turn : {-1.0, 0.0, 1.0}) paintSun(painter, at + QPointF(turn * width(), 0), mark, hot);
    return;
  }
  QColor fill = toScreen(mark.color);
  fill.setAlphaF(mark.on ? 0.55f : 0.0f);
  const QColor line = mark.selected || hot ? t.accent : t.text;
  const double half = std::max(double(mark.halfAngle), kSmallest * kPi / height());
  const QPainterPath rim = rimOnStrip(mark.direction, half, size());
  painter.fillPath(discOnStrip(mark.direction, half, size()), fill);
  // A dark line under the light one keeps it legible on any sky.
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 150), mark.selected ? 4 : 3));
  painter.drawPath(rim);
  painter.setPen(QPen(line, mark.selected ? 2 : 1.25, mark.on ? Qt::SolidLine : Qt::DotLine));
  painter.drawPath(rim);
  painter.setPen(QPen(QColor(0, 0, 0, 150), 1));
  painter.setBrush(line);
  painter.drawEllipse(at, 2.5, 2.5);
}

void Panorama::paintSun(QPainter& painter, const QPointF& at, const LightMark& mark, bool hot) const {
  const QColor line = mark.selected || hot ? pictureTheme().accent : pictureTheme().text;
  painter.setOpacity(mark.on ? 1 : kMuted);
  const auto draw = [&](const QPen& pen) {
    painter.setPen(pen);
    for (int ray = 0; ray < 8; ++ray) {
      const QPointF out(std::cos(ray * kPi / 4), std::sin(ray * kPi / 4));
      painter.drawLine(at + 6.5 * out, at + 9 * out);
    }
    painter.drawEllipse(at, 4.5, 4.5);
  };
  painter.setBrush(toScreen(mark.color));
  draw(QPen(QColor(0, 0, 0, 150), 3, Qt::SolidLine, Qt::RoundCap));
  draw(QPen(line, 1.25, Qt::SolidLine, Qt::RoundCap));
  painter.setOpacity(1);
}

// ---- what is where ----

std::optional<LightMark> Panorama::markOf(int light) const {
  for (const LightMark& mark : lights_.marks())
    if (mark.light == light) return mark;
  return {};
}

// The selected light first, then the smaller ones, which lie on top of the larger.
Panorama::Grip Panorama::gripAt(const QPointF& at) const {
  const double pixel = kPi / height();  // radians
  const Vec3 here = fromStrip(at, size());
  std::vector<LightMark> marks = lights_.marks();
  std::stable_sort(marks.begin(), marks.end(), [](const LightMark& a, const LightMark& b) {
    return a.selected != b.selected ? a.selected : a.halfAngle < b.halfAngle;
  });
  for (const LightMark& mark : marks) {
    const double away = angleBetween(here, mark.direction),
                 drawn = std::max(double(mark.halfAngle), kSmallest * pixel);
    if (!mark.resizable) {
      if (away <= drawn + kRimReach * pixel) return {Part::Light, mark.light};
      continue;
    }
    const double inner = std::max(drawn - kRimReach * pixel, 0.6 * drawn);
    if (away < inner) return {Part::Light, mark.light};
    if (away <= drawn + kRimReach * pixel) return {Part::Rim, mark.light};
  }
  return {picture_.isNull() ? Part::None : Part::Sky, -1};
}

void Panorama::showCursor(const Grip& grip) {
  switch (grip.part) {
    case Part::None:
      return setCursor(Qt::ArrowCursor);
    case Part::Sky:
      return setCursor(Qt::SizeHorCursor);
    case Part::Light:
      return setCursor(Qt::SizeAllCursor);
    case Part::Rim:
      return setCursor(Qt::SizeFDiagCursor);
  }
}

bool Panorama::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  const auto mark = markOf(gripAt(help->pos()).light);
  const QString text = mark && mark->sun ? tr("The sun of the clear sky: drag it.")
                       : mark
                           ? tr("%1: drag to move, its rim to resize; right click for more.").arg(mark->name)
                           : tr("The environment as it lights now; the middle is \u2212Z.\nDrag sideways to "
                                "turn it, double-click to "
                                "add a circle light, drop an HDR or EXR to change it.");
  QToolTip::showText(help->globalPos(), text, this);
  return true;
}

// ---- mouse and keys ----

void Panorama::beginDrag(const Grip& grip, const QPointF& at) {
  dragged_ = grip;
  last_ = at;
  if (grip.part == Part::Sky) return Q_EMIT gestureBegan();
  const auto mark = markOf(grip.light);
  lights_.select(grip.light);
  const QString name =
      mark->sun ? tr("Move sun") : (grip.part == Part::Rim ? tr("Resize %1") : tr("Move %1")).arg(mark->name);
  lights_.beginDrag(name);
  offset_ = toStrip(mark->direction, size()) - at;
  slack_ = double(mark->halfAngle) - angleBetween(fromStrip(at, size()), mark->direction);
}

void Panorama::dragLight(const QPointF& at) {
  const auto mark = markOf(dragged_.light);
  if (!mark) return endDrag(false);
  if (dragged_.part == Part::Light) return lights_.aim(dragged_.light, fromStrip(at + offset_, size()));
  const double half = angleBetween(fromStrip(at, size()), mark->direction) + slack_;
  lights_.resize(dragged_.light, 2 * degrees(std::max(half, 0.0)));
}

void Panorama::endDrag(bool keep) {
  const Part part = std::exchange(dragged_, {}).part;
  if (part == Part::None) return;
  if (!keep)
    lights_.cancelDrag();
  else if (part == Part::Sky)
    Q_EMIT gestureEnded();
  else
    lights_.endDrag();
  update();
}

void Panorama::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || dragged_.part != Part::None) return;
  const Grip grip = gripAt(event->position());
  if (grip.part == Part::None) return;
  if (grip.light < 0) lights_.select(-1);
  beginDrag(grip, event->position());
}

void Panorama::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (dragged_.part == Part::None) {
    const Grip grip = gripAt(at);
    showCursor(grip);
    if (std::exchange(hovered_, grip) != grip) update();
    return;
  }
  const double moved = at.x() - last_.x();
  last_ = at;
  if (dragged_.part == Part::Sky)
    Q_EMIT turned(-360.0 * moved / width());
  else
    dragLight(at);
}

void Panorama::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) endDrag(true);
}

void Panorama::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const Grip grip = gripAt(event->position());
  if (grip.light >= 0) {
    if (markOf(grip.light)->resizable) Q_EMIT colorWanted(grip.light);
    return;
  }
  endDrag(true);
  lights_.addCircle(fromStrip(event->position(), size()));
}

void Panorama::contextMenuEvent(QContextMenuEvent* event) {
  const QPointF at = event->pos();
  const int light = gripAt(at).light;
  QMenu menu(this);
  if (const auto mark = markOf(light)) {
    lights_.select(light);
    const bool on = lights_.lights()[std::size_t(light)].on;
    menu.addAction(icon(on ? QStringLiteral("view-hidden") : QStringLiteral("view-visible")),
                   on ? tr("Mute %1").arg(mark->name) : tr("Switch %1 on").arg(mark->name), &lights_,
                   [this, light, on] { lights_.setOn(light, !on); });
    if (!mark->sun) menu.addAction(tr("Colour\u2026"), this, [this, light] { Q_EMIT colorWanted(light); });
    menu.addAction(icon(QStringLiteral("edit-duplicate")), tr("Duplicate"), &lights_,
                   [this, light] { lights_.duplicate(light); });
    menu.addAction(icon(QStringLiteral("edit-delete")), tr("Delete"), QKeySequence(Qt::Key_Delete), &lights_,
                   [this, light] { lights_.remove(light); });
    menu.addSeparator();
  }
  menu.addAction(icon(QStringLiteral("list-add")), tr("Add circle light here"), &lights_,
                 [this, at] { lights_.addCircle(fromStrip(at, size())); });
  menu.exec(event->globalPos());
}

void Panorama::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && dragged_.part != Part::None) return endDrag(false);
  const bool removes = event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace;
  if (removes && dragged_.part == Part::None && markOf(lights_.selected()))
    return lights_.remove(lights_.selected());
  QWidget::keyPressEvent(event);
}

void Panorama::leaveEvent(QEvent*) {
  hovered_ = {};
  update();
}

}  // namespace prt::ui
