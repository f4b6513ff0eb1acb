#include "ui/viewport/view_geometry.h"

#include <algorithm>

namespace prt::ui {

namespace {

// Depths between which the matrices are sound; relative to the camera's own distance to what it looks at.
constexpr float kNear = 0.01f, kFar = 100.0f;

}  // namespace

ViewGeometry::ViewGeometry(const Camera& camera, const QSize& size)
    : camera_(camera), size_(size.expandedTo(QSize(1, 1))) {
  const float distance = std::max(length(camera.target - camera.eye), 1e-6f);
  const float nearest = camera.orthographic ? -kFar : kNear;  // parallel rays see what is behind the eye
  const float aspect = float(size_.width()) / float(size_.height());
  toClip_ =
      glm::dmat4(camera.projection(aspect, nearest * distance, kFar * distance)) * glm::dmat4(camera.view());
  fromClip_ = inverse(toClip_);
}

std::optional<QPointF> ViewGeometry::project(const Vec3& point) const {
  const glm::dvec4 clip = toClip_ * glm::dvec4(point, 1);
  if (clip.w <= 0 || clip.z < -clip.w) return {};
  return QPointF(0.5 * (1 + clip.x / clip.w) * size_.width(), 0.5 * (1 - clip.y / clip.w) * size_.height());
}

Sight ViewGeometry::sightAt(const QPointF& at) const {
  const double x = 2 * at.x() / size_.width() - 1, y = 1 - 2 * at.y() / size_.height();
  const auto point = [&](double depth) {
    const glm::dvec4 p = fromClip_ * glm::dvec4(x, y, depth, 1);
    return DVec3(p) / p.w;
  };
  const Vec3 direction(normalize(point(0.5) - point(-1)));
  // From the eye itself rather than from the near plane, when all sights meet there.
  const bool meets = toClip_[0].w != 0 || toClip_[1].w != 0 || toClip_[2].w != 0;
  return {meets ? camera_.eye : Vec3(point(-1)), direction};
}

Sight ViewGeometry::sightTo(const Vec3& point) const {
  const auto at = project(point);
  if (!at) return {camera_.eye, normalize(point - camera_.eye)};
  return sightAt(*at);
}

}  // namespace prt::ui
