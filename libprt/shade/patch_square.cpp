#include "libprt/shade/patch_square.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/parallel.h"

#include <algorithm>

namespace prt {

Vec3 toGround(const Vec3& world) {
  return {world.x, -world.z, world.y};
}

Vec3 fromGround(const Vec3& patch) {
  return {patch.x, patch.z, -patch.y};
}

ShRgb lightOnGround(const ShRgb& world) {
  // Columns are where the world's axes go.
  const Mat3 turn(toGround({1, 0, 0}), toGround({0, 1, 0}), toGround({0, 0, 1}));
  return ShRotation(world.bands, turn).apply(world);
}

Image renderPatchSquare(const Rtt& rtt, const ShRgb& worldLight, const Camera& camera,
                        const SquareOptions& options, Job& job) {
  const ShRgb light = lightOnGround(worldLight);
  const CameraRays rays(camera, options.width, options.height);
  Image image(options.width, options.height, 4);
  const int n = options.grid;
  parallelFor(job, 0, std::size_t(options.height), 4, [&](std::size_t begin, std::size_t end) {
    for (int y = int(begin); y < int(end); ++y)
      for (int x = 0; x < options.width; ++x) {
        Vec4 sum(0);
        for (int s = 0; s < n * n; ++s) {
          const float px = float(x) + (float(s % n) + 0.5f) / float(n),
                      py = float(y) + (float(s / n) + 0.5f) / float(n);
          const Vec3 origin = rays.origin(px, py), d = rays.direction(px, py);
          if (d.y >= 0 || origin.y <= 0) continue;
          const Vec3 p = origin - d * (origin.y / d.y);
          if (std::abs(p.x) > 0.5f || std::abs(p.z) > 0.5f) continue;
          const auto [u, v] = rtt.texelAt(Vec2(p.x + 0.5f, 0.5f - p.z) * float(options.repeats));
          sum += Vec4(max(Rgb(0), rtt.exitRadiance(u, v, toGround(-d), light)), 1);
        }
        sum /= float(n * n);
        std::copy_n(&sum.x, 4, image.pixel(x, y));
      }
  });
  return image;
}

}  // namespace prt
