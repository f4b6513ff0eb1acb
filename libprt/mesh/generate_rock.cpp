#include "libprt/mesh/generate.h"
#include "libprt/mesh/generate_check.h"
#include "libprt/mesh/noise.h"
#include "libprt/mesh/normals.h"

#include <algorithm>

namespace prt {
namespace {

/// Cuts a unit direction's radius by a plane at `depth` along `face`, with a rounded edge.
float cutRadius(float radius, const Vec3& direction, const Vec3& face, float depth) {
  const float along = dot(direction, face);
  if (along <= 0.05f) return radius;
  const float plane = depth / along, softness = 0.06f;
  const float h = std::max(softness - std::abs(radius - plane), 0.0f);
  return std::min(radius, plane) - h * h / (4 * softness);
}

/// Where the rock's surface lies in a direction, for radius 1.
Vec3 rockPoint(const Vec3& direction, const RockOptions& o) {
  // Bend space first, so that crests wind instead of following the lattice.
  const Vec3 q = 1.3f * direction + Vec3(17.1f, 3.7f, 9.2f);
  const Vec3 bend(fractalNoise(q, 3, o.seed + 101), fractalNoise(q, 3, o.seed + 211),
                  fractalNoise(q, 3, o.seed + 307));
  const Vec3 bent = q + 0.35f * bend;

  float radius = 1 + o.roughness * 0.9f * fractalNoise(0.8f * bent, 2, o.seed + 401);
  // Weathered faces: planes in hashed directions.
  for (std::uint32_t i = 0; i < 7; ++i) {
    const Vec3 face(gradientNoise(Vec3(0.37f + i, 0.41f, 0.29f), o.seed + 503),
                    gradientNoise(Vec3(0.37f + i, 0.41f, 0.29f), o.seed + 601),
                    gradientNoise(Vec3(0.37f + i, 0.41f, 0.29f), o.seed + 701));
    if (length(face) > 1e-3f) radius = cutRadius(radius, direction, normalize(face), 0.80f);
  }
  // Relief, and hollows where the low octaves of a second noise are deep.
  radius += 0.28f * o.roughness * (ridgedNoise(1.7f * bent, o.octaves, o.seed + 809) - 1.2f);
  const float hollow = std::max(0.0f, fractalNoise(1.6f * bent, 2, o.seed + 907) - 0.12f);
  radius -= 1.5f * o.roughness * hollow;
  // Sideways shift makes overhangs, which no radial displacement can.
  const Vec3 shift = 0.18f * o.roughness * bend;
  return std::max(radius, 0.2f) * direction + shift;
}

/// One sweep of smoothing: takes off the points and pinches that no weather would leave.
void weather(TriMesh& mesh) {
  std::vector<Vec3> sums(mesh.vertexCount(), Vec3(0));
  std::vector<float> counts(mesh.vertexCount(), 0);
  for (const UVec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) sums[t[i]] += mesh.positions[t[(i + 1) % 3]], ++counts[t[i]];
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
    mesh.positions[v] = 0.6f * mesh.positions[v] + 0.4f * sums[v] / counts[v];
}

}  // namespace

TriMesh makeRock(const RockOptions& options) {
  requireLength("radius", options.radius);
  requireRange("subdivisions", options.subdivisions, 0, 9);
  requireRange("roughness", options.roughness, 0.0f, 0.6f);
  requireRange("octaves", options.octaves, 1, 12);
  TriMesh mesh = makeIcosphere({.radius = 1, .subdivisions = options.subdivisions});
  for (Vec3& p : mesh.positions) p = options.radius * rockPoint(p, options) * Vec3(1.15f, 0.8f, 1.0f);
  weather(mesh);
  const float low = mesh.bounds().low.y;
  for (Vec3& p : mesh.positions) p.y -= low;
  mesh.normals = angleWeightedNormals(mesh.positions, mesh.triangles);
  return mesh;
}

}  // namespace prt
