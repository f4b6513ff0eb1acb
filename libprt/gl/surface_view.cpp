#include "libprt/gl/surface_view.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace prt::gl {

Vec2 depthRange(const Camera& camera, const Box3& box) {
  const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
  const float middle = dot(camera.eye - box.center(), camera.axes().normal);
  if (camera.orthographic) return {middle - 1.01f * radius, middle + 1.01f * radius};
  return {std::max(middle - 1.01f * radius, 1e-3f * radius),
          std::max(middle + 1.01f * radius, 2e-3f * radius)};
}

SurfaceView surfaceView(const Camera& camera, const Box3& bounds, int width, int height, const Vec2& shift) {
  const Vec2 depth = depthRange(camera, bounds);
  // Moves the picture so that pixel centres fall on the places that are wanted.
  Mat4 move(1);
  move[3] = Vec4(-2.0f * shift / Vec2(width, height), 0, 1);
  return {move * camera.projection(float(width) / float(height), depth.x, depth.y) * camera.view(),
          PixelSteps(camera, width, height)};
}

int supportedSamples(int wanted) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return std::clamp(wanted, 1, std::max(1, int(most)));
}

}  // namespace prt::gl
