#pragma once
// A colour as a swatch with its numbers; a click opens a small picker under it. Colours are linear
// Rec.709: reflectances in 0..1, or light, whose brightness has no limit; the swatch shows them as the screen
// does, light at the brightness of its largest channel.

#include "libprt/core/math.h"

#include <QImage>
#include <QWidget>

namespace prt::ui {

class NumberField;

/// What a screen shows for a linear colour, and back.
QColor toScreen(const Rgb& linear);
/// The same for light: scaled down until nothing is above 1.
QColor toScreenScaled(const Rgb& light);
Rgb fromScreen(const QColor& color);

class ColorField : public QWidget {
  Q_OBJECT
 public:
  enum class Kind { Reflectance, Light };
  explicit ColorField(Kind kind = Kind::Reflectance, QWidget* parent = nullptr);

  const Rgb& color() const { return color_; }
  /// Shows a colour; says nothing.
  void setColor(const Rgb& color);
  void openPicker();
  QSize sizeHint() const override;

 Q_SIGNALS:
  void edited(const Rgb& color);
  void gestureBegan();
  void gestureEnded();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void enterEvent(QEnterEvent*) override { update(); }
  void leaveEvent(QEvent*) override { update(); }

 private:
  void change(const Rgb& color);

  Kind kind_;
  Rgb color_{0.5f};
  class ColorPicker* picker_ = nullptr;
};

/// Saturation and value as a square, hue as a strip, and the three linear numbers. Of light, the square
/// chooses the tint and keeps the brightness: the upper edge is the light's largest channel.
class ColorPicker : public QWidget {
  Q_OBJECT
 public:
  ColorPicker(ColorField::Kind kind, QWidget* parent);
  void setColor(const Rgb& color);

 Q_SIGNALS:
  void picked(const Rgb& color);
  void gestureBegan();
  void gestureEnded();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  QRect square() const;
  QRect strip() const;
  void drag(const QPointF& at);
  void showNumbers(const Rgb& color);

  ColorField::Kind kind_;
  float scale_ = 1;  // of light: what the square's white stands for
  float hue_ = 0, saturation_ = 0, value_ = 0.5f;
  enum class Part { None, Square, Strip } dragged_ = Part::None;
  NumberField* numbers_[3];
  QImage squareImage_;
  float squareHue_ = -1;
};

}  // namespace prt::ui
