#pragma once
// How a material reflects, as a polar plot in the plane of incidence: the length of the curve in each
// direction is the BRDF times the cosine there. Dragging moves the light; a click on the scale's name changes
// between log and linear.

#include "ui/model/lobe.h"

#include <QWidget>

class QPainterPath;

namespace prt::ui {

class LobePlot : public QWidget {
  Q_OBJECT
 public:
  explicit LobePlot(QWidget* parent = nullptr);

  void setMaterial(const Material& material);
  double incidence() const { return lobe_.incidence; }
  /// Degrees from the normal, 0 .. 89.
  void setIncidence(double degrees);
  bool logarithmic() const { return logarithmic_; }
  void setLogarithmic(bool logarithmic);
  const Lobe& lobe() const { return lobe_; }
  /// Where the name of the scale is, to be clicked.
  QRect scaleButton() const;

  QSize sizeHint() const override { return {240, 128}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width / 2 + 20; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void refresh();
  QPointF origin() const;
  double radius() const;
  double lengthOf(double value) const;
  QPointF place(double angle, double length) const;
  void paintGrid(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  void paintLight(QPainter& painter) const;
  QString tip() const;
  void turnLight(const QPointF& at);

  Material material_;
  Lobe lobe_;
  bool logarithmic_ = false, dragging_ = false;
};

}  // namespace prt::ui
