#pragma once
// Which pixels of a picture show the inside of a surface: where two renderers with different samples per
// pixel must agree.

#include "libprt/shade/raster.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace prt::test {

/// [height * width]: true where the pixel and its eight neighbours see surfaces of one object, nearly equally
/// far away, or all of them see nothing. `triangleObject` is the object of each triangle.
inline std::vector<bool> offEdges(const TriMesh& mesh, std::span<const std::uint32_t> triangleObject,
                                  const Camera& camera, int width, int height) {
  const std::size_t size = std::size_t(width) * std::size_t(height);
  std::vector<float> depth(size, 0.0f);
  std::vector<std::uint32_t> object(size, kNoTriangle);
  Job job;
  const FragmentImage view = rasterize(mesh, camera, width, height, 1, job);
  for (const FragmentTile& tile : view.tiles)
    for (int i = 0; i < tile.width * tile.height; ++i)
      for (const Fragment& f : tile.pixel(std::size_t(i))) {
        const UVec3& t = mesh.triangles[f.triangle];
        const Vec2& b = f.barycentric;
        const Vec3 p =
            (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
        const auto pixel = std::size_t((tile.y + i / tile.width) * width + tile.x + i % tile.width);
        depth[pixel] = length(p - camera.eye);
        object[pixel] = triangleObject[f.triangle];
      }
  std::vector<bool> off(size, false);
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const auto here = std::size_t(y * width + x);
      bool smooth = true;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const auto near = std::size_t((y + j) * width + x + i);
          smooth = smooth && object[near] == object[here] &&
                   std::abs(depth[near] - depth[here]) <= 0.03f * depth[here];
        }
      off[here] = smooth;
    }
  return off;
}

/// The same where there is one object.
inline std::vector<bool> offEdges(const TriMesh& mesh, const Camera& camera, int width, int height) {
  return offEdges(mesh, std::vector<std::uint32_t>(mesh.triangleCount(), 0), camera, width, height);
}

}  // namespace prt::test
