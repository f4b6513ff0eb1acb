#include "libprt/shade/camera.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace prt {
namespace {

/// `v` at unit length, or `otherwise` where that is not defined.
Vec3 unitOr(const Vec3& v, const Vec3& otherwise) {
  const DVec3 d(v);
  const double norm = length(d);
  return std::isfinite(norm) && norm > 0 ? Vec3(d / norm) : otherwise;
}

}  // namespace

Frame Camera::axes() const {
  const Vec3 back = unitOr(eye - target, {0, 0, 1});
  const Vec3 wanted = unitOr(up, {0, 1, 0});
  // Far from parallel, the sine is the length of the cross product; at 1e-4 float directions still hold.
  const Vec3 spare = std::abs(back.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  const Vec3 side = length(cross(wanted, back)) > 1e-4f ? cross(wanted, back) : cross(spare, back);
  const Vec3 right = normalize(side);
  return {right, cross(back, right), back};
}

float Camera::viewHeight() const {
  return 2 * length(eye - target) * std::tan(0.5f * verticalFov);
}

Vec3 Camera::towardsViewer(const Vec3& position) const {
  const Vec3 arm = eye - position;
  const float distance = length(arm);
  return !orthographic && distance > 0 ? arm / distance : axes().normal;
}

std::optional<Vec2> Camera::project(const Vec3& point, int width, int height) const {
  const Vec3 local = axes().toLocal(point - eye);
  const float reach = orthographic ? 0.5f * viewHeight()
                                   : -local.z * std::tan(0.5f * verticalFov);  // half the picture, there
  if (!(reach > 0)) return std::nullopt;
  const float scale = 0.5f * float(height) / reach;
  return Vec2(0.5f * float(width) + scale * local.x, 0.5f * float(height) - scale * local.y);
}

Vec3 Camera::direction(float x, float y, int width, int height) const {
  return CameraRays(*this, width, height).direction(x, y);
}

Mat4 Camera::view() const {
  const Frame f = axes();
  Mat4 m(1.0f);
  const Vec3 rows[3] = {f.tangent, f.bitangent, f.normal};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[c][r] = rows[r][c];
    m[3][r] = -dot(rows[r], eye);
  }
  return m;
}

Mat4 Camera::projection(float aspect, float nearPlane, float farPlane) const {
  if (!orthographic) return glm::perspectiveRH_NO(verticalFov, aspect, nearPlane, farPlane);
  const float halfHeight = 0.5f * viewHeight(), halfWidth = aspect * halfHeight;
  return glm::orthoRH_NO(-halfWidth, halfWidth, -halfHeight, halfHeight, nearPlane, farPlane);
}

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : eye_(camera.eye), orthographic_(camera.orthographic) {
  const Frame f = camera.axes();
  axis_ = f.normal;
  spread_ = orthographic_ ? length(camera.eye - camera.target) : 0.0f;
  const float pixel = 2 * std::tan(0.5f * camera.verticalFov) / float(height);
  right_ = pixel * f.tangent;
  down_ = -pixel * f.bitangent;
  corner_ = -f.normal - 0.5f * float(width) * right_ - 0.5f * float(height) * down_;
}

Camera frameBox(const Box3& box, float verticalFov) {
  Camera camera;
  camera.verticalFov = verticalFov;
  if (box.empty() || !isFinite(box.low) || !isFinite(box.high)) return camera;

  const Vec3 fromTarget = normalize(Vec3(0.55f, 0.4f, 1.0f));
  camera.target = box.center();
  camera.eye = camera.target + fromTarget;
  const Frame f = camera.axes();

  // Nearest distance at which every corner keeps inside a square image, with 8 % left over.
  const float slope = 0.92f * std::tan(0.5f * verticalFov);
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                 corner & 4 ? box.high.z : box.low.z);
    const Vec3 local = f.toLocal(p - camera.target);
    distance = std::max(distance, local.z + std::max(std::abs(local.x), std::abs(local.y)) / slope);
  }
  const float size = std::max(box.diagonal(), 1e-6f * length(camera.target));
  camera.eye = camera.target + std::max(distance, size > 0 ? size : 1.0f) * fromTarget;
  return camera;
}

}  // namespace prt
