#include "libprt/meso/patch_lobe.h"

#include "libprt/basis/sh.h"
#include "libprt/core/sampling.h"
#include "libprt/material/bsdf.h"

#include <algorithm>

namespace prt {
namespace {

/// The lobe alone, as a material.
Material lobeOf(const Patch& patch, const Hit& hit) {
  Material material;
  material.model = MaterialModel::Phong;
  material.albedo = Rgb(0);
  material.specular = patch.specular;
  if (patch.glossTexture)
    material.specular *= lookUp(patch.glossTexture, Vec2(patch.positionAt(hit.triangle, hit.barycentric)));
  material.exponent = patch.exponent;
  return material;
}

/// Draws directions in proportion to f cos into rays and weights (f cos / density / number).
void drawLobe(const Patch& patch, const Hit& hit, const Vec3& view, int rays, std::uint64_t seed,
              LobeScratch& s) {
  s.rays.clear(), s.weights.clear();
  const Material material = lobeOf(patch, hit);
  const Frame frame = frameFromNormal(normalAt(patch, hit));
  const Vec3 face = normalize(patch.mesh.areaNormal(hit.triangle)), out = frame.toLocal(view);
  if (out.z <= 0) return;
  const Vec3 origin = originAt(patch, hit);
  for (int i = 0; i < rays; ++i) {
    const BrdfSample sample = sampleBrdf(material, out, sobol2(std::uint32_t(i), 0, seed), 0.5f);
    const Vec3 in = frame.toWorld(sample.in);
    if (sample.pdf <= 0 || dot(in, face) <= 0) continue;
    s.rays.push_back({origin, 0, in});
    s.weights.push_back(sample.weight / float(rays));
  }
  s.hits.resize(s.rays.size());
}

void addRow(const PatchScene& patch, const PatchLight& light, const Hit& hit, const Rgb& weight, int channels,
            LobeScratch& s, float* sum) {
  s.row.resize(light.rows.width);
  light.at(patch.patch->mesh, hit.triangle, hit.barycentric, s.row.data());
  const Rgb factor = weight * patch.patch->albedoAt(hit.triangle, hit.barycentric) / kPiF;
  for (std::size_t k = 0; k < light.lights; ++k)
    for (int c = 0; c < channels; ++c)
      sum[k * std::size_t(channels) + std::size_t(c)] +=
          factor[c] * s.row[light.channels == 3 ? 3 * k + std::size_t(c) : k];
}

}  // namespace

Vec3 normalAt(const Patch& patch, const Hit& hit) {
  const UVec3& t = patch.mesh.triangles[hit.triangle];
  const Vec2& b = hit.barycentric;
  const Vec3 n = (1 - b.x - b.y) * patch.mesh.normals[t.x] + b.x * patch.mesh.normals[t.y] +
                 b.y * patch.mesh.normals[t.z];
  return length(n) > 1e-6f ? normalize(n) : normalize(patch.mesh.areaNormal(hit.triangle));
}

Vec3 originAt(const Patch& patch, const Hit& hit) {
  const UVec3& t = patch.mesh.triangles[hit.triangle];
  const Vec3 face = normalize(patch.mesh.areaNormal(hit.triangle));
  return offsetOrigin(patch.mesh.positions[t.x], patch.mesh.positions[t.y], patch.mesh.positions[t.z],
                      hit.barycentric, face);
}

Rgb evalLobe(const Patch& patch, const Hit& hit, const Vec3& in, const Vec3& view) {
  const Frame frame = frameFromNormal(normalAt(patch, hit));
  return evalBrdf(lobeOf(patch, hit), frame.toLocal(in), frame.toLocal(view));
}

void addLobe(const PatchScene& patch, const PatchLight& light, int bands, const Hit& hit, const Vec3& view,
             int rays, std::uint64_t seed, int channels, LobeScratch& s, float* sum) {
  drawLobe(*patch.patch, hit, view, rays, seed, s);
  patch.rays->intersectRays(s.rays, s.hits);
  s.functions.resize(std::size_t(shCount(bands)));
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    if (s.hits[i].valid()) {
      if (!s.hits[i].back) addRow(patch, light, s.hits[i], s.weights[i], channels, s, sum);
      continue;
    }
    shEvaluate(bands, s.rays[i].direction, s.functions);
    for (std::size_t k = 0; k < s.functions.size(); ++k)
      for (int c = 0; c < channels; ++c)
        sum[k * std::size_t(channels) + std::size_t(c)] += s.weights[i][c] * s.functions[k];
  }
}

void addLobeOfPatch(const PatchScene& patch, const PatchLight& light, const Hit& hit, const Vec3& view,
                    int rays, std::uint64_t seed, int channels, LobeScratch& s, float* sum) {
  drawLobe(*patch.patch, hit, view, rays, seed, s);
  patch.rays->intersectRays(s.rays, s.hits);
  for (std::size_t i = 0; i < s.rays.size(); ++i)
    if (s.hits[i].valid() && !s.hits[i].back) addRow(patch, light, s.hits[i], s.weights[i], channels, s, sum);
}

}  // namespace prt
