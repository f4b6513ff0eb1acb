#pragma once
// Where two renderers can be held to the same value: pixels that do not lie on an edge of what is seen, where
// each takes its samples of a pixel at places of its own.

#include "libprt/core/job.h"
#include "libprt/shade/raster.h"

#include <cmath>
#include <vector>

namespace prt::test {

/// Distance along the view of what each pixel's centre sees; 0 where nothing is.
inline std::vector<float> depths(const TriMesh& mesh, const Camera& camera, int width, int height) {
  Job job;
  const FragmentImage view = rasterize(mesh, camera, width, height, 1, job);
  std::vector<float> depth(std::size_t(width) * std::size_t(height), 0.0f);
  for (const FragmentTile& tile : view.tiles)
    for (int i = 0; i < tile.width * tile.height; ++i)
      for (const Fragment& f : tile.pixel(std::size_t(i))) {
        const UVec3& t = mesh.triangles[f.triangle];
        const Vec2& b = f.barycentric;
        const Vec3 p =
            (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
        depth[std::size_t((tile.y + i / tile.width) * width + tile.x + i % tile.width)] =
            length(p - camera.eye);
      }
  return depth;
}

/// [width * height] whether a pixel's neighbours are as far away as it is.
inline std::vector<bool> offEdges(const TriMesh& mesh, const Camera& camera, int width, int height) {
  const std::vector<float> depth = depths(mesh, camera, width, height);
  std::vector<bool> off(depth.size(), false);
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const float here = depth[std::size_t(y * width + x)];
      bool smooth = true;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          smooth = smooth && std::abs(depth[std::size_t((y + j) * width + x + i)] - here) <= 0.03f * here;
      off[std::size_t(y * width + x)] = smooth;
    }
  return off;
}

}  // namespace prt::test
