#include "libprt/mesh/isosurface.h"

#include "libprt/mesh/edges.h"

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace prt {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

Vec3 gradient(const ScalarField& field, const Vec3& p, float step) {
  const Vec3 x(step, 0, 0), y(0, step, 0), z(0, 0, step);
  return Vec3(field(p + x) - field(p - x), field(p + y) - field(p - y), field(p + z) - field(p - z)) /
         (2 * step);
}

/// Newton steps along the gradient, each at most a cell long.
Vec3 projected(const ScalarField& field, Vec3 p, float cellSize, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Vec3 g = gradient(field, p, 0.05f * cellSize);
    const float slope2 = dot(g, g);
    if (slope2 < 1e-8f) break;
    Vec3 step = -field(p) / slope2 * g;
    const float size = length(step);
    if (size > cellSize) step *= cellSize / size;
    p += step;
  }
  return p;
}

Vec3 unitGradient(const ScalarField& field, const Vec3& p, float cellSize) {
  const Vec3 g = gradient(field, p, 0.05f * cellSize);
  const float size = length(g);
  return size > 0 ? g / size : Vec3(0, 1, 0);
}

/// The field at the nodes of a grid, and the vertex of each cell.
struct Grid {
  Vec3 origin;
  float cell;
  int nodes[3];
  std::vector<float> values;
  std::vector<std::uint32_t> vertices;

  Grid(const ScalarField& field, const Box3& box, float cellSize) : origin(box.low), cell(cellSize) {
    for (int axis = 0; axis < 3; ++axis)
      nodes[axis] = int(std::ceil((box.high[axis] - box.low[axis]) / cellSize)) + 1;
    values.resize(std::size_t(nodes[0]) * nodes[1] * nodes[2]);
    vertices.assign(values.size(), kNone);
    for (int z = 0; z < nodes[2]; ++z)
      for (int y = 0; y < nodes[1]; ++y)
        for (int x = 0; x < nodes[0]; ++x) values[index(x, y, z)] = field(point(x, y, z));
  }
  std::size_t index(int x, int y, int z) const { return (std::size_t(z) * nodes[1] + y) * nodes[0] + x; }
  Vec3 point(int x, int y, int z) const { return origin + cell * Vec3(x, y, z); }
  bool inside(int x, int y, int z) const { return values[index(x, y, z)] < 0; }
};

/// Mean of the points where the surface crosses the twelve edges of a cell; false when it crosses none.
bool cellVertex(const Grid& grid, int x, int y, int z, Vec3* vertex) {
  Vec3 sum(0);
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      int low[3] = {x, y, z};
      low[(axis + 1) % 3] += side & 1;
      low[(axis + 2) % 3] += side >> 1;
      int high[3] = {low[0], low[1], low[2]};
      ++high[axis];
      const float a = grid.values[grid.index(low[0], low[1], low[2])];
      const float b = grid.values[grid.index(high[0], high[1], high[2])];
      if ((a < 0) == (b < 0)) continue;
      Vec3 p = grid.point(low[0], low[1], low[2]);
      p[axis] += grid.cell * a / (a - b);
      sum += p;
      ++crossings;
    }
  if (crossings > 0) *vertex = sum / float(crossings);
  return crossings > 0;
}

void addQuad(TriMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto& p = mesh.positions;
  if (distance(p[a], p[c]) <= distance(p[b], p[d])) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  } else {
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({b, c, d});
  }
}

/// The quadrilateral around a grid edge along `axis` from node (x, y, z), when the surface crosses it.
void addEdgeQuad(const Grid& grid, TriMesh& mesh, int axis, int x, int y, int z) {
  int node[3] = {x, y, z};
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (node[axis] + 1 >= grid.nodes[axis] || node[u] == 0 || node[v] == 0) return;
  int far[3] = {x, y, z};
  ++far[axis];
  const bool from = grid.inside(x, y, z), to = grid.inside(far[0], far[1], far[2]);
  if (from == to) return;
  const auto cellAt = [&](int du, int dv) {
    int cell[3] = {x, y, z};
    cell[u] -= du;
    cell[v] -= dv;
    return grid.vertices[grid.index(cell[0], cell[1], cell[2])];
  };
  // Seen against the axis, (0,0) (1,0) (1,1) (0,1) runs counter-clockwise.
  const std::uint32_t a = cellAt(0, 0), b = cellAt(1, 0), c = cellAt(1, 1), d = cellAt(0, 1);
  if (from)
    addQuad(mesh, a, b, c, d);
  else
    addQuad(mesh, a, d, c, b);
}

double angleAt(const Vec3& corner, const Vec3& a, const Vec3& b) {
  return std::atan2(double(length(cross(a - corner, b - corner))), double(dot(a - corner, b - corner)));
}

std::uint32_t cornerOpposite(const UVec3& t, std::uint32_t a, std::uint32_t b) {
  for (int i = 0; i < 3; ++i)
    if (t[i] != a && t[i] != b) return t[i];
  return t.x;
}

/// Flips every edge whose opposite angles add up to more than pi, each triangle at most once a sweep.
void flipTowardsDelaunay(TriMesh& mesh) {
  Job unwatched;  // a generated shape takes less than a second
  const MeshEdges edges(mesh.triangles, unwatched);
  std::unordered_set<std::uint64_t> present;
  present.reserve(edges.size() * 2);
  for (std::size_t i = 0; i < edges.size(); ++i) present.insert(edgeKey(edges[i].a, edges[i].b));
  std::vector<bool> touched(mesh.triangleCount(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const MeshEdge e = edges[i];
    if (e.faceCount() != 2) continue;
    const std::uint32_t f0 = e.triangle(0), f1 = e.triangle(1);
    if (touched[f0] || touched[f1]) continue;
    const std::uint32_t c = cornerOpposite(mesh.triangles[f0], e.a, e.b);
    const std::uint32_t d = cornerOpposite(mesh.triangles[f1], e.a, e.b);
    const auto& p = mesh.positions;
    if (angleAt(p[c], p[e.a], p[e.b]) + angleAt(p[d], p[e.a], p[e.b]) <= kPi + 1e-6) continue;
    if (c == d || present.count(edgeKey(c, d))) continue;
    const Vec3 n0 = cross(p[d] - p[c], p[e.b] - p[c]), n1 = cross(p[c] - p[d], p[e.a] - p[d]);
    const Vec3 before = mesh.areaNormal(f0) + mesh.areaNormal(f1);
    const bool ab = mesh.triangles[f0][int(e.sides[0] % 3)] == e.a;  // triangle 0 runs a -> b
    const float sign = ab ? 1.0f : -1.0f;
    if (sign * dot(n0, before) <= 0 || sign * dot(n1, before) <= 0) continue;
    mesh.triangles[f0] = ab ? UVec3(c, d, e.b) : UVec3(c, e.b, d);
    mesh.triangles[f1] = ab ? UVec3(d, c, e.a) : UVec3(d, e.a, c);
    touched[f0] = touched[f1] = true;
    present.erase(edgeKey(e.a, e.b));
    present.insert(edgeKey(c, d));
  }
}

/// Moves every vertex in its tangent plane towards the mean of its neighbours.
void smoothTangentially(TriMesh& mesh, const ScalarField& field, float cellSize) {
  std::vector<Vec3> sums(mesh.vertexCount(), Vec3(0));
  std::vector<int> counts(mesh.vertexCount(), 0);
  for (const UVec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      sums[t[i]] += mesh.positions[t[(i + 1) % 3]] + mesh.positions[t[(i + 2) % 3]];
      counts[t[i]] += 2;
    }
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (counts[v] == 0) continue;
    Vec3& p = mesh.positions[v];
    const Vec3 normal = unitGradient(field, p, cellSize);
    Vec3 move = sums[v] / float(counts[v]) - p;
    move -= dot(move, normal) * normal;
    p = projected(field, p + 0.6f * move, cellSize, 1);
  }
}

}  // namespace

TriMesh polygonise(const ScalarField& field, const Box3& box, float cellSize) {
  Grid grid(field, box, cellSize);
  TriMesh mesh;
  for (int z = 0; z + 1 < grid.nodes[2]; ++z)
    for (int y = 0; y + 1 < grid.nodes[1]; ++y)
      for (int x = 0; x + 1 < grid.nodes[0]; ++x) {
        Vec3 vertex;
        if (!cellVertex(grid, x, y, z, &vertex)) continue;
        grid.vertices[grid.index(x, y, z)] = std::uint32_t(mesh.positions.size());
        mesh.positions.push_back(projected(field, vertex, cellSize, 3));
      }
  for (int z = 0; z < grid.nodes[2]; ++z)
    for (int y = 0; y < grid.nodes[1]; ++y)
      for (int x = 0; x < grid.nodes[0]; ++x)
        for (int axis = 0; axis < 3; ++axis) addEdgeQuad(grid, mesh, axis, x, y, z);
  for (const Vec3& p : mesh.positions) mesh.normals.push_back(unitGradient(field, p, cellSize));
  return mesh;
}

void relaxOnSurface(TriMesh& mesh, const ScalarField& field, float cellSize, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    flipTowardsDelaunay(mesh);
    smoothTangentially(mesh, field, cellSize);
  }
  flipTowardsDelaunay(mesh);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    mesh.positions[v] = projected(field, mesh.positions[v], cellSize, 3);
    mesh.normals[v] = unitGradient(field, mesh.positions[v], cellSize);
  }
}

}  // namespace prt
