#pragma once
// The environment as a strip of sky, turned as it lights: the middle looks to -Z. Dragging it sideways
// turns the light.

#include <QImage>
#include <QWidget>

#include <memory>

namespace prt {
class EnvironmentMap;
}

namespace prt::ui {

class Panorama : public QWidget {
  Q_OBJECT
 public:
  explicit Panorama(QWidget* parent = nullptr);

  void setEnvironment(const std::shared_ptr<const EnvironmentMap>& map);
  void setAngle(double degrees);
  QSize sizeHint() const override { return {208, 104}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width / 2; }

 Q_SIGNALS:
  /// The user turned the light by so many degrees.
  void turned(double degrees);
  void gestureBegan();
  void gestureEnded();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  std::shared_ptr<const EnvironmentMap> map_;
  QImage picture_;
  double angle_ = 0;
  bool dragging_ = false;
  double lastX_ = 0;
};

/// A lat-long picture of the map for the screen, exposed so that its mean is a middle grey.
QImage panoramaPicture(const EnvironmentMap& map, int width, int height);

}  // namespace prt::ui
