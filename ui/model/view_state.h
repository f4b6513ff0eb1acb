#pragma once
// How the viewport looks at the scene. Not part of the recipe: moving the camera is not an edit.

#include "libprt/shade/camera.h"
#include "libprt/shade/tonemap.h"

#include <QObject>

namespace prt::ui {

enum class BackgroundMode { Environment, Plain };

class ViewState : public QObject {
  Q_OBJECT
 public:
  explicit ViewState(QObject* parent = nullptr) : QObject(parent) {}

  const Camera& camera() const { return camera_; }
  const ToneSettings& tone() const { return tone_; }
  BackgroundMode background() const { return background_; }

  void setCamera(const Camera& camera);
  void setTone(const ToneSettings& tone);
  void setBackground(BackgroundMode background);

  /// What reset() returns to.
  void setHome(const Camera& camera) { home_ = camera; }
  void reset() { setCamera(home_); }
  /// Moves the camera, not turning it, until the box fills the view.
  void frame(const Box3& box);

  /// Turns about the target. `dx`, `dy`: how far the pointer moved, in heights of the view. The
  /// horizon stays level and the poles are not crossed.
  void orbit(float dx, float dy);
  /// Moves sideways so that the target follows the pointer; in heights of the view.
  void pan(float dx, float dy);
  /// Moves nearer (steps > 0) or farther. What is under the pointer stays there: `x`, `y` is its place
  /// from the middle of the view in heights, y upwards.
  void zoom(float steps, float x, float y);

 Q_SIGNALS:
  void changed();

 private:
  Camera camera_, home_;
  ToneSettings tone_;
  BackgroundMode background_ = BackgroundMode::Environment;
};

}  // namespace prt::ui
