#include "libprt/shade/pick.h"

#include "libprt/core/parallel.h"

#include <limits>
#include <vector>

namespace prt {
namespace {

constexpr std::size_t kGrain = 16384;

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();  // along the optical axis
  std::size_t triangle = 0;
  double b1 = 0, b2 = 0;
  bool back = false;
};

/// Moeller and Trumbore 1997, in double: a pick at an edge belongs to one of its triangles.
void meet(const TriMesh& mesh, std::size_t triangle, const DVec3& origin, const DVec3& along, double from,
          Nearest& best) {
  const UVec3& t = mesh.triangles[triangle];
  const DVec3 p0(mesh.positions[t.x]), e1 = DVec3(mesh.positions[t.y]) - p0,
                                       e2 = DVec3(mesh.positions[t.z]) - p0;
  const DVec3 p = cross(along, e2), s = origin - p0;
  const double det = dot(e1, p);
  if (det == 0) return;
  const double b1 = dot(s, p) / det;
  if (!(b1 >= 0 && b1 <= 1)) return;
  const DVec3 q = cross(s, e1);
  const double b2 = dot(along, q) / det;
  if (!(b2 >= 0 && b1 + b2 <= 1)) return;
  const double distance = dot(e2, q) / det;
  if (distance > from && distance < best.distance) best = {distance, triangle, b1, b2, det < 0};
}

}  // namespace

std::optional<SurfaceHit> pickSurface(const Scene& scene, const Camera& camera, float x, float y, int width,
                                      int height) {
  const TriMesh& mesh = scene.mesh;
  const CameraRays rays(camera, width, height);
  const DVec3 origin(rays.origin(x, y)), along(rays.through(x, y));
  const double from = camera.orthographic ? -std::numeric_limits<double>::infinity() : 0;

  std::vector<Nearest> found((mesh.triangleCount() + kGrain - 1) / kGrain);
  Job job;
  parallelFor(job, 0, mesh.triangleCount(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) meet(mesh, i, origin, along, from, found[begin / kGrain]);
  });
  Nearest best;
  for (const Nearest& each : found)
    if (each.distance < best.distance) best = each;
  if (!(best.distance < std::numeric_limits<double>::infinity())) return std::nullopt;

  SurfaceHit hit;
  hit.triangle = std::uint32_t(best.triangle);
  hit.object = scene.triangleObject[best.triangle];
  hit.barycentric = Vec2(float(best.b1), float(best.b2));
  hit.position = Vec3(origin + best.distance * along);
  hit.back = best.back;
  return hit;
}

}  // namespace prt
