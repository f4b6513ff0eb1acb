#pragma once
// The angle of the environment as a compass seen from above: the needle shows where the map's centre
// (its -Z) now stands. Dragging turns it; Shift turns finely, Ctrl snaps to 15 degrees.

#include <QWidget>

namespace prt::ui {

class Compass : public QWidget {
  Q_OBJECT
 public:
  explicit Compass(QWidget* parent = nullptr);

  /// Degrees, counter-clockwise seen from above.
  double angle() const { return angle_; }
  void setAngle(double degrees);
  QSize sizeHint() const override { return {72, 72}; }

 Q_SIGNALS:
  void turned(double degrees);
  void gestureBegan();
  void gestureEnded();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  double pointerAngle(const QPointF& at) const;

  double angle_ = 0, lastPointer_ = 0, exact_ = 0;
  bool dragging_ = false;
};

/// The same direction between -180 and 180 degrees.
double wrapDegrees(double degrees);

}  // namespace prt::ui
