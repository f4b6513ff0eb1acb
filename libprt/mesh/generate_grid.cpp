#include "libprt/mesh/generate_grid.h"

namespace prt {
namespace {

/// Adds a triangle with its UVs unless two of its vertices are the same pole.
void addTriangle(TriMesh& mesh, const UVec3& vertices, const UVec3& uvs) {
  if (vertices.x == vertices.y || vertices.y == vertices.z || vertices.z == vertices.x) return;
  mesh.triangles.push_back(vertices);
  mesh.uvTriangles.push_back(uvs);
}

}  // namespace

void appendGrid(TriMesh& mesh, int columns, int rows, const std::function<GridPoint(float, float)>& point) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const GridPoint p = point(float(2 * column - columns) / columns, float(2 * row - rows) / rows);
      mesh.positions.push_back(p.position);
      mesh.normals.push_back(p.normal);
      mesh.uv.push_back(p.uv);
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = first + row * (columns + 1) + column, b = a + 1;
      const std::uint32_t d = a + columns + 1, c = d + 1;
      const bool rising = (row + column) % 2 == 0;
      const UVec3 one = rising ? UVec3(a, b, c) : UVec3(a, b, d);
      const UVec3 two = rising ? UVec3(a, c, d) : UVec3(b, c, d);
      addTriangle(mesh, one, one);
      addTriangle(mesh, two, two);
    }
}

TriMesh revolve(std::span<const ProfilePoint> profile, int segments) {
  TriMesh mesh;
  const std::size_t rows = profile.size();
  const bool closed = profile.front().point == profile.back().point && profile.front().point.x > 0;

  // One ring of vertices per profile point, one vertex for a pole; a closed profile ends in its first ring.
  std::vector<std::uint32_t> firstOfRow(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    firstOfRow[row] = std::uint32_t(mesh.positions.size());
    if (closed && row + 1 == rows) {
      firstOfRow[row] = firstOfRow[0];
      break;
    }
    const ProfilePoint& p = profile[row];
    const int count = p.point.x == 0 ? 1 : segments;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * i / segments, s = std::sin(angle), c = std::cos(angle);
      mesh.positions.push_back(Vec3(p.point.x * s, p.point.y, p.point.x * c));
      mesh.normals.push_back(Vec3(normalize(DVec3(p.normal.x * s, p.normal.y, p.normal.x * c))));
    }
  }
  const auto vertex = [&](std::size_t row, int i) {
    return firstOfRow[row] + (profile[row].point.x == 0 ? 0 : std::uint32_t(i % segments));
  };

  // UVs: one more per row than segments; at a pole, the middle of the segment keeps triangles undistorted.
  for (std::size_t row = 0; row < rows; ++row)
    for (int i = 0; i <= segments; ++i) {
      const double shift = profile[row].point.x == 0 ? 0.5 : 0.0;
      mesh.uv.push_back(Vec2((i + (i < segments ? shift : 0)) / segments, profile[row].v));
    }
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (int i = 0; i < segments; ++i) {
      const std::uint32_t a = vertex(row, i), b = vertex(row, i + 1);
      const std::uint32_t d = vertex(row + 1, i), c = vertex(row + 1, i + 1);
      const std::uint32_t ua = std::uint32_t(row) * (segments + 1) + i, ub = ua + 1;
      const std::uint32_t ud = ua + segments + 1, uc = ud + 1;
      if (profile[row].point.x == 0) {
        addTriangle(mesh, {a, c, d}, {ua, uc, ud});
      } else {
        addTriangle(mesh, {a, b, c}, {ua, ub, uc});
        addTriangle(mesh, {a, c, d}, {ua, uc, ud});
      }
    }
  return mesh;
}

}  // namespace prt
