#pragma once
// Draws the scene with libprt's CPU renderer, for machines without OpenGL 4.5.

#include "libprt/transport/sample_set.h"
#include "ui/viewport/canvas.h"

#include <QImage>

namespace prt::ui {

class CpuCanvas : public QWidget, public Canvas {
  Q_OBJECT
 public:
  CpuCanvas(CanvasContext context, QWidget* parent);

  QWidget* widget() override { return this; }
  void invalidate() override { update(); }
  void setInteracting(bool interacting) override;
  void setThorough(bool) override {}
  bool settled() const override { return !interacting_; }
  double frameMilliseconds() const override { return milliseconds_; }
  QString describe() const override { return tr("CPU"); }
  QImage grabPicture() override;

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  void followScene();
  QImage draw();
  void layOver(Image& picture, double scale) const;

  CanvasContext context_;
  bool interacting_ = false;
  double milliseconds_ = 0;
  Scene scene_;        // with the materials of now
  SampleSet samples_;  // of the scene, as long as nothing is baked
  quint64 sceneVersion_ = 0, materialVersion_ = 0;
};

}  // namespace prt::ui
