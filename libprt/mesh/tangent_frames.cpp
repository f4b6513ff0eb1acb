#include "libprt/mesh/tangent_frames.h"

#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/weld.h"

#include <algorithm>

namespace prt {
namespace {

/// The part of v at a right angle to n, as a unit vector; zero when there is none to speak of.
Vec3 tangentPart(const Vec3& v, const Vec3& n) {
  const Vec3 flat = v - dot(v, n) * n;
  const float size = length(flat);
  return size > 1e-6f * (1 + length(v)) ? flat / size : Vec3(0);
}

/// Turns v the way the least rotation turns unit normal `from` into `to`.
Vec3 transported(const Vec3& v, const Vec3& from, const Vec3& to) {
  const float c = dot(from, to);
  if (c < -0.9999f) return v;  // any half turn would do
  const Vec3 axis = cross(from, to);
  return c * v + cross(axis, v) + dot(axis, v) / (1 + c) * axis;
}

// ---------------------------------------------------------------------------------------------------------
// Without UVs

/// Neighbours of every vertex in one list.
struct Neighbours {
  std::vector<std::uint32_t> start, list;

  Neighbours(const TriMesh& mesh, Job& job) : start(mesh.vertexCount() + 1, 0) {
    const MeshEdges edges(mesh.triangles, job);
    for (std::size_t e = 0; e < edges.size(); ++e) ++start[edges[e].a + 1], ++start[edges[e].b + 1];
    for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
    list.resize(start.back());
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      list[fill[edges[e].a]++] = edges[e].b;
      list[fill[edges[e].b]++] = edges[e].a;
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t v) const {
    return std::span(list).subspan(start[v], start[v + 1] - start[v]);
  }
};

/// A vector field that is a continuous function of the normal: eastwards, and a little along +X so that
/// level places have a direction too. It vanishes for two normals only, thirty degrees off +-Y towards -Z.
Vec3 fieldOf(const Vec3& n) {
  const Vec3 east = cross(Vec3(0, 1, 0), n), alongX = Vec3(1, 0, 0) - n.x * n;
  return east + 0.5f * alongX;
}

/// Gauss-Seidel: each vector becomes the mean of its neighbours', carried over, and itself. Lengths are kept,
/// so that opposing neighbours make a short vector that the rest can turn.
void smooth(std::vector<Vec3>& field, const TriMesh& mesh, const Neighbours& neighbours, Job& job) {
  for (std::uint32_t v = 0; v < field.size(); ++v) {
    if (v % 65536 == 0) job.checkCancelled();
    const Vec3& n = mesh.normals[v];
    const auto around = neighbours.of(v);
    Vec3 sum = field[v];
    for (std::uint32_t other : around) sum += transported(field[other], mesh.normals[other], n);
    field[v] = (sum - dot(sum, n) * n) / float(1 + around.size());
  }
}

/// [V] unit tangents.
std::vector<Vec3> directionField(const TriMesh& mesh, int sweeps, Job& job) {
  std::vector<Vec3> field;
  field.reserve(mesh.vertexCount());
  for (const Vec3& n : mesh.normals) field.push_back(fieldOf(n));
  const Neighbours neighbours(mesh, job);
  for (int sweep = 0; sweep < sweeps; ++sweep) smooth(field, mesh, neighbours, job);
  for (std::size_t v = 0; v < field.size(); ++v) {
    const Vec3 unit = length(field[v]) > 1e-12f ? tangentPart(normalize(field[v]), mesh.normals[v]) : Vec3(0);
    field[v] = unit == Vec3(0) ? frameFromNormal(mesh.normals[v]).tangent : unit;
  }
  return field;
}

// ---------------------------------------------------------------------------------------------------------
// With UVs

/// Direction of growing u on a triangle, unit; zero when its UVs have no area. `mirrored`: v runs the other
/// way.
Vec3 directionOfU(const TriMesh& mesh, std::size_t f, bool* mirrored) {
  const UVec3 &t = mesh.triangles[f], &w = mesh.uvTriangles[f];
  const DVec3 e1 = DVec3(mesh.positions[t.y]) - DVec3(mesh.positions[t.x]);
  const DVec3 e2 = DVec3(mesh.positions[t.z]) - DVec3(mesh.positions[t.x]);
  const glm::dvec2 d1 = glm::dvec2(mesh.uv[w.y]) - glm::dvec2(mesh.uv[w.x]);
  const glm::dvec2 d2 = glm::dvec2(mesh.uv[w.z]) - glm::dvec2(mesh.uv[w.x]);
  const double area = d1.x * d2.y - d1.y * d2.x;
  *mirrored = area < 0;
  if (std::abs(area) <= 1e-12 * (dot(d1, d1) + dot(d2, d2))) return Vec3(0);
  const DVec3 alongU = (d2.y * e1 - d1.y * e2) * (area < 0 ? -1.0 : 1.0);
  const double size = length(alongU);
  return size > 0 ? Vec3(alongU / size) : Vec3(0);
}

double cornerAngle(const TriMesh& mesh, std::size_t f, int corner) {
  const UVec3& t = mesh.triangles[f];
  const DVec3 here(mesh.positions[t[corner]]);
  const DVec3 a = DVec3(mesh.positions[t[(corner + 1) % 3]]) - here,
              b = DVec3(mesh.positions[t[(corner + 2) % 3]]) - here;
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// [3F] tangents, zero where UVs say nothing.
std::vector<Vec3> tangentsFromUvs(const TriMesh& mesh, Job& job) {
  const std::vector<std::uint32_t> place = weldByPosition(std::span<const Vec3>(mesh.positions), job);
  DenseIndex<3> groups(mesh.uv.size());
  std::vector<std::uint32_t> groupOf(3 * mesh.triangleCount());
  std::vector<DVec3> sums;
  std::vector<Vec3> own(mesh.triangleCount());
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    if (f % 65536 == 0) job.checkCancelled();
    bool mirrored = false;
    own[f] = directionOfU(mesh, f, &mirrored);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t group =
          groups.insert({place[mesh.triangles[f][i]], mesh.uvTriangles[f][i], mirrored ? 1u : 0u});
      if (group == sums.size()) sums.push_back(DVec3(0));
      groupOf[3 * f + std::size_t(i)] = group;
      const Vec3 flat = tangentPart(own[f], mesh.normals[mesh.triangles[f][i]]);
      sums[group] += cornerAngle(mesh, f, i) * DVec3(flat);
    }
  }
  std::vector<Vec3> tangents(3 * mesh.triangleCount());
  for (std::size_t c = 0; c < tangents.size(); ++c) {
    const Vec3& n = mesh.normals[mesh.triangles[c / 3][int(c % 3)]];
    const Vec3 mean = tangentPart(Vec3(sums[groupOf[c]]), n);
    tangents[c] = mean == Vec3(0) ? tangentPart(own[c / 3], n) : mean;
  }
  return tangents;
}

}  // namespace

TangentFrames makeTangentFrames(const TriMesh& mesh, const TangentOptions& options, Job& job) {
  job.begin("tangent frames", 0);
  TangentFrames frames;
  frames.tangents.assign(3 * mesh.triangleCount(), Vec3(0));
  if (options.fromUvs && !mesh.uv.empty()) frames.tangents = tangentsFromUvs(mesh, job);
  const auto missing = [](const Vec3& t) { return t == Vec3(0); };
  if (std::none_of(frames.tangents.begin(), frames.tangents.end(), missing)) return frames;
  const std::vector<Vec3> field = directionField(mesh, std::clamp(options.sweeps, 0, 1000), job);
  for (std::size_t c = 0; c < frames.tangents.size(); ++c)
    if (missing(frames.tangents[c])) frames.tangents[c] = field[mesh.triangles[c / 3][int(c % 3)]];
  return frames;
}

}  // namespace prt
