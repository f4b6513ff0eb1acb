#pragma once
// The surface that a viewport draws on: OpenGL where there is 4.5, else the CPU renderer. A canvas only
// draws; mouse and keys go to the viewport around it.

#include "ui/model/job_runner.h"
#include "ui/model/relighter.h"
#include "ui/model/surface_layers.h"
#include "ui/model/view_state.h"

#include <QWidget>

#include <functional>
#include <memory>
#include <vector>

namespace prt::ui {

/// What a canvas draws from, and what it tells back.
struct CanvasContext {
  Relighter& relighter;
  const ViewState& view;
  const SurfaceLayers& layers;
  JobRunner& jobs;
  std::function<void(QPainter&)> paintOverlay;  ///< drawn over every frame, in logical pixels
};

/// What of the light is seen behind the model. Out of focus, circles are not drawn: their handles tell.
struct Sky {
  std::shared_ptr<const EnvironmentMap> map;  ///< lat-long; null: none
  std::vector<CircleLight> circles;
  Rgb constant{0};

  bool any() const { return map || !circles.empty() || constant != Rgb(0); }
};
inline Sky skyBehind(const Relighter& lit, const ViewState& view) {
  switch (view.background()) {
    case BackgroundMode::Environment:
      return {lit.backdrop(), lit.rig().circles, lit.rig().constant};
    case BackgroundMode::Blurred:
      return {lit.blurredBackdrop(), {}, lit.rig().constant};
    case BackgroundMode::Plain:
      break;
  }
  return {};
}

/// The overlay's picture for a canvas of this size in logical pixels.
inline OverlayPicture overlayPicture(const Camera& camera, const QSize& size, double pixelRatio,
                                     bool interacting) {
  return {.camera = camera,
          .width = std::max(1, qRound(size.width() * pixelRatio)),
          .height = std::max(1, qRound(size.height() * pixelRatio)),
          .grid = interacting ? 1 : 2,
          .pixelScale = float(pixelRatio)};
}

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual QWidget* widget() = 0;
  /// What is shown has changed.
  virtual void invalidate() = 0;
  /// Only what lies over the surface has: false colour, paint, marks.
  virtual void invalidateLayers() { invalidate(); }
  /// While the user drags, a frame in time is worth more than smooth edges.
  virtual void setInteracting(bool interacting) = 0;
  /// Edges as smooth as they get, whatever it costs: for pictures that are the same each time.
  virtual void setThorough(bool thorough) = 0;
  /// Whether what is on the screen stays as it is until something changes.
  virtual bool settled() const = 0;
  /// Milliseconds that the last frame took: relighting, drawing, tone mapping.
  virtual double frameMilliseconds() const = 0;
  /// Whether that frame had fewer pixels than the screen, to keep up with the hand.
  virtual bool coarse() const { return false; }
  /// Frames that have reached the screen so far.
  virtual quint64 frames() const = 0;
  /// "OpenGL 4.5, llvmpipe" or "CPU".
  virtual QString describe() const = 0;
  /// The picture without overlay as it is now on the screen.
  virtual QImage grabPicture() = 0;
};

}  // namespace prt::ui
