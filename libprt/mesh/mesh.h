#pragma once
// The triangle mesh that every stage works on: indexed, repaired, finite. Made by the readers and by
// repair() (see mesh_repair.h) or by the generators; immutable once shared.

#include "libprt/core/math.h"

#include <cstddef>
#include <vector>

namespace prt {

struct TriMesh {
  std::vector<Vec3> positions;     ///< [V]
  std::vector<Vec3> normals;       ///< [V] unit shading normals; a crease is two vertices at one position
  std::vector<UVec3> triangles;    ///< [F] counter-clockwise seen from outside
  std::vector<Vec2> uv;            ///< [V'] texture coordinates, v up; empty when the file had none
  std::vector<UVec3> uvTriangles;  ///< [F] indices into uv; empty exactly when uv is

  std::size_t vertexCount() const { return positions.size(); }
  std::size_t triangleCount() const { return triangles.size(); }
  Box3 bounds() const {
    Box3 box;
    for (const Vec3& p : positions) box.extend(p);
    return box;
  }
  /// Twice-area vector of a triangle: its length is twice the area, its direction the geometric normal.
  Vec3 areaNormal(std::size_t triangle) const {
    const UVec3& t = triangles[triangle];
    return cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
  }
};

}  // namespace prt
