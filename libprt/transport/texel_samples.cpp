// Samples at the texels of an atlas: the half of sample_set.h that knows no vertices.

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"

#include <algorithm>

namespace prt {
namespace {

constexpr float kInside = 1e-3f;  // least weight of a corner

/// As far from the sides of the triangle as kInside says. Its origin there: on a side, a neighbour that folds
/// towards it would be met from behind, or in the very place where the ray begins.
Vec2 pulledInside(const Vec2& b) {
  const Vec3 w = max(Vec3(1 - b.x - b.y, b.x, b.y), Vec3(kInside));
  return Vec2(w.y, w.z) / (w.x + w.y + w.z);
}

void setTexel(SampleSet& set, std::size_t sample, const TriMesh& mesh, std::uint32_t t, const Vec2& place,
              float side) {
  const Vec2 b = pulledInside(place);
  const UVec3& corner = mesh.triangles[t];
  const DVec3 area(mesh.areaNormal(t));
  const Vec3 smooth =
      (1 - b.x - b.y) * mesh.normals[corner.x] + b.x * mesh.normals[corner.y] + b.y * mesh.normals[corner.z];
  const float size = length(smooth);
  const Vec3 shading = side * (size > 1e-6f ? smooth / size : mesh.normals[corner.x]);
  const Vec3 face = length(area) > 0 ? side * Vec3(normalize(area)) : shading;
  set.shadingNormal[sample] = size > 1e-6f ? shading : face;
  set.geometricNormal[sample] = face;
  set.origin[sample] =
      offsetOrigin(mesh.positions[corner.x], mesh.positions[corner.y], mesh.positions[corner.z], b, face);
  set.triangle[sample] = t;
  set.barycentric[sample] = b;
}

}  // namespace

SampleSet samplesAtTexels(const Scene& scene, const ChartTexels& texels, Job& job) {
  if (texels.grid->triangles.size() != scene.mesh.triangleCount())
    throw ValueError("the atlas is of another mesh", "samples", "lay the charts flat again");
  SampleSet set;
  set.texels = texels.grid;
  const std::size_t fronts = texels.triangle.size();
  std::vector<std::uint32_t> behind;  // texels that have a sample on their back
  if (std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const Material& m) { return m.twoSided; })) {
    set.back.assign(fronts, kNone);
    for (std::uint32_t i = 0; i < fronts; ++i) {
      if (!scene.materialOf(texels.triangle[i]).twoSided) continue;
      set.back[i] = std::uint32_t(fronts + behind.size());
      behind.push_back(i);
    }
  }
  const std::size_t count = fronts + behind.size();
  set.origin.resize(count);
  set.geometricNormal.resize(count);
  set.shadingNormal.resize(count);
  set.triangle.resize(count);
  set.barycentric.resize(count);
  parallelFor(job, 0, count, 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const std::size_t i = s < fronts ? s : behind[s - fronts];
      setTexel(set, s, scene.mesh, texels.triangle[i], texels.barycentric[i], s < fronts ? 1.0f : -1.0f);
    }
  });
  return set;
}

}  // namespace prt
