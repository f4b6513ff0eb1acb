#include "libprt/shade/footprint.h"

#include "libprt/shade/ground_grid.h"

namespace prt {

PixelSteps::PixelSteps(const Camera& camera, int width, int height) : forward(-camera.axes().normal) {
  const GridRays rays(camera, width, height);
  right = camera.orthographic ? rays.originRight : rays.directionRight;
  down = camera.orthographic ? rays.originDown : rays.directionDown;
  viewer = camera.orthographic ? Vec4(-forward, 0) : Vec4(camera.eye, 1);
}

PlaneSteps planeSteps(const PixelSteps& steps, const Vec3& p, const Vec3& e1, const Vec3& e2) {
  const Vec3 normal = cross(e1, e2);
  const Vec3 ray = steps.viewer.w > 0 ? p - Vec3(steps.viewer) : steps.forward;
  const float distance = steps.viewer.w > 0 ? dot(ray, steps.forward) : 1.0f;
  // Where the plane is seen edge-on its steps have no end; a thousandth of the sine is far enough.
  const float across = dot(ray, normal), least = 1e-3f * length(ray) * length(normal);
  const float slope = across < 0 ? std::min(across, -least) : std::max(across, least);
  if (!(least > 0)) return {};
  const auto onPlane = [&](const Vec3& step) { return step - ray * (dot(step, normal) / slope); };
  return {onPlane(distance * steps.right), onPlane(distance * steps.down)};
}

Vec2 weightStep(const Vec3& step, const Vec3& e1, const Vec3& e2) {
  const float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), p1 = dot(step, e1), p2 = dot(step, e2);
  const float area = d11 * d22 - d12 * d12;
  return area > 0 ? Vec2(d22 * p1 - d12 * p2, d11 * p2 - d12 * p1) / area : Vec2(0);
}

Footprint footprintOf(const Vec2& right, const Vec2& down) {
  // The axes are those of J J', J = (right, down).
  const float a = right.x * right.x + down.x * down.x, b = right.x * right.y + down.x * down.y,
              c = right.y * right.y + down.y * down.y;
  const float mean = 0.5f * (a + c), half = 0.5f * (a - c), root = std::sqrt(half * half + b * b);
  const float longest = std::sqrt(mean + root), shortest = std::sqrt(std::max(0.0f, mean - root));
  Footprint f;
  if (!(longest > 0)) return f;
  f.taps = int(std::clamp(std::ceil(longest / std::max(shortest, 1e-3f * longest) - 0.5f), 1.0f,
                          float(Footprint::kMostTaps)));
  f.width = std::max(shortest, longest / float(f.taps));
  const Vec2 along = half > 0 ? Vec2(half + root, b) : Vec2(b, root - half);  // of the longer one
  const float size = length(along);
  if (f.taps > 1 && size > 0) f.step = along * (longest / (float(f.taps) * size));
  return f;
}

}  // namespace prt
