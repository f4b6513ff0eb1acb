#include "ui/widgets/compass.h"

#include "ui/widgets/theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <cmath>

namespace prt::ui {

namespace {
constexpr double kToRadians = 3.14159265358979 / 180;
}

double wrapDegrees(double degrees) {
  return std::remainder(degrees, 360.0);
}

Compass::Compass(QWidget* parent) : QWidget(parent) {
  setFixedSize(sizeHint());
  setCursor(Qt::PointingHandCursor);
  setToolTip(tr("Seen from above: drag to turn the environment.\nShift: fine. Ctrl: steps of 15\u00b0."));
}

void Compass::setAngle(double degrees) {
  angle_ = degrees;
  update();
}

// On the disc -Z is up and +X right, so counter-clockwise angles run to the left.
double Compass::pointerAngle(const QPointF& at) const {
  const QPointF from = at - QRectF(rect()).center();
  return std::atan2(-from.x(), -from.y()) / kToRadians;
}

void Compass::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  const QPointF middle = QRectF(rect()).center();
  const double radius = 0.5 * width() - 2;
  const auto at = [&](double degrees, double distance) {
    return middle +
           QPointF(-std::sin(degrees * kToRadians), -std::cos(degrees * kToRadians)) * (radius * distance);
  };
  painter.setPen(t.line);
  painter.setBrush(t.field);
  painter.drawEllipse(middle, radius, radius);
  for (int mark = 0; mark < 360; mark += 15) {
    painter.setPen(QPen(t.muted, mark % 90 == 0 ? 1.5 : 0.7));
    painter.drawLine(at(mark, mark % 90 == 0 ? 0.86 : 0.92), at(mark, 0.98));
  }
  QFont small = font();
  small.setPointSizeF(7);
  painter.setFont(small);
  painter.setPen(t.muted);
  const std::pair<const char*, double> axes[] = {{"\u2212Z", 0}, {"\u2212X", 90}, {"+Z", 180}, {"+X", 270}};
  for (const auto& [name, degrees] : axes) {
    const QPointF place = at(degrees, 0.66);
    painter.drawText(QRectF(place.x() - 12, place.y() - 7, 24, 14), Qt::AlignCenter, QString::fromUtf8(name));
  }
  painter.setPen(QPen(t.accent, 2, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(middle, at(angle_, 0.84));
  painter.setPen(Qt::NoPen);
  painter.setBrush(t.accent);
  painter.drawEllipse(at(angle_, 0.88), 4, 4);
  painter.drawEllipse(middle, 2, 2);
}

void Compass::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragging_ = true;
  lastPointer_ = pointerAngle(event->position());
  exact_ = angle_;
  Q_EMIT gestureBegan();
}

void Compass::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) return;
  const double pointer = pointerAngle(event->position());
  exact_ += wrapDegrees(pointer - lastPointer_) * (event->modifiers() & Qt::ShiftModifier ? 0.1 : 1);
  lastPointer_ = pointer;
  const double shown = event->modifiers() & Qt::ControlModifier ? std::round(exact_ / 15) * 15 : exact_;
  setAngle(wrapDegrees(shown));
  Q_EMIT turned(angle_);
}

void Compass::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !dragging_) return;
  dragging_ = false;
  Q_EMIT gestureEnded();
}

}  // namespace prt::ui
