#pragma once
// All light at a glance: the environment as a strip of sky, turned as it lights, the middle looking to -Z,
// with the lights on it at their true outlines. Dragging the sky sideways turns it; a double click adds a
// circle light there; lights are dragged by their middle and resized by their rim; the sun of the clear sky
// is dragged too.

#include "ui/model/light_editor.h"

#include <QImage>
#include <QWidget>

#include <memory>
#include <optional>

namespace prt {
class EnvironmentMap;
}

namespace prt::ui {

class Panorama : public QWidget {
  Q_OBJECT
 public:
  explicit Panorama(LightEditor& lights, QWidget* parent = nullptr);

  void setEnvironment(const std::shared_ptr<const EnvironmentMap>& map);
  void setAngle(double degrees);
  QSize sizeHint() const override { return {208, 104}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width / 2; }

 Q_SIGNALS:
  /// The user turned the environment by so many degrees.
  void turned(double degrees);
  void gestureBegan();
  void gestureEnded();
  /// A picker for this light's colour is wanted.
  void colorWanted(int light);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent*) override;
  bool event(QEvent* event) override;

 private:
  enum class Part { None, Sky, Light, Rim };
  struct Grip {
    Part part = Part::None;
    int light = -1;
    bool operator==(const Grip&) const = default;
  };
  Grip gripAt(const QPointF& at) const;
  std::optional<LightMark> markOf(int light) const;
  void beginDrag(const Grip& grip, const QPointF& at);
  void dragLight(const QPointF& at);
  void endDrag(bool keep);
  void paintSky(QPainter& painter) const;
  void paintMark(QPainter& painter, const LightMark& mark) const;
  void paintSun(QPainter& painter, const QPointF& at, const LightMark& mark, bool hot) const;
  void showCursor(const Grip& grip);

  LightEditor& lights_;
  std::shared_ptr<const EnvironmentMap> map_;
  QImage picture_;
  double angle_ = 0;
  Grip hovered_, dragged_;
  QPointF last_, offset_;  // of the pointer; from it to the middle of the dragged light
  double slack_ = 0;       // radians from the pointer to the dragged rim
};

}  // namespace prt::ui
