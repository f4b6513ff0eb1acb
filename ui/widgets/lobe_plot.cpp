#include "ui/widgets/lobe_plot.h"

#include "ui/model/expression.h"
#include "ui/widgets/theme.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr double kDecades = 4;  // of the logarithmic scale
constexpr double kMargin = 14;  // around the half circle, for the names of angles

}  // namespace

LobePlot::LobePlot(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("lobePlot"));
  setFocusPolicy(Qt::ClickFocus);
  setCursor(Qt::PointingHandCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  lobe_.incidence = 40;
  refresh();
}

void LobePlot::setMaterial(const Material& material) {
  if (material == material_) return;
  material_ = material;
  refresh();
}

void LobePlot::setIncidence(double degrees) {
  lobe_.incidence = degrees;
  refresh();
}

void LobePlot::setLogarithmic(bool logarithmic) {
  logarithmic_ = logarithmic;
  update();
}

void LobePlot::refresh() {
  lobe_ = lobeOf(material_, lobe_.incidence);
  setAccessibleDescription(tip());
  update();
}

// ---- geometry ----

QPointF LobePlot::origin() const {
  return {0.5 * width(), height() - 8.0};
}
double LobePlot::radius() const {
  return std::min(0.5 * width() - kMargin - 4, height() - 8 - kMargin);
}
QRect LobePlot::scaleButton() const {
  return {0, 0, 36, 18};
}

double LobePlot::lengthOf(double value) const {
  if (lobe_.highest <= 0 || value <= 0) return 0;
  const double share = value / lobe_.highest;
  return radius() * (logarithmic_ ? std::max(0.0, 1 + std::log10(share) / kDecades) : share);
}

QPointF LobePlot::place(double angle, double length) const {
  const double a = radians(angle);
  return origin() + length * QPointF(std::sin(a), -std::cos(a));
}

// ---- painting ----

void LobePlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paintGrid(painter);
  paintCurves(painter);
  paintLight(painter);
}

void LobePlot::paintGrid(QPainter& painter) const {
  const Theme& t = theme();
  QFont small = font();
  small.setPointSizeF(7);
  painter.setFont(small);
  painter.setBrush(Qt::NoBrush);
  const int rings = logarithmic_ ? int(kDecades) : 2;
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = radius() * ring / rings;
    painter.setPen(QPen(t.line, ring == rings ? 1 : 0.7));
    painter.drawArc(QRectF(origin().x() - r, origin().y() - r, 2 * r, 2 * r), 0, 180 * 16);
  }
  for (const int angle : {-90, -60, -30, 0, 30, 60, 90}) {
    painter.setPen(QPen(t.line, 0.7));
    painter.drawLine(origin(), place(angle, radius()));
    if (std::abs(angle) == 90) continue;
    painter.setPen(t.muted);
    const QPointF at = place(angle, radius() + 8);
    painter.drawText(QRectF(at.x() - 14, at.y() - 6, 28, 12), Qt::AlignCenter,
                     QStringLiteral("%1\u00b0").arg(std::abs(angle)));
  }
  painter.setPen(QPen(t.muted, 1));
  painter.drawLine(place(-90, radius()), place(90, radius()));
  painter.setPen(underMouse() ? t.text : t.muted);
  painter.drawText(scaleButton().adjusted(2, 0, 0, 0), Qt::AlignVCenter,
                   logarithmic_ ? tr("log \u25be") : tr("linear \u25be"));
  painter.setPen(t.muted);
  painter.drawText(QRect(width() - 110, 0, 108, 18), Qt::AlignVCenter | Qt::AlignRight,
                   tr("top %1 /sr").arg(formatNumber(lobe_.highest, lobe_.highest < 0.1 ? 4 : 2)));
}

void LobePlot::paintCurves(QPainter& painter) const {
  const Theme& t = theme();
  const auto curve = [&](auto value) {
    QPainterPath path(origin());
    for (std::size_t i = 0; i < lobe_.angles.size(); ++i)
      path.lineTo(place(lobe_.angles[i], lengthOf(value(i))));
    path.lineTo(origin());
    return path;
  };
  const QPainterPath all = curve([&](std::size_t i) { return lobe_.diffuse[i] + lobe_.specular[i]; });
  const QPainterPath diffuse = curve([&](std::size_t i) { return lobe_.diffuse[i]; });
  QColor fill = t.accent;
  fill.setAlphaF(0.22f);
  painter.fillPath(all, fill);
  QColor matte = t.muted;
  matte.setAlphaF(0.35f);
  painter.fillPath(diffuse, matte);
  painter.setPen(QPen(t.muted, 1.25));
  painter.drawPath(diffuse);
  if (lobe_.halfWidth <= 0) return;
  painter.setPen(QPen(t.accent, 1.5));
  painter.drawPath(all);
  // The exponent, where its lobe is half as high as at the mirror direction.
  for (const double side : {-1.0, 1.0}) {
    const double angle = lobe_.incidence + side * lobe_.halfWidth;
    if (std::abs(angle) > 90) continue;
    painter.setPen(QPen(t.accent, 1.25));
    painter.drawLine(place(angle, radius() - 4), place(angle, radius() + 3));
  }
  const QPointF mirror = place(std::min(lobe_.incidence, 76.0), radius() - 16);
  painter.setPen(t.text);
  const QString text =
      tr("s %1").arg(formatNumber(double(material_.exponent), material_.exponent < 10 ? 1 : 0));
  const double textWidth = painter.fontMetrics().horizontalAdvance(text) + 6;
  QRectF label(mirror.x() + 6, mirror.y() - 7, textWidth, 14);
  label.moveRight(std::min(label.right(), double(width()) - 2));
  painter.fillRect(label, QColor(t.panel.red(), t.panel.green(), t.panel.blue(), 190));
  painter.drawText(label, Qt::AlignCenter, text);
}

// The light comes in along an arrow.
void LobePlot::paintLight(QPainter& painter) const {
  const Theme& t = theme();
  const double angle = -lobe_.incidence;
  const QPointF from = place(angle, radius()), to = place(angle, 10);
  painter.setPen(QPen(dragging_ ? t.accent : t.text, 1.5, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(from, to);
  for (const double side : {-1.0, 1.0})
    painter.drawLine(to, to + (place(angle + 28 * side, 16) - place(angle + 28 * side, 8)) * 0.9);
  painter.setBrush(dragging_ ? t.accent : t.text);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(from, 3.5, 3.5);
}

// ---- mouse and keys ----

void LobePlot::turnLight(const QPointF& at) {
  const QPointF from = at - origin();
  // Either side of the normal means the same angle.
  setIncidence(std::clamp(degrees(std::atan2(std::abs(from.x()), -from.y())), 0.0, 89.0));
}

void LobePlot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
  if (scaleButton().contains(event->position().toPoint())) return setLogarithmic(!logarithmic_);
  dragging_ = true;
  turnLight(event->position());
}

void LobePlot::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) return;
  turnLight(event->position());
  QToolTip::showText(event->globalPosition().toPoint(), tip(), this);
}

void LobePlot::mouseReleaseEvent(QMouseEvent*) {
  dragging_ = false;
  update();
}

void LobePlot::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return setIncidence(std::min(89.0, lobe_.incidence + 1));
    case Qt::Key_Right:
      return setIncidence(std::max(0.0, lobe_.incidence - 1));
    default:
      QWidget::keyPressEvent(event);
  }
}

QString LobePlot::tip() const {
  const Rgb& a = lobe_.albedo;
  return tr("Light from %1\u00b0: reflects %2 % of red, %3 % of green, %4 % of blue.\n"
            "Curve: BRDF times cosine over the angle of exitance; grey the diffuse part, amber with the "
            "lobe.\n"
            "Drag to move the light.")
      .arg(lobe_.incidence, 0, 'f', 0)
      .arg(100 * double(a.x), 0, 'f', 1)
      .arg(100 * double(a.y), 0, 'f', 1)
      .arg(100 * double(a.z), 0, 'f', 1);
}

bool LobePlot::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), tip(), this);
  return true;
}

}  // namespace prt::ui
