#pragma once
// The square patch under the light of the scene, texel by texel, as its radiance transfer texture answers.
// Dragging moves the eye over the hemisphere, shown as a small disc with the zenith in its middle.

#include <QImage>
#include <QWidget>

namespace prt::ui {

class RttLook;
class ViewState;

class RttSquare : public QWidget {
  Q_OBJECT
 public:
  RttSquare(RttLook& look, const ViewState& view, QWidget* parent = nullptr);

  /// Where the disc of views is.
  QRectF disc() const;
  QSize sizeHint() const override { return {248, 248}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void showEvent(QShowEvent*) override;
  void hideEvent(QHideEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void follow();
  void moveEye(const QPointF& by);
  void paintDisc(QPainter& painter) const;

  RttLook& look_;
  const ViewState& view_;
  QImage picture_;
  QPointF last_;
};

}  // namespace prt::ui
