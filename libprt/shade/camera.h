#pragma once
// The pinhole camera of renderers and viewport. Pixel centres at half integers, (0,0) at the top left.

#include "libprt/core/math.h"

namespace prt {

struct Camera {
  Vec3 eye{0, 0, 3};
  Vec3 target{0};
  Vec3 up{0, 1, 0};
  float verticalFov = 0.5235988f;  ///< radians, full angle

  /// Unit direction from the eye through image position (x, y) in pixels of a width x height image.
  Vec3 direction(float x, float y, int width, int height) const;
  /// World to camera space (looking down -z).
  Mat4 view() const;
  /// OpenGL clip space, depth -1..1.
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

  /// Direction through image position (x, y) in pixels, with length 1 along the optical axis.
  Vec3 through(float x, float y) const { return corner_ + x * right_ + y * down_; }
  /// The same, unit length.
  Vec3 direction(float x, float y) const { return normalize(through(x, y)); }

 private:
  Vec3 corner_, right_, down_;  // to the top left corner; one pixel right; one pixel down
};

/// A three-quarter view that frames a box with a small margin at any aspect ratio >= 1.
Camera frameBox(const Box3& box, float verticalFov = 0.5235988f);

}  // namespace prt
