#pragma once
// Vectors, colours, frames and boxes used by every layer. Right-handed, +Y up; angles are radians.

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace prt {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec3 = glm::dvec3;
using UVec3 = glm::uvec3;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

/// Linear Rec.709 colour or radiance.
using Rgb = glm::vec3;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr float kPiF = 3.14159265358979323846f;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / kPi);
}

/// Rec.709 luminance of a linear colour.
inline float luminance(const Rgb& c) {
  return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

inline bool isFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Orthonormal, right-handed local frame: x = tangent, y = bitangent, z = normal.
struct Frame {
  Vec3 tangent{1, 0, 0};
  Vec3 bitangent{0, 1, 0};
  Vec3 normal{0, 0, 1};

  Vec3 toLocal(const Vec3& v) const { return {dot(v, tangent), dot(v, bitangent), dot(v, normal)}; }
  Vec3 toWorld(const Vec3& v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
  /// Rotation whose columns are the axes: local to world.
  Mat3 matrix() const { return {tangent, bitangent, normal}; }
};

/// Some frame around a unit normal, free of branches on direction but for the sign of z
/// (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"). Not continuous at z = 0.
inline Frame frameFromNormal(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// Axis-aligned box; empty until extended.
struct Box3 {
  Vec3 low{std::numeric_limits<float>::max()};
  Vec3 high{std::numeric_limits<float>::lowest()};

  void extend(const Vec3& p) { low = min(low, p), high = max(high, p); }
  bool empty() const { return low.x > high.x; }
  Vec3 center() const { return 0.5f * (low + high); }
  float diagonal() const { return empty() ? 0.0f : length(high - low); }
};

}  // namespace prt
