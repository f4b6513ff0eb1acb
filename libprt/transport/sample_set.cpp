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

constexpr double kInward = 1e-3;              // pull into the vertex's own faces, against their size
constexpr double kEdgeFraction = 1e-4;        // height above the faces, against the shortest edge
constexpr double kCoordinateFraction = 1e-6;  // ... and against the size of the coordinates: 8 ulps or more
constexpr double kSharedSmoothing = 0.9999;   // cosine above which two shading normals are one
constexpr double kSteepest = 0.05;  // least sine between the offset direction and a face that counts

/// A triangle corner, sorted by where it is.
struct Corner {
  std::uint32_t triangle;
  int index;  // 0..2
  std::uint32_t vertex;
};

/// What the vertices need to know about one corner's face.
struct Wedge {
  Corner corner;
  DVec3 normal;  // unit
  double angle;  // of the face at this corner
  DVec3 a, b;    // the two edges that leave this corner
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
  if (!(size > 0)) return {corner, DVec3(0), 0, a, b};
  return {corner, n / size, std::atan2(size, dot(a, b)), a, b};
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

/// The direction whose least cosine to the normals is the largest: towards the point of their convex hull
/// nearest to zero, found by steps towards the vertex of the hull that is farthest back (Gilbert 1966).
DVec3 innermostDirection(const DVec3& start, std::span<const DVec3> normals) {
  DVec3 nearest = normals.empty() ? start : normals.front();
  for (int i = 0; i < 256; ++i) {
    const DVec3 back = *std::min_element(normals.begin(), normals.end(), [&](const DVec3& a, const DVec3& b) {
      return dot(nearest, a) < dot(nearest, b);
    });
    const DVec3 step = back - nearest;
    const double gain = -dot(nearest, step);
    if (!(gain > 1e-12)) break;
    nearest += step * std::min(1.0, gain / dot(step, step));
  }
  const double size = length(nearest);
  return size > 1e-9 ? nearest / size : start;
}

/// How a vertex leaves the surface: `pull` along its own faces, then the shortest way (roughly) to a height
/// of `clearance` over the planes of all `faces`, if there is a side from which all are seen from outside.
DVec3 leave(const DVec3& pull, const DVec3& normal, std::span<const DVec3> faces, double clearance) {
  DVec3 direction = normal;
  if (leastCosine(normal, faces) < 0.5) direction = innermostDirection(normal, faces);
  if (leastCosine(direction, faces) <= 0) return pull + normal * clearance;
  double distance = 0;
  for (const DVec3& n : faces)
    distance = std::max(distance, (clearance - dot(pull, n)) / std::max(dot(direction, n), kSteepest));
  return pull + direction * distance;
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
  set.origin[sample] = p;
}

/// The faces around a position as one of its vertices sees them from one side.
struct Umbrella {
  DVec3 normal{0};           // geometric normal of the vertex
  DVec3 centre{0};           // mean of its own faces' centres, from the vertex
  std::vector<DVec3> faces;  // normals of those that bound where it may be moved to
  double shortestEdge = std::numeric_limits<double>::infinity();
};

Umbrella umbrellaOf(const Scene& scene, std::uint32_t vertex, double side, std::span<const Wedge> wedges) {
  const DVec3 shading(scene.mesh.normals[vertex]);
  Umbrella umbrella;
  double angles = 0;
  const auto own = [&](const Wedge& wedge) {  // same object, same smoothing
    return scene.vertexObject[wedge.corner.vertex] == scene.vertexObject[vertex] &&
           dot(DVec3(scene.mesh.normals[wedge.corner.vertex]), shading) > kSharedSmoothing;
  };
  for (const Wedge& wedge : wedges) {
    umbrella.shortestEdge = std::min({umbrella.shortestEdge, length(wedge.a), length(wedge.b)});
    if (!own(wedge)) continue;
    umbrella.normal += wedge.angle * wedge.normal;
    umbrella.centre += wedge.angle * (wedge.a + wedge.b) / 3.0;
    angles += wedge.angle;
  }
  umbrella.normal = side * (length(umbrella.normal) > 1e-12 ? normalize(umbrella.normal) : shading);
  umbrella.centre /= std::max(angles, 1e-12);
  const double level = 1e-6 * umbrella.shortestEdge;
  for (const Wedge& wedge : wedges)  // another face matters when it rises above the vertex's plane
    if (own(wedge) || std::max(dot(wedge.a, umbrella.normal), dot(wedge.b, umbrella.normal)) > level)
      umbrella.faces.push_back(side * wedge.normal);
  return umbrella;
}

/// The sample of one vertex, or of its back (side -1), from the faces around its position.
void setVertex(SampleSet& set, std::size_t sample, const Scene& scene, std::uint32_t vertex, double side,
               std::span<const Wedge> wedges) {
  const Umbrella umbrella = umbrellaOf(scene, vertex, side, wedges);
  const DVec3 p(scene.mesh.positions[vertex]);
  const double coordinates = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double clearance = std::max(umbrella.shortestEdge * kEdgeFraction, coordinates * kCoordinateFraction);
  const DVec3 pull = kInward * (umbrella.centre - dot(umbrella.centre, umbrella.normal) * umbrella.normal);
  set.origin[sample] = Vec3(p + leave(pull, umbrella.normal, umbrella.faces, clearance));
  set.geometricNormal[sample] = Vec3(umbrella.normal);
  set.shadingNormal[sample] = float(side) * scene.mesh.normals[vertex];
  for (const Wedge& wedge : wedges)
    if (wedge.corner.vertex == vertex) {
      set.triangle[sample] = wedge.corner.triangle;
      set.barycentric[sample] = {wedge.corner.index == 1 ? 1.0f : 0.0f,
                                 wedge.corner.index == 2 ? 1.0f : 0.0f};
      break;
    }
}

/// Numbers the samples on the backs of two-sided objects.
void numberBacks(SampleSet& set, const Scene& scene) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& m) { return m.twoSided; });
  if (!any) return;
  std::uint32_t next = std::uint32_t(scene.mesh.vertexCount());
  for (std::uint32_t object : scene.vertexObject)
    set.back.push_back(scene.materials[object].twoSided ? next++ : kNone);
  resize(set, next);
}

/// Makes sample i a random point of a triangle, on its front.
void setInside(SampleSet& set, std::size_t i, const TriMesh& mesh, std::size_t t, std::uint64_t seed,
               float sceneSize) {
  const float root = std::sqrt(hashUniform(seed, i, 1)), turn = hashUniform(seed, i, 2);
  const Vec2 b(root * (1 - turn), root * turn);
  const UVec3& corner = mesh.triangles[t];
  const float b0 = 1 - b.x - b.y;
  const Vec3 p =
      b0 * mesh.positions[corner.x] + b.x * mesh.positions[corner.y] + b.y * mesh.positions[corner.z];
  const Vec3 n = b0 * mesh.normals[corner.x] + b.x * mesh.normals[corner.y] + b.y * mesh.normals[corner.z];
  const Vec3 face = Vec3(normalize(DVec3(mesh.areaNormal(t))));
  set.geometricNormal[i] = face;
  set.shadingNormal[i] = length(n) > 1e-6f ? normalize(n) : face;
  set.origin[i] = offsetOrigin(p, face, sceneSize);
  set.triangle[i] = std::uint32_t(t);
  set.barycentric[i] = b;
}

}  // namespace

SampleSet someSamples(const SampleSet& samples, std::span<const std::uint32_t> indices) {
  SampleSet some;
  for (const std::uint32_t s : indices) {
    if (s >= samples.size())
      throw ValueError("there is no sample " + std::to_string(s), "samples",
                       "choose below " + std::to_string(samples.size()));
    some.origin.push_back(samples.origin[s]);
    some.geometricNormal.push_back(samples.geometricNormal[s]);
    some.shadingNormal.push_back(samples.shadingNormal[s]);
    some.triangle.push_back(samples.triangle[s]);
    some.barycentric.push_back(samples.barycentric[s]);
  }
  return some;
}

bool SampleSet::at(const TriMesh& mesh, std::uint32_t t, const Vec2& b, bool onBack,
                   SamplePlace& place) const {
  if (texels) {
    const TexelPlace four = texels->at(t, b);
    place.sample = four.texel;
    place.weight = Vec4(four.weight[0], four.weight[1], four.weight[2], four.weight[3]);
  } else {
    const UVec3& corner = mesh.triangles[t];
    place.sample = {corner.x, corner.y, corner.z, corner.x};
    place.weight = Vec4(1 - b.x - b.y, b.x, b.y, 0);
  }
  for (std::size_t i = 0; onBack && i < 4; ++i) {
    std::uint32_t& s = place.sample[i];
    s = s < back.size() ? back[s] : kNone;
    if (s == kNone) return false;
  }
  return true;
}

SampleSet samplesAtVertices(const Scene& scene, Job* job) {
  const TriMesh& mesh = scene.mesh;
  SampleSet set;
  resize(set, mesh.vertexCount());
  set.vertices = mesh.vertexCount();
  numberBacks(set, scene);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    setFree(set, v, mesh.positions[v], mesh.normals[v]);
    if (!set.back.empty() && set.back[v] != kNone)
      setFree(set, set.back[v], mesh.positions[v], -mesh.normals[v]);
  }
  if (job) job->checkCancelled();
  const std::vector<Corner> corners = cornersByPosition(mesh);
  std::vector<std::uint32_t> vertices;
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    if (job && begin % 64 == 0) job->checkCancelled();
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

SampleSet samplesInTriangles(const Scene& scene, std::span<const std::uint32_t> triangles,
                             std::uint64_t seed) {
  SampleSet set;
  resize(set, triangles.size());
  const float size = scene.mesh.bounds().diagonal();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= scene.mesh.triangleCount())
      throw ValueError("there is no triangle " + std::to_string(triangles[i]), "samples",
                       "choose below " + std::to_string(scene.mesh.triangleCount()));
    setInside(set, i, scene.mesh, triangles[i], seed, size);
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
  const float size = mesh.bounds().diagonal();
  for (std::size_t i = 0; i < count; ++i) {
    const double at =
        std::min((double(i) + hashUniform(seed, i, 0)) / double(count) * total, std::nextafter(total, 0.0));
    const auto t = std::size_t(std::upper_bound(area.begin(), area.end(), at) - area.begin());
    setInside(set, i, mesh, t, seed, size);
  }
  return set;
}

}  // namespace prt
