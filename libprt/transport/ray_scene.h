#pragma once
// The one gateway for rays. Every ray of libprt goes through here: non-finite input is refused and
// counted (Embree aborts on it), packets are formed, and hits come back in our own terms.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace prt {

struct Ray {
  Vec3 origin;
  float tNear = 0;
  Vec3 direction;  ///< unit
  float tFar = std::numeric_limits<float>::infinity();
};

inline constexpr std::uint32_t kNoHit = 0xffffffffu;

struct Hit {
  std::uint32_t triangle = kNoHit;
  float t = 0;
  Vec2 barycentric{0};  ///< weights of corners 1 and 2; corner 0 has 1 - x - y
  bool back = false;    ///< met from behind
  bool valid() const { return triangle != kNoHit; }
};

/// A surface point moved off the surface, along geometric normal `n`, just enough that rays leaving on
/// that side do not meet the surface they left: by up to 256 units in the last place of each coordinate,
/// and at least 1.5e-5 of the scene's size (Waechter and Binder 2019, "A Fast and Robust Method for
/// Avoiding Self-Intersection"). `sceneSize` is the length that counts as 1: give RayScene::size(), or
/// small scenes are left too far behind and large ones are not left.
Vec3 offsetOrigin(const Vec3& p, const Vec3& n, float sceneSize = 1);

/// The same for a point at `barycentric` of a triangle with corners a, b, c, by the least that float rounding
/// allows there: 16 roundings of the sum that made the point, along the normal (Pharr, Jakob and Humphreys,
/// "Physically Based Rendering", section 6.8). A path that has entered a narrow crease stays in it.
Vec3 offsetOrigin(const Vec3& a, const Vec3& b, const Vec3& c, const Vec2& barycentric, const Vec3& n);

/// A surface that repeats itself for ever along x and y, as a patch of meso-structure does: the scene is one
/// period of it and may stick out over its neighbours by up to half a period in all.
struct Periodic {
  float width = 1;
};

/// An Embree scene built for robustness over speed. Thread-safe once built. A ray is refused when a
/// coordinate is not finite or beyond 1e18, its direction is zero, its tNear is negative or NaN, or
/// its tFar is NaN; it counts as "hit nothing". The one-origin calls agree with each other to the bit
/// (blocked exactly where there is a hit) on one machine, whatever the other rays of the call are.
class RayScene {
 public:
  /// Keeps no reference to `scene`. Equal scenes give equal answers on one machine, also where a ray meets an
  /// edge or corner and must choose between triangles at equal distance. Throws GeometryError when a position
  /// is not finite or beyond 1e18, ResourceError when the build fails.
  explicit RayScene(const Scene& scene);
  /// The same, and Cancelled when the job is cancelled meanwhile.
  RayScene(const Scene& scene, Job& job);
  /// The scene repeated without end: hits name the triangle of the one scene, whichever copy they lie on.
  /// Rays go from copy to copy until they meet something, leave the layer upwards or downwards, or have gone
  /// 500 periods in the layer, which counts as leaving it. Throws ValueError also when the scene sticks out
  /// too far or the width is not positive.
  RayScene(const Scene& scene, const Periodic& periodic, Job& job);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  bool occluded(const Ray& ray) const;
  Hit intersect(const Ray& ray) const;

  /// Many rays from one origin: blocked[i] = 1 if direction i meets anything. Directions as separate
  /// coordinates, traced in packets of 16: sets sorted so that 16 neighbours share a solid-angle cell
  /// run about twice as fast as unsorted ones. Throws ValueError when the sizes differ.
  void occludedFrom(const Vec3& origin, std::span<const float> dx, std::span<const float> dy,
                    std::span<const float> dz, std::span<std::uint8_t> blocked) const;
  /// Many rays from one origin, with what they hit.
  void intersectFrom(const Vec3& origin, std::span<const float> dx, std::span<const float> dy,
                     std::span<const float> dz, std::span<Hit> hits) const;

  /// Any rays, in packets of 16: neighbours should lie close together. Throws ValueError when the sizes
  /// differ.
  void intersectRays(std::span<const Ray> rays, std::span<Hit> hits) const;

  /// Diagonal of the scene's bounding box.
  float size() const;

  /// Rays refused since the scene was built.
  std::uint64_t refusedRays() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prt
