#include "libprt/shade/patch_look.h"

#include "libprt/core/parallel.h"
#include "libprt/shade/raster.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>

namespace prt {
namespace {

Rgb colourOf(const TriMesh& mesh, const Fragment& f, const Vec2& patch, const Camera& camera) {
  const UVec3& t = mesh.triangles[f.triangle];
  const auto at = [&](const std::vector<Vec3>& values) {
    return interpolated(values[t.x], values[t.y], values[t.z], f.barycentric);
  };
  const Vec3 smooth = at(mesh.normals);
  const Vec3 normal = dot(smooth, smooth) > 1e-12f ? normalize(smooth) : mesh.normals[t.x];
  const float facing = std::max(0.0f, dot(normal, camera.towardsViewer(at(mesh.positions))));
  return Rgb(patch.x, patch.y, 0.04f) * (0.25f + 0.75f * facing);
}

}  // namespace

Image patchColours(const TriMesh& mesh, const PatchCover& cover, const Camera& camera, int width, int height,
                   int grid, Job& job) {
  const FragmentImage seen = rasterize(mesh, camera, width, height, grid, job);
  Image image(width, height, 4);
  job.begin("picture of the patch", 0);
  parallelFor(job, 0, seen.tiles.size(), 1, [&](std::size_t i, std::size_t) {
    const FragmentTile& tile = seen.tiles[i];
    for (int p = 0; p < tile.width * tile.height; ++p) {
      float* out = image.pixel(tile.x + p % tile.width, tile.y + p / tile.width);
      for (const Fragment& f : tile.pixel(std::size_t(p))) {
        const float part = float(f.samples) / float(grid * grid);
        out[3] += part;
        const Vec2 patch = cover.at(f.triangle, f.barycentric);
        if (f.back || patch.x < 0) continue;
        const Rgb c = part * colourOf(mesh, f, patch, camera);
        for (int k = 0; k < 3; ++k) out[k] += c[k];
      }
    }
  });
  return image;
}

}  // namespace prt
