#include "ui/model/view_state.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr float kTurnPerHeight = kPiF;  // half a turn for a drag over the whole view
constexpr float kSteepest = 1.55334f;   // 89 degrees: short of the poles
constexpr float kZoomPerStep = 0.85f;   // distance left after one notch of the wheel
constexpr float kFrameMargin = 1.1f;

Vec3 rotated(const Vec3& v, const Vec3& axis, float angle) {
  return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * dot(axis, v) * (1 - std::cos(angle));
}

}  // namespace

void ViewState::setCamera(const Camera& camera) {
  if (camera == camera_) return;
  camera_ = camera;
  Q_EMIT changed();
}

void ViewState::setTone(const ToneSettings& tone) {
  if (tone.exposure == tone_.exposure && tone.curve == tone_.curve) return;
  tone_ = tone;
  Q_EMIT changed();
}

void ViewState::setOrthographic(bool orthographic) {
  Camera camera = camera_;
  camera.orthographic = orthographic;
  setCamera(camera);
}

void ViewState::lookFrom(const Vec3& direction) {
  Camera camera = camera_;
  camera.eye = camera.target + length(camera.eye - camera.target) * normalize(direction);
  camera.up = Vec3(0, 1, 0);
  setCamera(camera);
}

void ViewState::frame(const Box3& box) {
  if (box.empty()) return;
  Camera camera = camera_;
  const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
  const Vec3 backwards = camera.axes().normal;
  camera.target = box.center();
  camera.eye = camera.target + backwards * (kFrameMargin * radius / std::sin(0.5f * camera.verticalFov));
  setCamera(camera);
}

void ViewState::orbit(float dx, float dy) {
  Camera camera = camera_;
  const Vec3 up(0, 1, 0);
  Vec3 arm = camera.eye - camera.target;
  arm = rotated(arm, up, -dx * kTurnPerHeight);
  const float elevation = std::asin(std::clamp(arm.y / length(arm), -1.0f, 1.0f));
  const float wanted = std::clamp(elevation + dy * kTurnPerHeight, -kSteepest, kSteepest);
  const Vec3 level = cross(up, arm);
  const Vec3 axis = length(level) > 1e-6f * length(arm) ? normalize(level) : camera.axes().tangent;
  arm = rotated(arm, axis, -(wanted - elevation));
  camera.eye = camera.target + arm;
  camera.up = up;
  setCamera(camera);
}

void ViewState::pan(float dx, float dy) {
  Camera camera = camera_;
  const float height = camera.viewHeight();
  const Frame axes = camera.axes();
  const Vec3 shift = (-dx * axes.tangent + dy * axes.bitangent) * height;
  camera.eye += shift;
  camera.target += shift;
  setCamera(camera);
}

void ViewState::zoom(float steps, float x, float y) {
  Camera camera = camera_;
  const float factor = std::pow(kZoomPerStep, steps);
  const Vec3 arm = camera.eye - camera.target;
  const Frame axes = camera.axes();
  const float height = camera.viewHeight();
  const Vec3 under = camera.target + (x * axes.tangent + y * axes.bitangent) * height;
  camera.target = under + (camera.target - under) * factor;
  camera.eye = camera.target + arm * factor;
  setCamera(camera);
}

}  // namespace prt::ui
