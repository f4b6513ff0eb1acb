#pragma once
// The camera of renderers and viewport: a pinhole, or parallel rays. Pixel centres at half integers, (0,0) at
// the top left.

#include "libprt/core/math.h"

#include <optional>

namespace prt {

struct Camera {
  Vec3 eye{0, 0, 3};
  Vec3 target{0};
  Vec3 up{0, 1, 0};
  float verticalFov = 0.5235988f;  ///< radians, full angle
  /// Parallel rays. The picture is as high as the pinhole's would be at the target, so that moving the eye
  /// nearer still zooms. Nothing is cut off: what lies behind the eye is seen too.
  bool orthographic = false;

  /// How much of the world is seen from bottom to top, at the target.
  float viewHeight() const;
  /// Unit direction of the ray through image position (x, y) in pixels of a width x height image.
  Vec3 direction(float x, float y, int width, int height) const;
  /// Where a point appears, in pixels of a width x height image; nothing when it is behind a pinhole.
  std::optional<Vec2> project(const Vec3& point, int width, int height) const;
  /// Unit direction from a point of a surface towards whoever looks.
  Vec3 towardsViewer(const Vec3& position) const;
  /// World to camera space (looking down -z).
  Mat4 view() const;
  /// OpenGL clip space, depth -1..1. Distances along the optical axis; parallel rays allow negative ones.
  Mat4 projection(float aspect, float nearPlane, float farPlane) const;
  /// Axes in world space: tangent = right, bitangent = up, normal = backwards (away from the target).
  /// Orthonormal whatever the fields hold: an eye on its target looks down -z, and an `up` along the
  /// view gives way to another axis.
  Frame axes() const;
  bool operator==(const Camera&) const = default;
};

/// The camera with its axes worked out once, for loops over pixels.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  /// Where the ray through image position (x, y) in pixels begins: the eye, or a point of the plane through
  /// it.
  Vec3 origin(float x, float y) const { return eye_ + spread_ * (corner_ + axis_ + x * right_ + y * down_); }
  /// Direction of that ray, with length 1 along the optical axis.
  Vec3 through(float x, float y) const { return orthographic_ ? -axis_ : background(x, y); }
  /// The same, unit length.
  Vec3 direction(float x, float y) const { return normalize(through(x, y)); }
  /// Towards the environment that is seen behind the scene, any length: always the pinhole's, because
  /// parallel rays would see one point of something that is infinitely far away.
  Vec3 background(float x, float y) const { return corner_ + x * right_ + y * down_; }

 private:
  Vec3 eye_, axis_;             // backwards
  Vec3 corner_, right_, down_;  // to the top left corner; one pixel right; one pixel down
  float spread_ = 0;  // distance between the origins of rays, in units of the image plane at distance 1
  bool orthographic_ = false;
};

/// A three-quarter view that frames a box with a small margin at any aspect ratio >= 1.
Camera frameBox(const Box3& box, float verticalFov = 0.5235988f);

}  // namespace prt
