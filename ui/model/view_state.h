#pragma once
// How the viewport looks at the scene. Not part of the recipe: moving the camera is not an edit.

#include "libprt/shade/camera.h"
#include "libprt/shade/tonemap.h"
#include "ui/model/navigation.h"

#include <QObject>

namespace prt::ui {

enum class BackgroundMode { Environment, Blurred, Plain };

class ViewState : public QObject {
  Q_OBJECT
 public:
  explicit ViewState(QObject* parent = nullptr) : QObject(parent) {}

  const Camera& camera() const { return camera_; }
  const ToneSettings& tone() const { return tone_; }
  BackgroundMode background() const { return background_; }
  bool grid() const { return grid_; }
  bool compass() const { return compass_; }
  NavigationPreset navigation() const { return navigation_; }

  void setCamera(const Camera& camera);
  void setTone(const ToneSettings& tone);
  void setBackground(BackgroundMode background) { set(background_, background); }
  void setGrid(bool grid) { set(grid_, grid); }
  void setCompass(bool compass) { set(compass_, compass); }
  void setNavigation(NavigationPreset navigation) { set(navigation_, navigation); }
  /// Parallel rays or a pinhole; the size of things at the target stays.
  void setOrthographic(bool orthographic);
  /// Looks at the target from this side, from as far away as now; the horizon stays level.
  void lookFrom(const Vec3& direction);

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
  template <class T>
  void set(T& value, const T& next) {
    if (value == next) return;
    value = next;
    Q_EMIT changed();
  }

  Camera camera_, home_;
  ToneSettings tone_;
  BackgroundMode background_ = BackgroundMode::Environment;
  bool grid_ = false, compass_ = true;
  NavigationPreset navigation_ = NavigationPreset::Blender;
};

}  // namespace prt::ui
