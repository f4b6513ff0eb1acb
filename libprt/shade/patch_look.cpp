#include "libprt/shade/patch_look.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/raster.h"
#include "libprt/synthesis/orientation_field.h"

#include <algorithm>

namespace prt {
namespace {

/// A point of the surface as shading needs it.
struct Spot {
  Vec3 position;
  Frame frame;
  Vec2 patch;  // negative: none
};

Spot spotAt(const PatchLook& look, const Fragment& f) {
  const UVec3 &t = look.mesh.triangles[f.triangle], &w = look.atlas.uvTriangles[f.triangle];
  const Vec2& b = f.barycentric;
  Spot spot;
  spot.position =
      interpolated(look.mesh.positions[t.x], look.mesh.positions[t.y], look.mesh.positions[t.z], b);
  const Vec3 n = interpolated(look.mesh.normals[t.x], look.mesh.normals[t.y], look.mesh.normals[t.z], b);
  spot.frame.normal = dot(n, n) > 1e-12f ? normalize(n) : look.mesh.normals[t.x];
  spot.frame.tangent = tangentAt(look.frames, f.triangle, b, spot.frame.normal);
  spot.frame.bitangent = cross(spot.frame.normal, spot.frame.tangent);
  const Vec2 uv = interpolated(look.atlas.uv[w.x], look.atlas.uv[w.y], look.atlas.uv[w.z], b);
  const int n1 = look.map.size - 1;
  const int x = std::clamp(int(uv.x * float(look.map.size)), 0, n1),
            y = std::clamp(int((1 - uv.y) * float(look.map.size)), 0, n1);
  spot.patch = look.map.at(std::size_t(y) * std::size_t(look.map.size) + std::size_t(x));
  return spot;
}

/// Radiance that leaves a spot towards the viewer.
Rgb radiance(const PatchLook& look, const Spot& spot, const Fragment& f, const Vec3& viewer) {
  const Vec3 view = spot.frame.toLocal(viewer);
  if (!(view.z > 0)) return Rgb(0);
  ShRgb light = look.light;
  if (!look.incident.empty()) {
    light = ShRgb(look.rtt->bands);
    const UVec3& t = look.mesh.triangles[f.triangle];
    const std::size_t k = light.c.size();
    for (std::size_t i = 0; i < k; ++i)
      light.c[i] = interpolated(look.incident[t.x * k + i], look.incident[t.y * k + i],
                                look.incident[t.z * k + i], f.barycentric);
  }
  const ShRotation toLocal(look.rtt->bands, transpose(spot.frame.matrix()));
  const auto [u, v] = look.rtt->texelAt(spot.patch);
  return max(Rgb(0), look.rtt->exitRadiance(u, v, view, toLocal.apply(light)));
}

Rgb idColour(const Spot& spot, const Vec3& viewer) {
  const float facing = std::max(0.0f, dot(spot.frame.normal, viewer));
  return Rgb(spot.patch.x, spot.patch.y, 0.04f) * (0.25f + 0.75f * facing);
}

}  // namespace

Image patchLook(const PatchLook& look, const Camera& camera, int width, int height, int grid, Job& job) {
  const std::size_t count = look.rtt ? look.mesh.vertexCount() * std::size_t(look.rtt->functions()) : 0;
  if (!look.incident.empty() && look.incident.size() != count)
    throw ValueError("light at the vertices has another size than the texture asks for", "patch look",
                     "transfer it with rtt.bands bands");
  const FragmentImage seen = rasterize(look.mesh, camera, width, height, grid, job);
  Image image(width, height, 4);
  job.begin("picture of the patch", 0);
  parallelFor(job, 0, seen.tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FragmentTile& tile = seen.tiles[i];
      for (int p = 0; p < tile.width * tile.height; ++p) {
        float* out = image.pixel(tile.x + p % tile.width, tile.y + p / tile.width);
        for (const Fragment& f : tile.pixel(std::size_t(p))) {
          const float part = float(f.samples) / float(grid * grid);
          out[3] += part;
          const Spot spot = spotAt(look, f);
          if (f.back || spot.patch.x < 0) continue;
          const Vec3 viewer = camera.towardsViewer(spot.position);
          const Rgb c = look.rtt ? radiance(look, spot, f, viewer) : idColour(spot, viewer);
          for (int k = 0; k < 3; ++k) out[k] += part * c[k];
        }
      }
    }
  });
  return image;
}

}  // namespace prt
