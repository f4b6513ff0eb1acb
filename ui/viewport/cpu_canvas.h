#pragma once
// Draws the scene on the CPU: for machines without a graphics card, where it is several times faster than
// OpenGL in software. While something changes every frame is drawn at once, one sample per pixel (fewer where
// that takes too long for a hand to follow); when it rests, a picture with smooth edges is made behind the
// interface and takes its place.

#include "libprt/shade/live_renderer.h"
#include "ui/viewport/canvas.h"

#include <QImage>
#include <QThreadPool>
#include <QTimer>

#include <memory>
#include <vector>

namespace prt::ui {

class CpuCanvas : public QWidget, public Canvas {
  Q_OBJECT
 public:
  CpuCanvas(CanvasContext context, QWidget* parent);
  ~CpuCanvas() override;

  QWidget* widget() override { return this; }
  void invalidate() override;
  void invalidateLayers() override;
  void setInteracting(bool interacting) override;
  void setThorough(bool thorough) override;
  bool settled() const override;
  double frameMilliseconds() const override { return milliseconds_; }
  bool coarse() const override { return frame_.size() != pixels(1); }
  quint64 frames() const override { return frames_; }
  QString describe() const override { return tr("CPU"); }
  QImage grabPicture() override;

 Q_SIGNALS:
  /// The renderer refused what it was given.
  void failed(const QString& message);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  /// One picture that is being made, or was; shared with the thread that makes it.
  struct Smooth {
    quint64 version = 0;
    Job job;
    QImage surface, image;  // without and with what lies over it
  };

  /// What lies over the picture, as it is now.
  struct Layers {
    std::vector<float> values;
    SurfacePaint paint;
    std::vector<SurfaceMarks> marks;
    float pixelScale = 1;
    int grid = 1;
  };

  static QImage surfaceOf(LiveRenderer& renderer, const LiveScene& scene, const LivePicture& picture,
                          Job& job);
  static QImage withLayers(const QImage& surface, const LiveScene& scene, const Camera& camera,
                           const Layers& layers, Job& job);
  Layers layersNow(double scale, int grid) const;
  QSize pixels(double scale) const;
  LiveScene liveScene() const;
  LivePicture livePicture(const QSize& size, int grid) const;
  void drawFrame();
  void startSmooth();
  void change();
  int smoothGrid() const;

  CanvasContext context_;
  LiveRenderer renderer_;
  QImage surface_, frame_;          // without and with what lies over it
  std::shared_ptr<Smooth> smooth_;  // the newest one
  quint64 version_ = 1;             // of what is to be seen
  quint64 surfaceVersion_ = 1;      // the version_ since which only the layers have changed
  quint64 drawn_ = 0;               // of frame_
  bool interacting_ = false, thorough_ = false, coarse_ = false, broken_ = false;
  QString problem_;  // that was told last
  double milliseconds_ = 0;
  quint64 frames_ = 0;
  QTimer rest_;
  QThreadPool smoothing_;  // one thread; goes first
};

}  // namespace prt::ui
