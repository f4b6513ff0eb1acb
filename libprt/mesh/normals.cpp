#include "libprt/mesh/normals.h"

namespace prt {
namespace {

/// Angle between two vectors, in double: atan2 keeps slivers accurate where acos would not.
double angleBetween(const DVec3& a, const DVec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

std::vector<Vec3> angleWeightedNormals(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
  std::vector<DVec3> sums(positions.size(), DVec3(0));
  std::vector<DVec3> anyNormal(positions.size(), DVec3(0));
  for (const UVec3& t : triangles) {
    const DVec3 corner[3] = {positions[t.x], positions[t.y], positions[t.z]};
    const DVec3 area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double twiceArea = length(area);
    if (!(twiceArea > 0)) continue;
    const DVec3 normal = area / twiceArea;
    for (int i = 0; i < 3; ++i) {
      const DVec3 &here = corner[i], &next = corner[(i + 1) % 3], &previous = corner[(i + 2) % 3];
      sums[t[i]] += angleBetween(next - here, previous - here) * normal;
      anyNormal[t[i]] = normal;
    }
  }

  std::vector<Vec3> normals(positions.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double size = length(sums[v]);
    const bool useAny = size < 1e-6;
    const DVec3 normal = useAny ? anyNormal[v] : sums[v] / size;
    normals[v] = normal == DVec3(0) ? Vec3(0, 1, 0) : Vec3(normal);
  }
  return normals;
}

}  // namespace prt
