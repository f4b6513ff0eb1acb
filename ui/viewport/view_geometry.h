#pragma once
// Between the scene and the pixels of a viewport: where a point appears, and what is under the pointer.
// Works on the camera's matrices, so it holds for whatever projection the camera has.

#include "libprt/shade/camera.h"

#include <QPointF>
#include <QSize>

#include <optional>

namespace prt::ui {

/// A line of sight; the direction is of unit length.
struct Sight {
  Vec3 origin;
  Vec3 direction;
};

class ViewGeometry {
 public:
  /// `size`: of the viewport, in logical pixels.
  ViewGeometry(const Camera& camera, const QSize& size);

  const Camera& camera() const { return camera_; }
  QSize size() const { return size_; }
  /// Where a point appears, in logical pixels from the top left; nothing when it is not in front of the eye.
  std::optional<QPointF> project(const Vec3& point) const;
  /// What is seen at a place of the viewport.
  Sight sightAt(const QPointF& at) const;
  /// The line of sight that ends at a point.
  Sight sightTo(const Vec3& point) const;

 private:
  Camera camera_;
  QSize size_;
  glm::dmat4 toClip_, fromClip_;
};

}  // namespace prt::ui
