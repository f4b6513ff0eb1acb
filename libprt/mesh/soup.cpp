#include "libprt/mesh/soup.h"

namespace prt {

PolygonSoup toSoup(const TriMesh& mesh) {
  PolygonSoup soup;
  soup.positions.assign(mesh.positions.begin(), mesh.positions.end());
  soup.normals = mesh.normals;
  soup.uv = mesh.uv;
  soup.cornerVertex.reserve(3 * mesh.triangleCount());
  for (const UVec3& t : mesh.triangles) {
    soup.cornerVertex.insert(soup.cornerVertex.end(), {t.x, t.y, t.z});
    soup.endFace();
  }
  if (!mesh.normals.empty()) soup.cornerNormal = soup.cornerVertex;
  for (const UVec3& t : mesh.uvTriangles) soup.cornerUv.insert(soup.cornerUv.end(), {t.x, t.y, t.z});
  return soup;
}

}  // namespace prt
