#include "ui/widgets/lat_long.h"

#include "libprt/light/sky_angles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace prt::ui {

namespace {

constexpr double kTolerance = 0.25;  // pixels
constexpr int kFirstPieces = 48, kDeepest = 14;

// A small circle on the sphere as a curve on the strip, not cut at the edges: x runs on over them.
class Rim {
 public:
  Rim(const Vec3& direction, double halfAngle, const QSizeF& size)
      : axis_(normalize(DVec3(direction))),
        cosine_(std::cos(halfAngle)),
        sine_(std::sin(halfAngle)),
        size_(size) {
    // Straight up from the axis, so that the curve begins on the axis' own meridian and is even about it.
    const DVec3 up = std::abs(axis_.y) > 1 - 1e-12 ? DVec3(0, 0, -1) : DVec3(0, 1, 0);
    along_ = normalize(up - dot(up, axis_) * axis_);
    across_ = cross(axis_, along_);
    points_.push_back(at(0));
    for (int i = 0; i < kFirstPieces; ++i) refine(turn(i), turn(i + 1), kDeepest);
  }

  /// The last point stands where the first does, or, when the curve goes around a pole, a width beside it.
  const std::vector<QPointF>& points() const { return points_; }

 private:
  static double turn(int piece) { return 2 * kPi * piece / kFirstPieces; }
  QPointF at(double angle) const {
    const DVec3 d = cosine_ * axis_ + sine_ * (std::cos(angle) * along_ + std::sin(angle) * across_);
    return toStrip(Vec3(d), size_);
  }
  // The same place, as near to `before` as whole turns bring it.
  QPointF unrolled(QPointF point, const QPointF& before) const {
    point.rx() += size_.width() * std::round((before.x() - point.x()) / size_.width());
    return point;
  }
  // Appends the curve from angle a, whose point is the last one, to angle b.
  void refine(double a, double b, int depth) {
    const QPointF from = points_.back(), middle = unrolled(at(0.5 * (a + b)), from),
                  to = unrolled(at(b), middle);
    const QPointF off = middle - 0.5 * (from + to);
    const double longest = 0.25 * size_.width();  // so that no step is taken the wrong way around
    const bool fine = std::hypot(off.x(), off.y()) < kTolerance && std::abs(to.x() - from.x()) < longest;
    if (fine || depth == 0) {
      points_.push_back(middle);
      points_.push_back(to);
      return;
    }
    refine(a, 0.5 * (a + b), depth - 1);
    refine(0.5 * (a + b), b, depth - 1);
  }

  DVec3 axis_, along_, across_;
  double cosine_, sine_;
  QSizeF size_;
  std::vector<QPointF> points_;
};

QPainterPath polyline(const std::vector<QPointF>& points) {
  QPainterPath path(points.front());
  for (std::size_t i = 1; i < points.size(); ++i) path.lineTo(points[i]);
  return path;
}

// The path once for each width that it may reach into.
QPainterPath repeated(const QPainterPath& path, double width) {
  QPainterPath all;
  const QRectF box = path.boundingRect();
  for (int turn = int(std::floor(-box.right() / width)); turn <= int(std::ceil(1 - box.left() / width));
       ++turn)
    if (box.right() + turn * width >= 0 && box.left() + turn * width <= width)
      all.addPath(path.translated(turn * width, 0));
  return all;
}

}  // namespace

QPointF toStrip(const Vec3& direction, const QSizeF& size) {
  const SkyAngles a = anglesOf(direction);
  return {(0.5 - a.azimuth / (2 * kPi)) * size.width(), (0.5 - a.elevation / kPi) * size.height()};
}

Vec3 fromStrip(const QPointF& at, const QSizeF& size) {
  const double v = std::clamp(at.y() / size.height(), 0.0, 1.0);
  return directionOf(SkyAngles{(0.5 - at.x() / size.width()) * 2 * kPi, (0.5 - v) * kPi});
}

QPainterPath rimOnStrip(const Vec3& direction, double halfAngle, const QSizeF& size) {
  return repeated(polyline(Rim(direction, halfAngle, size).points()), size.width());
}

QPainterPath discOnStrip(const Vec3& direction, double halfAngle, const QSizeF& size) {
  QPainterPath strip;
  strip.addRect(QRectF(QPointF(0, 0), size));
  if (halfAngle >= kPi) return strip;
  const double toTop = std::acos(std::clamp(double(direction.y), -1.0, 1.0));
  const bool holdsTop = toTop < halfAngle, holdsBottom = kPi - toTop < halfAngle;
  const std::vector<QPointF> rim = Rim(direction, halfAngle, size).points();
  QPainterPath path = polyline(rim);
  if (holdsTop != holdsBottom) {  // the rim goes once around: the disc lies between it and that edge
    const double edge = holdsTop ? 0 : size.height();
    path.lineTo(rim.back().x(), edge);
    path.lineTo(rim.front().x(), edge);
  }
  path.closeSubpath();
  path = repeated(path, size.width());
  path.setFillRule(Qt::WindingFill);
  if (holdsTop && holdsBottom) return strip.subtracted(path);  // the rim is that of a hole
  return strip.intersected(path);
}

}  // namespace prt::ui
