#pragma once
// A colour as a swatch with its numbers; a click opens a small picker under it. Colours are linear
// Rec.709 reflectances in 0..1; the swatch shows them as the screen does.

#include "libprt/core/math.h"

#include <QImage>
#include <QWidget>

namespace prt::ui {

class NumberField;

/// What a screen shows for a linear colour, and back.
QColor toScreen(const Rgb& linear);
Rgb fromScreen(const QColor& color);

class ColorField : public QWidget {
  Q_OBJECT
 public:
  explicit ColorField(QWidget* parent = nullptr);

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

  Rgb color_{0.5f};
  class ColorPicker* picker_ = nullptr;
};

/// Saturation and value as a square, hue as a strip, and the three linear numbers.
class ColorPicker : public QWidget {
  Q_OBJECT
 public:
  explicit ColorPicker(QWidget* parent);
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

  float hue_ = 0, saturation_ = 0, value_ = 0.5f;
  enum class Part { None, Square, Strip } dragged_ = Part::None;
  NumberField* numbers_[3];
  QImage squareImage_;
  float squareHue_ = -1;
};

}  // namespace prt::ui
