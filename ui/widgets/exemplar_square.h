#pragma once
// The patch from above as its radiance transfer texture answers to the light of the scene, and the part of it
// that the brush paints: a press is its middle, a drag its size. The patch repeats, so the part may reach
// over its border.

#include "libprt/meso/rtt.h"

#include <QImage>
#include <QTimer>
#include <QWidget>

#include <memory>

namespace prt::ui {

class Session;
class WishEditor;

class ExemplarSquare : public QWidget {
  Q_OBJECT
 public:
  explicit ExemplarSquare(Session& session, QWidget* parent = nullptr);

  bool hasPicture() const { return !picture_.isNull(); }
  /// Where the patch is shown.
  QRectF square() const;
  QSize sizeHint() const override { return {kSide, kSide}; }
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent*) override;
  void showEvent(QShowEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  static constexpr int kSide = 144;
  void draw();

  Session& session_;
  WishEditor& wishes_;
  std::shared_ptr<const Rtt> rtt_;
  QImage picture_;
  QTimer redraw_;
  QPointF pressedAt_;
};

}  // namespace prt::ui
