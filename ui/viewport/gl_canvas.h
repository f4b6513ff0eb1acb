#pragma once
// Draws the scene with prt_gl inside Qt's OpenGL context.

#include "ui/viewport/canvas.h"

#include <QOpenGLWidget>

#include <memory>

namespace prt::gl {
class SceneRenderer;
class SurfaceOverlay;
}  // namespace prt::gl

namespace prt {
struct TurnedTransfer;
}

namespace prt::ui {

enum class GlSupport { None, Software, Hardware };

class GlCanvas : public QOpenGLWidget, public Canvas {
  Q_OBJECT
 public:
  GlCanvas(CanvasContext context, QWidget* parent);
  ~GlCanvas() override;

  /// Asks for OpenGL 4.5 core in every context made from now on. Before the application object.
  static void requestFormat();
  /// What this machine gives, worked out once: no such context, one that the CPU draws, or a graphics card's.
  /// Needs the application object.
  static GlSupport support();

  QWidget* widget() override { return this; }
  void invalidate() override;
  void setInteracting(bool interacting) override;
  void setThorough(bool thorough) override;
  bool settled() const override;
  double frameMilliseconds() const override { return milliseconds_; }
  quint64 frames() const override { return frames_; }
  QString describe() const override { return description_; }
  QImage grabPicture() override;
  /// Whether transfer is kept where the picture is drawn: on graphics cards, unless somebody says otherwise.
  void setKeepsTransfer(bool keeps);
  bool transferKept() const { return kept_; }

 Q_SIGNALS:
  /// The driver refused a shader or ran out of memory; nothing more will be drawn.
  void failed(const QString& message);

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;

 private:
  void release();
  void uploadChanges();
  void uploadLight();
  void uploadPatchLight();
  void turnTransfer();
  void drawScene();
  void drawLayers();
  void goOn(double milliseconds);

  CanvasContext context_;
  std::unique_ptr<gl::SceneRenderer> renderer_;
  std::unique_ptr<gl::SurfaceOverlay> layers_;  // made when there is something to lay over
  bool interacting_ = false;
  bool broken_ = false;
  bool thorough_ = false;  // always in passes
  double milliseconds_ = 0;
  quint64 frames_ = 0;
  bool inPasses_ =
      false;      // smooth edges come from several passes over time, not from several samples at once
  int pass_ = 0;  // of the next frame
  bool finished_ = false;  // the last pass since the last change is on the screen
  QString description_;
  quint64 scene_ = 0, light_ = 0, materials_ = 0;
  std::shared_ptr<const EnvironmentMap> backdrop_;  // that was uploaded
  std::shared_ptr<const BiscaleSurface> patch_;     // the same
  // Transfer in the patch's frames for the card, made behind the interface: of what, and what was made.
  std::shared_ptr<const Transfer> turnedOf_;
  std::shared_ptr<const TurnedTransfer> turned_;
  std::size_t mostKept_ = 0;  // bytes
  bool keeps_, kept_ = false;
  quint64 layersScene_ = 0, layersValues_ = 0, layersPaint_ = 0, layersMarks_ = 0;
};

}  // namespace prt::ui
