#include "ui/widgets/color_field.h"

#include "libprt/shade/tonemap.h"
#include "ui/model/expression.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/theme.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace prt::ui {

namespace {
constexpr int kSquare = 160, kStrip = 16, kMargin = 8;
constexpr double kBrightest = 1e9;  // of light, as in the recipe's table

float brightness(const Rgb& c) {
  return std::max({c.x, c.y, c.z, 1.0f});
}
}  // namespace

QColor toScreen(const Rgb& c) {
  const auto channel = [](float v) { return encodeSrgb(std::clamp(v, 0.0f, 1.0f)); };
  return QColor::fromRgbF(channel(c.x), channel(c.y), channel(c.z));
}

QColor toScreenScaled(const Rgb& light) {
  return toScreen(light / brightness(light));
}

Rgb fromScreen(const QColor& c) {
  return {decodeSrgb(float(c.redF())), decodeSrgb(float(c.greenF())), decodeSrgb(float(c.blueF()))};
}

ColorField::ColorField(Kind kind, QWidget* parent) : QWidget(parent), kind_(kind) {
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setFixedHeight(kRowHeight - 2);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize ColorField::sizeHint() const {
  return {96, kRowHeight - 2};
}

void ColorField::setColor(const Rgb& color) {
  color_ = color;
  setAccessibleName(toScreenScaled(color).name());
  if (picker_) picker_->setColor(color);
  update();
}

void ColorField::change(const Rgb& color) {
  if (color == color_) return;
  color_ = color;
  update();
  Q_EMIT edited(color);
}

void ColorField::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  painter.setPen(hasFocus() ? t.accent : (underMouse() ? t.line : t.field));
  painter.setBrush(underMouse() ? t.fieldHover : t.field);
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(t.line);
  painter.setBrush(toScreenScaled(color_));
  painter.drawRoundedRect(box.adjusted(3, 3, -(box.width() - 27), -3), 2, 2);
  painter.setPen(t.text);
  const QString numbers =
      QStringLiteral("%1 %2 %3")
          .arg(formatNumber(color_.x, 2), formatNumber(color_.y, 2), formatNumber(color_.z, 2));
  painter.drawText(box.adjusted(30, 0, -6, -1), Qt::AlignVCenter | Qt::AlignRight, numbers);
}

void ColorField::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && rect().contains(event->position().toPoint())) openPicker();
}

void ColorField::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter || event->key() == Qt::Key_Space)
    openPicker();
  else
    QWidget::keyPressEvent(event);
}

void ColorField::openPicker() {
  if (!picker_) {
    picker_ = new ColorPicker(kind_, this);
    connect(picker_, &ColorPicker::picked, this, &ColorField::change);
    connect(picker_, &ColorPicker::gestureBegan, this, &ColorField::gestureBegan);
    connect(picker_, &ColorPicker::gestureEnded, this, &ColorField::gestureEnded);
  }
  picker_->setColor(color_);
  picker_->adjustSize();
  picker_->move(mapToGlobal(QPoint(width() - picker_->width(), height() + 2)));
  picker_->show();
}

ColorPicker::ColorPicker(ColorField::Kind kind, QWidget* parent) : QWidget(parent, Qt::Popup), kind_(kind) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(kMargin, kSquare + 2 * kMargin, kMargin, kMargin);
  grid->setSpacing(2);
  const bool light = kind_ == ColorField::Kind::Light;
  const QString names[] = {tr("Red"), tr("Green"), tr("Blue")};
  for (int i = 0; i < 3; ++i) {
    auto* label = new QLabel(names[i]);
    setRole(label, "muted");
    numbers_[i] = new NumberField({.low = 0, .high = light ? kBrightest : 1, .decimals = 3, .unit = {}});
    grid->addWidget(label, i, 0);
    grid->addWidget(numbers_[i], i, 1);
    connect(numbers_[i], &NumberField::edited, this, [this] {
      const Rgb color(numbers_[0]->value(), numbers_[1]->value(), numbers_[2]->value());
      setColor(color);
      Q_EMIT picked(color);
    });
    connect(numbers_[i], &NumberField::gestureBegan, this, &ColorPicker::gestureBegan);
    connect(numbers_[i], &NumberField::gestureEnded, this, &ColorPicker::gestureEnded);
  }
  setFixedWidth(kSquare + kStrip + 3 * kMargin);
}

QRect ColorPicker::square() const {
  return {kMargin, kMargin, kSquare, kSquare};
}
QRect ColorPicker::strip() const {
  return {2 * kMargin + kSquare, kMargin, kStrip, kSquare};
}

void ColorPicker::setColor(const Rgb& color) {
  if (dragged_ == Part::None) {
    float hue, saturation, value;
    scale_ = brightness(color);
    toScreenScaled(color).getHsvF(&hue, &saturation, &value);
    if (hue >= 0 && saturation > 0) hue_ = hue;  // grey has no hue: keep the one chosen
    saturation_ = saturation;
    value_ = value;
  }
  showNumbers(color);
  update();
}

void ColorPicker::showNumbers(const Rgb& color) {
  for (int i = 0; i < 3; ++i) numbers_[i]->setValue(color[i]);
}

void ColorPicker::paintEvent(QPaintEvent*) {
  if (squareHue_ != hue_) {
    squareImage_ = QImage(kSquare, kSquare, QImage::Format_RGB32);
    for (int y = 0; y < kSquare; ++y)
      for (int x = 0; x < kSquare; ++x)
        squareImage_.setPixelColor(
            x, y, QColor::fromHsvF(hue_, x / float(kSquare - 1), 1 - y / float(kSquare - 1)));
    squareHue_ = hue_;
  }
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme().panel);
  painter.setPen(theme().line);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
  painter.drawImage(square(), squareImage_);
  QLinearGradient hues(strip().topLeft(), strip().bottomLeft());
  for (int i = 0; i <= 6; ++i) hues.setColorAt(i / 6.0, QColor::fromHsvF(float(i % 6) / 6, 1, 1));
  painter.fillRect(strip(), hues);

  painter.setPen(QPen(Qt::white, 1.5));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(
      QPointF(square().left() + saturation_ * kSquare, square().top() + (1 - value_) * kSquare), 4, 4);
  const double y = strip().top() + hue_ * kSquare;
  painter.drawLine(QPointF(strip().left() - 2, y), QPointF(strip().right() + 3, y));
}

void ColorPicker::mousePressEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  dragged_ = square().contains(at) ? Part::Square : (strip().contains(at) ? Part::Strip : Part::None);
  if (dragged_ == Part::None) return QWidget::mousePressEvent(event);  // outside: closes the popup
  Q_EMIT gestureBegan();
  drag(event->position());
}

void ColorPicker::mouseMoveEvent(QMouseEvent* event) {
  if (dragged_ != Part::None) drag(event->position());
}

void ColorPicker::mouseReleaseEvent(QMouseEvent*) {
  if (dragged_ == Part::None) return;
  dragged_ = Part::None;
  Q_EMIT gestureEnded();
}

void ColorPicker::drag(const QPointF& at) {
  const float x = std::clamp(float(at.x() - square().left()) / kSquare, 0.0f, 1.0f);
  const float y = std::clamp(float(at.y() - square().top()) / kSquare, 0.0f, 1.0f);
  if (dragged_ == Part::Strip)
    hue_ = std::min(y, 0.9999f);
  else
    saturation_ = x, value_ = 1 - y;
  const Rgb color = scale_ * fromScreen(QColor::fromHsvF(hue_, saturation_, value_));
  showNumbers(color);
  update();
  Q_EMIT picked(color);
}

}  // namespace prt::ui
