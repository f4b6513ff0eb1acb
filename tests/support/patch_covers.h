#pragma once
// Id maps over real atlases, for tests of how patches are filtered.

#include "libprt/atlas/geometry_image.h"
#include "libprt/shade/patch_cover.h"
#include "tests/support/atlases.h"
#include "tests/support/patched_world.h"

#include <cmath>
#include <functional>
#include <memory>

namespace prt::test {

inline constexpr int kContrastedTexels = 16;

/// Bright and dark places close together, no two alike, different from every side.
inline Rtt contrastedRtt(int views = 3) {
  Rtt rtt = variedRtt(kContrastedTexels, views, 1);
  for (int v = 0; v < kContrastedTexels; ++v)
    for (int u = 0; u < kContrastedTexels; ++u)
      for (int view = 0; view < rtt.viewCount(); ++view)
        for (std::size_t k = 0; k < rtt.blockSize(); ++k)
          rtt.block(u, v, view)[k] *= (u + v) % 4 < 2 ? 1.0f : 0.1f;
  return rtt;
}

/// An id map over a real atlas, its ids told by place.
inline std::shared_ptr<const PatchCover> coverBy(const Scene& scene, int size,
                                                 const std::function<Vec2(const Vec3&, std::uint32_t)>& id) {
  Job job;
  const auto atlas = std::make_shared<Atlas>(automaticAtlas(scene.mesh));
  const GeometryImage image = makeGeometryImage(*atlas, size, -1, job);
  const TexelSurface texels = texelSurface(scene.mesh, *atlas, image, job);
  auto map = std::make_shared<IdMap>();
  map->size = size;
  for (std::size_t i = 0; i < image.triangle.size(); ++i) {
    const bool empty = image.triangle[i] == kNowhere;
    const Vec2 uv = empty ? Vec2(0) : id(texels.position[i], atlas->chartOf[image.triangle[i]]);
    for (int c = 0; c < 2; ++c)
      map->ids.push_back(empty ? IdMap::kEmpty : std::uint16_t(65535 * (uv[c] - std::floor(uv[c]))));
  }
  return std::make_shared<PatchCover>(atlas, map, scene.mesh.triangleCount());
}

inline Vec2 byPlace(const Vec3& p, std::uint32_t) {
  return 4.0f * Vec2(p.x + 0.31f * p.y, p.z - 0.57f * p.y);
}

}  // namespace prt::test
