#include "ui/widgets/parameter_slider.h"

#include "libprt/core/error.h"
#include "ui/model/expression.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <nlohmann/json.hpp>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr double kLogarithmicFrom = 100;       // ranges wider than this, by factors
constexpr double kLeft = kLabelWidth + kGrid;  // under the field of a row
constexpr double kRight = kResetWidth + kGrid;
constexpr double kKnob = 5;   // radius in pixels
constexpr double kTrack = 8;  // from the top
constexpr double kFine = 0.1;

}  // namespace

ParameterSlider::ParameterSlider(Document& document, const QString& path, QWidget* parent)
    : QWidget(parent),
      document_(document),
      path_(path),
      parameter_(parameterAt(path.toStdString())),
      logarithmic_(parameter_.low > 0 && parameter_.high / parameter_.low >= kLogarithmicFrom) {
  setObjectName(path + QStringLiteral(" slider"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setFixedHeight(sizeHint().height());
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(parameterTip(parameter_));
  connect(&document_, &Document::recipeChanged, this, &ParameterSlider::refresh);
  refresh();
}

QSize ParameterSlider::sizeHint() const {
  return {200, 28};
}

double ParameterSlider::placeOf(double value) const {
  const double low = parameter_.low, high = parameter_.high;
  const double share = logarithmic_ ? std::log(std::max(value, low) / low) / std::log(high / low)
                                    : (value - low) / (high - low);
  return kLeft + kKnob + std::clamp(share, 0.0, 1.0) * (width() - kLeft - kRight - 2 * kKnob);
}

double ParameterSlider::valueAt(double x) const {
  const double low = parameter_.low, high = parameter_.high;
  const double share =
      std::clamp((x - kLeft - kKnob) / std::max(1.0, width() - kLeft - kRight - 2 * kKnob), 0.0, 1.0);
  // Three digits, as people would type them.
  const double value = logarithmic_ ? low * std::pow(high / low, share) : low + share * (high - low);
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(std::abs(value), 1e-9))) - 2);
  return std::clamp(std::round(value / unit) * unit, low, high);
}

std::vector<double> ParameterSlider::marks() const {
  if (!logarithmic_) return {parameter_.low, 0.5 * (parameter_.low + parameter_.high), parameter_.high};
  std::vector<double> decades;
  for (double at = std::pow(10, std::ceil(std::log10(parameter_.low) - 1e-9));
       at <= parameter_.high * 1.000001; at *= 10)
    decades.push_back(at);
  return decades;
}

void ParameterSlider::refresh() {
  try {
    value_ = getByPath(document_.recipe(), path_.toStdString()).get<double>();
    setEnabled(true);
  } catch (const Error&) {
    setEnabled(false);  // the recipe has no such object at the moment
  }
  update();
}

void ParameterSlider::change(double value) {
  value = std::clamp(value, parameter_.low, parameter_.high);
  if (value != value_) document_.set(path_, QString::number(value, 'g', 6));
}

void ParameterSlider::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  const bool hot = isEnabled() && (underMouse() || dragging_);
  const double begin = placeOf(parameter_.low), end = placeOf(parameter_.high), at = placeOf(value_);
  painter.setPen(QPen(t.line, 3, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(begin, kTrack), QPointF(end, kTrack));
  painter.setPen(QPen(hot ? t.accent : t.muted, 3, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(begin, kTrack), QPointF(at, kTrack));
  QFont small = font();
  small.setPointSizeF(7);
  painter.setFont(small);
  for (const double mark : marks()) {
    const double x = placeOf(mark);
    painter.setPen(QPen(t.muted, 1));
    painter.drawLine(QPointF(x, kTrack + 4), QPointF(x, kTrack + 7));
    const QString text = mark >= 1000 ? QStringLiteral("%1k").arg(mark / 1000) : formatNumber(mark, 2);
    painter.drawText(QRectF(x - 16, kTrack + 7, 32, 12), Qt::AlignCenter, text);
  }
  painter.setPen(QPen(hasFocus() ? t.accent : t.panel, 1.5));
  painter.setBrush(isEnabled() ? (hot ? t.accent : t.text) : t.muted);
  painter.drawEllipse(QPointF(at, kTrack), kKnob, kKnob);
}

void ParameterSlider::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
  dragging_ = true;
  document_.beginGesture(editName(document_.recipe(), path_));
  change(valueAt(event->position().x()));
}

void ParameterSlider::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_) change(valueAt(event->position().x()));
}

void ParameterSlider::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !dragging_) return;
  dragging_ = false;
  document_.endGesture();
  update();
}

void ParameterSlider::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && dragging_) {
    dragging_ = false;
    return document_.cancelGesture();
  }
  const bool up = event->key() == Qt::Key_Right || event->key() == Qt::Key_Up;
  const bool down = event->key() == Qt::Key_Left || event->key() == Qt::Key_Down;
  if (!up && !down) return QWidget::keyPressEvent(event);
  const double steps = (up ? 1 : -1) * (event->modifiers() & Qt::ShiftModifier ? kFine : 1);
  const double range = parameter_.high - parameter_.low;
  change(logarithmic_ ? value_ * std::pow(parameter_.high / parameter_.low, steps / 100)
                      : value_ + steps * range / 100);
}

}  // namespace prt::ui
