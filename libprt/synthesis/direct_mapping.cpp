#include "libprt/synthesis/direct_mapping.h"

#include "libprt/core/error.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>
#include <cmath>

namespace prt {

PatchRepeat squareRepeat(const TriMesh& mesh, int along) {
  if (mesh.uv.empty())
    throw ValueError("the mesh has no texture coordinates to lay patches by", "synthesis.mapping",
                     "use synthesis.mapping=synthesis");
  if (along < 1 || along > 4096)
    throw ValueError(std::to_string(along) + " patches are out of range", "synthesis.repeat",
                     "use 1 to 4096");
  // Mean squared lengths of one unit of u and of v on the surface, by area.
  double u = 0, v = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const UVec3 &p = mesh.triangles[t], &w = mesh.uvTriangles[t];
    const glm::dvec2 d1 = glm::dvec2(mesh.uv[w.y]) - glm::dvec2(mesh.uv[w.x]),
                     d2 = glm::dvec2(mesh.uv[w.z]) - glm::dvec2(mesh.uv[w.x]);
    const double det = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(det) > 1e-14)) continue;
    const DVec3 e1 = DVec3(mesh.positions[p.y]) - DVec3(mesh.positions[p.x]),
                e2 = DVec3(mesh.positions[p.z]) - DVec3(mesh.positions[p.x]);
    const DVec3 alongU = (d2.y * e1 - d1.y * e2) / det, alongV = (d1.x * e2 - d2.x * e1) / det;
    const double area = 0.5 * length(cross(e1, e2));
    u += area * dot(alongU, alongU), v += area * dot(alongV, alongV);
  }
  if (!(u > 0) || !(v > 0)) return {along, along};
  return {along, std::clamp(int(std::lround(along * std::sqrt(v / u))), 1, 4096)};
}

Vec2 directPatchCoordinates(const TriMesh& mesh, const PatchRepeat& repeat, std::uint32_t triangle,
                            const Vec2& barycentric) {
  const UVec3& w = mesh.uvTriangles[triangle];
  const Vec2 uv = interpolated(mesh.uv[w.x], mesh.uv[w.y], mesh.uv[w.z], barycentric) *
                  Vec2(float(repeat.u), float(repeat.v));
  const Vec2 within = uv - floor(uv);
  return {within.x < 1 ? within.x : 0.0f, within.y < 1 ? within.y : 0.0f};
}

}  // namespace prt
