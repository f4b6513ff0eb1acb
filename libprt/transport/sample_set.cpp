#include "libprt/transport/sample_set.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/transport/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace prt {
namespace {

constexpr float kEdgeFraction = 1e-4f;        // offset against the shortest edge at the vertex
constexpr float kCoordinateFraction = 1e-6f;  // ... and against the size of its coordinates: 8 ulps or more
constexpr double kSharedSmoothing = 0.9999;   // cosine above which two shading normals are one
constexpr double kClearance = 0.05;           // least sine between the offset direction and a face

/// A triangle corner, sorted by where it is.
struct Corner {
  std::uint32_t triangle;
  int index;  // 0..2
  std::uint32_t vertex;
};

/// What the vertices need to know about one corner's face.
struct Wedge {
  Corner corner;
  DVec3 normal;      // unit
  double angle;      // of the face at this corner
  double shortEdge;  // the shorter of the two edges that meet here
};

bool positionLess(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// Corners of all triangles, those at equal positions next to each other, in mesh order among them.
std::vector<Corner> cornersByPosition(const TriMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertexCount());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return p == q ? a < b : positionLess(p, q);
  });
  std::vector<std::uint32_t> place(mesh.vertexCount());  // rank of the vertex's position
  for (std::uint32_t i = 0, rank = 0; i < order.size(); ++i) {
    if (i > 0 && mesh.positions[order[i]] != mesh.positions[order[i - 1]]) ++rank;
    place[order[i]] = rank;
  }
  std::vector<Corner> corners;
  corners.reserve(mesh.triangleCount() * 3);
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) corners.push_back({t, k, mesh.triangles[t][k]});
  std::stable_sort(corners.begin(), corners.end(),
                   [&](const Corner& a, const Corner& b) { return place[a.vertex] < place[b.vertex]; });
  return corners;
}

Wedge wedgeOf(const TriMesh& mesh, const Corner& corner) {
  const UVec3& t = mesh.triangles[corner.triangle];
  const DVec3 p(mesh.positions[t[corner.index]]);
  const DVec3 a = DVec3(mesh.positions[t[(corner.index + 1) % 3]]) - p;
  const DVec3 b = DVec3(mesh.positions[t[(corner.index + 2) % 3]]) - p;
  const DVec3 n = cross(a, b);
  const double size = length(n);
  if (!(size > 0)) return {corner, DVec3(0), 0, 0};
  return {corner, n / size, std::atan2(size, dot(a, b)), std::min(length(a), length(b))};
}

/// The faces around one position that have an area.
std::vector<Wedge> wedgesAt(const TriMesh& mesh, std::span<const Corner> corners) {
  std::vector<Wedge> wedges;
  for (const Corner& corner : corners) {
    const Wedge wedge = wedgeOf(mesh, corner);
    if (wedge.angle > 0) wedges.push_back(wedge);
  }
  return wedges;
}

double leastCosine(const DVec3& d, std::span<const DVec3> normals) {
  double least = 1;
  for (const DVec3& n : normals) least = std::min(least, dot(d, n));
  return least;
}

/// The direction whose least cosine to the normals is (nearly) the largest: towards the centre of their
/// smallest enclosing ball (Badoiu and Clarkson 2003: step 1/i towards the farthest point).
DVec3 innermostDirection(const DVec3& start, std::span<const DVec3> normals) {
  DVec3 centre = start;
  for (int i = 1; i <= 64; ++i) {
    const auto farthest = std::min_element(normals.begin(), normals.end(), [&](const DVec3& a, const DVec3& b) {
      return dot(centre, a) < dot(centre, b);
    });
    centre += (*farthest - centre) / double(i + 1);
  }
  const double size = length(centre);
  return size > 0 ? centre / size : start;
}

/// Where to move a vertex so that it leaves every face around it on the outer side: all faces if that
/// can be, else those of its own object, else along its normal alone.
DVec3 offsetDirection(const DVec3& normal, std::span<const DVec3> all, std::span<const DVec3> own) {
  for (const std::span<const DVec3> normals : {all, own}) {
    if (leastCosine(normal, normals) > 0.5) return normal;
    const DVec3 direction = innermostDirection(normal, normals);
    if (leastCosine(direction, normals) > 0) return direction;
  }
  return normal;
}

void resize(SampleSet& set, std::size_t count) {
  set.origin.resize(count);
  set.geometricNormal.resize(count);
  set.shadingNormal.resize(count);
  set.triangle.resize(count, kNone);
  set.barycentric.resize(count, Vec2(0));
}

/// A sample that lies on no triangle, as a vertex without faces does.
void setFree(SampleSet& set, std::size_t sample, const Vec3& p, const Vec3& normal) {
  set.shadingNormal[sample] = set.geometricNormal[sample] = normal;
  set.origin[sample] = offsetOrigin(p, normal);
}

/// The sample of one vertex, or of its back (side -1), from the faces around its position.
void setVertex(SampleSet& set, std::size_t sample, const Scene& scene, std::uint32_t vertex, double side,
               std::span<const Wedge> wedges) {
  const TriMesh& mesh = scene.mesh;
  const DVec3 shading(mesh.normals[vertex]);
  DVec3 sum(0);
  double shortest = std::numeric_limits<double>::infinity();
  std::vector<DVec3> all, own;
  for (const Wedge& wedge : wedges) {
    const bool mine = scene.vertexObject[wedge.corner.vertex] == scene.vertexObject[vertex];
    all.push_back(side * wedge.normal);
    shortest = std::min(shortest, wedge.shortEdge);
    if (!mine) continue;
    own.push_back(side * wedge.normal);
    if (dot(DVec3(mesh.normals[wedge.corner.vertex]), shading) > kSharedSmoothing) sum += wedge.angle * wedge.normal;
    if (wedge.corner.vertex != vertex) continue;
    set.triangle[sample] = wedge.corner.triangle;
    set.barycentric[sample] = {wedge.corner.index == 1 ? 1.0f : 0.0f, wedge.corner.index == 2 ? 1.0f : 0.0f};
  }
  const DVec3 normal = side * (length(sum) > 1e-12 ? normalize(sum) : shading);
  const DVec3 direction = offsetDirection(normal, all, own);
  const DVec3 p(mesh.positions[vertex]);
  const double coordinates = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double clearance = std::max(shortest * kEdgeFraction, coordinates * kCoordinateFraction);
  set.origin[sample] = Vec3(p + direction * (clearance / std::max(leastCosine(direction, all), kClearance)));
  set.geometricNormal[sample] = Vec3(normal);
  set.shadingNormal[sample] = Vec3(side * shading);
}

/// Numbers the samples on the backs of two-sided objects.
void numberBacks(SampleSet& set, const Scene& scene) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.twoSided; });
  if (!any) return;
  std::uint32_t next = std::uint32_t(scene.mesh.vertexCount());
  for (std::uint32_t object : scene.vertexObject) set.back.push_back(scene.materials[object].twoSided ? next++ : kNone);
  resize(set, next);
}

}  // namespace

SampleSet samplesAtVertices(const Scene& scene) {
  const TriMesh& mesh = scene.mesh;
  SampleSet set;
  resize(set, mesh.vertexCount());
  numberBacks(set, scene);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    setFree(set, v, mesh.positions[v], mesh.normals[v]);
    if (!set.back.empty() && set.back[v] != kNone) setFree(set, set.back[v], mesh.positions[v], -mesh.normals[v]);
  }
  const std::vector<Corner> corners = cornersByPosition(mesh);
  std::vector<std::uint32_t> vertices;
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    const Vec3& p = mesh.positions[corners[begin].vertex];
    while (end < corners.size() && mesh.positions[corners[end].vertex] == p) ++end;
    const std::vector<Wedge> wedges = wedgesAt(mesh, std::span(corners).subspan(begin, end - begin));
    if (wedges.empty()) continue;
    vertices.clear();
    for (std::size_t i = begin; i < end; ++i) vertices.push_back(corners[i].vertex);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices) {
      setVertex(set, v, scene, v, 1, wedges);
      if (!set.back.empty() && set.back[v] != kNone) setVertex(set, set.back[v], scene, v, -1, wedges);
    }
  }
  return set;
}

SampleSet samplesOnSurface(const Scene& scene, std::size_t count, std::uint64_t seed) {
  const TriMesh& mesh = scene.mesh;
  std::vector<double> area(mesh.triangleCount());  // up to and including each triangle
  double total = 0;
  for (std::size_t t = 0; t < area.size(); ++t) area[t] = total += 0.5 * length(DVec3(mesh.areaNormal(t)));
  if (!(total > 0)) throw GeometryError("surface has no area", "scene", "repair the mesh first");

  SampleSet set;
  resize(set, count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = std::min((double(i) + hashUniform(seed, i, 0)) / double(count) * total, std::nextafter(total, 0.0));
    const auto t = std::size_t(std::upper_bound(area.begin(), area.end(), at) - area.begin());
    const float root = std::sqrt(hashUniform(seed, i, 1)), turn = hashUniform(seed, i, 2);
    const Vec2 b(root * (1 - turn), root * turn);
    const UVec3& corner = mesh.triangles[t];
    const float b0 = 1 - b.x - b.y;
    const Vec3 p = b0 * mesh.positions[corner.x] + b.x * mesh.positions[corner.y] + b.y * mesh.positions[corner.z];
    const Vec3 n = b0 * mesh.normals[corner.x] + b.x * mesh.normals[corner.y] + b.y * mesh.normals[corner.z];
    const Vec3 face = Vec3(normalize(DVec3(mesh.areaNormal(t))));
    set.geometricNormal[i] = face;
    set.shadingNormal[i] = length(n) > 1e-6f ? normalize(n) : face;
    set.origin[i] = offsetOrigin(p, face);
    set.triangle[i] = std::uint32_t(t);
    set.barycentric[i] = b;
  }
  return set;
}

}  // namespace prt
