#include "ui/viewport/light_handles.h"

#include "ui/model/scene_rays.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/distances.h"
#include "ui/widgets/theme.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <utility>

namespace prt::ui {

namespace {

constexpr float kRadius = 0.55f;                // of the sphere, in diagonals of the scene's box, at most
constexpr float kInView = 0.85f;                // of the view's half angle that the sphere fills, at most
constexpr int kPieces = 96;                     // of a rim
constexpr double kReach = 7;                    // pixels around what can be grabbed
constexpr double kDot = 4.5;                    // pixels
constexpr double kFaint = 0.28, kMuted = 0.45;  // opacity

float angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

Vec3 pointOnSphere(const HandleSphere& sphere, const Sight& sight, bool nearSide) {
  const float along = dot(sphere.center - sight.origin, sight.direction);
  const Vec3 nearest = sight.origin + along * sight.direction - sphere.center;
  float out = length(nearest) / sphere.radius;
  const Vec3 aside = out > 1e-6f ? normalize(nearest) : Vec3(0);
  if (out > 1) {
    out = std::max(0.0f, 2 - out);
    nearSide = !nearSide;
  }
  const float depth = std::sqrt(std::max(0.0f, 1 - out * out));
  return normalize(out * aside + (nearSide ? -depth : depth) * sight.direction);
}

LightHandles::LightHandles(LightEditor& lights, const SceneRays& rays, std::function<Box3()> bounds,
                           QObject* parent)
    : Manipulator(parent), lights_(lights), rays_(rays), bounds_(std::move(bounds)) {
  connect(&lights_, &LightEditor::changed, this, &Manipulator::changed);
  connect(&rays_, &SceneRays::changed, this, &Manipulator::changed);
}

HandleSphere LightHandles::sphere(const ViewGeometry& view) const {
  const Camera& camera = view.camera();
  const float narrow = std::min(1.0f, float(view.size().width()) / float(view.size().height()));
  const float fitting =
      length(camera.target - camera.eye) * std::sin(0.5f * kInView * camera.verticalFov) * narrow;
  const Box3 box = bounds_();
  const float radius = box.empty() ? fitting : std::min(fitting, kRadius * box.diagonal());
  return {camera.target, std::max(radius, 1e-6f)};
}

bool LightHandles::hidden(const Vec3& point, const ViewGeometry& view) const {
  return rays_.blocked(view.sightTo(point).origin, point);
}

bool LightHandles::onNearSide(const Vec3& direction, const ViewGeometry& view) const {
  const HandleSphere s = sphere(view);
  return dot(direction, view.sightTo(s.center + s.radius * direction).direction) < 0;
}

std::vector<Vec3> LightHandles::rimOf(const LightMark& mark, const ViewGeometry& view) const {
  const HandleSphere s = sphere(view);
  const Frame frame = frameFromNormal(mark.direction);
  std::vector<Vec3> points;
  for (int i = 0; i < kPieces; ++i) {
    const float turn = 2 * kPiF * float(i) / kPieces;
    const Vec3 d =
        std::cos(mark.halfAngle) * frame.normal +
        std::sin(mark.halfAngle) * (std::cos(turn) * frame.tangent + std::sin(turn) * frame.bitangent);
    points.push_back(s.center + s.radius * d);
  }
  return points;
}

// ---- painting ----

void LightHandles::paint(QPainter& painter, const ViewGeometry& view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  std::vector<LightMark> marks = lights_.marks();
  std::stable_partition(marks.begin(), marks.end(), [](const LightMark& m) { return !m.selected; });
  for (const LightMark& mark : marks) paintMark(painter, mark, view);
  painter.restore();
}

void LightHandles::paintMark(QPainter& painter, const LightMark& mark, const ViewGeometry& view) const {
  const bool hot = mark.light == held_.light || (held_.light < 0 && mark.light == hovered_.light);
  if (mark.resizable) paintRim(painter, mark, view);
  const HandleSphere s = sphere(view);
  const Vec3 place = s.center + s.radius * mark.direction;
  const auto at = view.project(place);
  if (!at) return;
  const QColor line = mark.selected || hot ? pictureTheme().accent : QColor(Qt::white);
  painter.setOpacity((hidden(place, view) ? kFaint : 1) * (mark.on ? 1 : kMuted));
  // A stalk towards the model tells where on the sphere the handle is.
  if (const auto inside = view.project(s.center + 0.86f * s.radius * mark.direction)) {
    painter.setPen(QPen(QColor(0, 0, 0, 120), 3, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*at, *inside);
    painter.setPen(QPen(line, 1.25, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*at, *inside);
  }
  const double radius = mark.sun ? kDot + 2 : kDot;
  if (mark.sun)
    for (const auto& [color, width] : {std::pair(QColor(0, 0, 0, 120), 3.5), std::pair(line, 1.5)}) {
      painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
      for (int ray = 0; ray < 8; ++ray) {
        const QPointF out(std::cos(ray * kPi / 4), std::sin(ray * kPi / 4));
        painter.drawLine(*at + (radius + 3) * out, *at + (radius + 6) * out);
      }
    }
  painter.setPen(QPen(QColor(0, 0, 0, 120), 3.5));
  painter.setBrush(toScreen(mark.color));
  painter.drawEllipse(*at, radius, radius);
  painter.setPen(QPen(line, mark.selected ? 2 : 1.25));
  painter.drawEllipse(*at, radius, radius);
}

void LightHandles::paintRim(QPainter& painter, const LightMark& mark, const ViewGeometry& view) const {
  const std::vector<Vec3> rim = rimOf(mark, view);
  std::vector<std::optional<QPointF>> at;
  std::vector<bool> faint;
  for (const Vec3& point : rim) {
    at.push_back(view.project(point));
    faint.push_back(hidden(point, view));
  }
  QPainterPath whole, seen, unseen;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t next = (i + 1) % rim.size();
    if (!at[i] || !at[next]) continue;
    if (whole.isEmpty()) whole.moveTo(*at[i]);
    whole.lineTo(*at[next]);
    QPainterPath& part = faint[i] && faint[next] ? unseen : seen;
    part.moveTo(*at[i]);
    part.lineTo(*at[next]);
  }
  const bool rimHot = (held_.light < 0 ? hovered_ : held_) == Grip{Part::Rim, mark.light};
  const QColor line = mark.selected || rimHot ? pictureTheme().accent : toScreen(mark.color);
  if (mark.on && mark.halfAngle <= kPiF / 2) {
    QColor fill = toScreen(mark.color);
    fill.setAlphaF(0.12f);
    painter.setOpacity(1);
    painter.fillPath(whole, fill);
  }
  painter.setBrush(Qt::NoBrush);
  for (const auto& [path, opacity] : {std::pair(&unseen, kFaint), std::pair(&seen, 1.0)}) {
    painter.setOpacity(opacity * (mark.on ? 1 : kMuted));
    painter.setPen(QPen(QColor(0, 0, 0, 110), rimHot ? 4.5 : 3.5));
    painter.drawPath(*path);
    painter.setPen(QPen(line, rimHot ? 2.25 : 1.5));
    painter.drawPath(*path);
  }
}

// ---- mouse ----

// Middles before rims, the selected light before others, seen ones before hidden ones.
LightHandles::Grip LightHandles::gripAt(const QPointF& at, const ViewGeometry& view) const {
  const HandleSphere s = sphere(view);
  std::vector<LightMark> marks = lights_.marks();
  const auto rank = [&](const LightMark& m) {
    return (m.selected ? 0 : 2) + (hidden(s.center + s.radius * m.direction, view) ? 1 : 0);
  };
  std::stable_sort(marks.begin(), marks.end(),
                   [&](const LightMark& a, const LightMark& b) { return rank(a) < rank(b); });
  for (const LightMark& mark : marks) {
    const auto middle = view.project(s.center + s.radius * mark.direction);
    if (middle && distance(at, *middle) <= kDot + kReach) return {Part::Middle, mark.light};
  }
  for (const LightMark& mark : marks) {
    if (!mark.resizable) continue;
    const std::vector<Vec3> rim = rimOf(mark, view);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const auto from = view.project(rim[i]), to = view.project(rim[(i + 1) % rim.size()]);
      if (from && to && distanceToPiece(at, *from, *to) <= 0.7 * kReach) return {Part::Rim, mark.light};
    }
  }
  return {};
}

bool LightHandles::hover(std::optional<QPointF> at, const ViewGeometry& view) {
  const Grip grip = at ? gripAt(*at, view) : Grip{};
  if (std::exchange(hovered_, grip) != grip) Q_EMIT changed();
  return grip.part != Part::None;
}

bool LightHandles::press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) {
  if (modifiers & Qt::ShiftModifier) return false;  // turns the environment, wherever it is pressed
  const Grip grip = gripAt(at, view);
  if (grip.part == Part::None) return false;
  held_ = hovered_ = grip;
  for (const LightMark& mark : lights_.marks())
    if (mark.light == grip.light) atPress_ = mark;
  lights_.select(grip.light);
  lights_.beginDrag(atPress_.sun
                        ? tr("Move sun")
                        : (grip.part == Part::Rim ? tr("Resize %1") : tr("Move %1")).arg(atPress_.name));
  const HandleSphere s = sphere(view);
  const Sight sight = view.sightAt(at);
  const Vec3 nearPoint = pointOnSphere(s, sight, true), farPoint = pointOnSphere(s, sight, false);
  // The side on which what was grabbed lies: for a rim, which may cross the edge, the one that is nearer to
  // it.
  const auto off = [&](const Vec3& d) {
    return std::abs(angleBetween(d, atPress_.direction) - (grip.part == Part::Rim ? atPress_.halfAngle : 0));
  };
  nearSide_ =
      grip.part == Part::Middle ? onNearSide(atPress_.direction, view) : off(nearPoint) <= off(farPoint);
  grabbed_ = nearSide_ ? nearPoint : farPoint;
  return true;
}

void LightHandles::move(const QPointF& at, Qt::KeyboardModifiers, const ViewGeometry& view) {
  if (held_.part == Part::None) return;
  const Vec3 here = pointOnSphere(sphere(view), view.sightAt(at), nearSide_);
  if (held_.part == Part::Middle) {
    // By the turn that takes the point that was grabbed to where the pointer is now.
    const Vec3 moved = glm::rotation(grabbed_, here) * atPress_.direction;
    return lights_.aim(held_.light, moved);
  }
  const float slack = atPress_.halfAngle - angleBetween(grabbed_, atPress_.direction);
  const float half = std::clamp(angleBetween(here, atPress_.direction) + slack, 0.0f, kPiF);
  lights_.resize(held_.light, 2 * degrees(double(half)));
}

void LightHandles::release(const QPointF&, const ViewGeometry&) {
  if (std::exchange(held_, {}).part != Part::None) lights_.endDrag();
}

void LightHandles::cancel() {
  if (std::exchange(held_, {}).part != Part::None) lights_.cancelDrag();
}

bool LightHandles::keyPress(int key) {
  if (key != Qt::Key_Delete && key != Qt::Key_Backspace) return false;
  for (const LightMark& mark : lights_.marks()) {
    if (!mark.selected) continue;
    lights_.remove(mark.light);
    return true;
  }
  return false;
}

QCursor LightHandles::cursor() const {
  const Part part = held_.part != Part::None ? held_.part : hovered_.part;
  return part == Part::Rim ? Qt::SizeFDiagCursor : Qt::SizeAllCursor;
}

QList<Binding> LightHandles::bindings() const {
  return {{tr("Drag"), tr("a light around the model: its middle moves it, its rim resizes it")},
          {tr("Delete"), tr("removes the selected light")}};
}

QString LightHandles::hint() const {
  const Grip grip = held_.part != Part::None ? held_ : hovered_;
  for (const LightMark& mark : lights_.marks()) {
    if (mark.light != grip.light || grip.part == Part::None) continue;
    if (held_.part == Part::Rim) {
      const double across = 2 * degrees(double(mark.halfAngle));
      return tr("%1: %2\u00b0 across   \u00b7   Esc takes it back").arg(mark.name).arg(across, 0, 'f', 1);
    }
    if (held_.part == Part::Middle)
      return tr("Moving %1   \u00b7   Esc takes it back").arg(mark.sun ? tr("the sun") : mark.name);
    if (mark.sun) return tr("Drag the sun");
    return grip.part == Part::Rim ? tr("Drag the rim to resize %1").arg(mark.name)
                                  : tr("Drag %1 around the model").arg(mark.name);
  }
  return {};
}

}  // namespace prt::ui
