#include "libprt/mesh/normals.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/edges.h"

namespace prt {
namespace {

struct CornerGeometry {
  DVec3 normal;  ///< of the triangle
  double angle;  ///< at the corner
};

std::vector<CornerGeometry> cornerGeometry(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                                           Job& job) {
  CancelCheck check(job);
  std::vector<CornerGeometry> corners;
  corners.reserve(3 * triangles.size());
  for (const UVec3& t : triangles) {
    check();
    const DVec3 p[3] = {DVec3(positions[t.x]), DVec3(positions[t.y]), DVec3(positions[t.z])};
    const DVec3 area = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(area);
    for (int i = 0; i < 3; ++i) {
      const DVec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      corners.push_back({size > 0 ? area / size : DVec3(0), std::atan2(length(cross(a, b)), dot(a, b))});
    }
  }
  return corners;
}

/// Angle-weighted normals of groups of corners; where they cancel, that of one of the triangles.
class GroupNormals {
 public:
  explicit GroupNormals(std::size_t groups) : sums_(groups, DVec3(0)), any_(groups, DVec3(0)) {}

  void add(std::uint32_t group, const CornerGeometry& corner) {
    sums_[group] += corner.angle * corner.normal;
    if (any_[group] == DVec3(0)) any_[group] = corner.normal;
  }
  DVec3 normal(std::uint32_t group) const {
    const double size = length(sums_[group]);
    if (size > 1e-6) return sums_[group] / size;
    return any_[group] == DVec3(0) ? DVec3(0, 1, 0) : any_[group];
  }

 private:
  std::vector<DVec3> sums_, any_;
};

Vec3 normalised(const Vec3& v) {
  const DVec3 d(v);
  const double size = length(d);
  if (std::abs(size - 1) < 1e-6) return v;  // bit for bit
  return size > 1e-12 && size < 1e12 ? Vec3(d / size) : Vec3(0);
}

/// Corners whose file normal is usable get it; returns which.
std::vector<bool> keepFromFile(const CornerNormalInput& in, const std::vector<CornerGeometry>& geometry,
                               CornerNormals& out, Job& job) {
  CancelCheck check(job);
  std::vector<bool> kept(geometry.size(), false);
  if (in.fromFile.empty()) return kept;
  DenseIndex<4> index(in.positions.size());
  std::vector<std::uint32_t> group(geometry.size());
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    check();
    out.normals[c] = normalised(in.fromFile[c]);
    const Vec3& n = out.normals[c];
    group[c] = index.insert({in.triangles[c / 3][int(c % 3)], keyBits(n.x), keyBits(n.y), keyBits(n.z)});
  }
  GroupNormals groups(index.size());
  for (std::size_t c = 0; c < geometry.size(); ++c) groups.add(group[c], geometry[c]);
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    const DVec3 n(out.normals[c]);
    kept[c] = n != DVec3(0) && dot(n, groups.normal(group[c])) > 0;
    out.kept += kept[c];
  }
  return kept;
}

/// One group per vertex, or per fan between creases.
std::vector<std::uint32_t> smoothGroups(const CornerNormalInput& in,
                                        const std::vector<CornerGeometry>& geometry, Job& job) {
  std::vector<std::uint32_t> vertex;
  vertex.reserve(3 * in.triangles.size());
  for (const UVec3& t : in.triangles) vertex.insert(vertex.end(), {t.x, t.y, t.z});
  if (in.creaseAngle >= kPiF) return vertex;
  const MeshEdges edges(in.triangles, job);
  const double smallest = std::cos(double(in.creaseAngle)) - 1e-9;
  const auto joins = [&](const MeshEdge& edge) {
    const bool smooth = dot(geometry[edge.sides[0]].normal, geometry[edge.sides[1]].normal) >= smallest;
    return edge.faceCount() == 2 && vertex[edge.sides[0]] != vertex[edge.sides[1]] && smooth;
  };
  UnionFind fans = cornerFans(edges, vertex, nextInTriangle, joins, job);
  for (std::uint32_t c = 0; c < vertex.size(); ++c) vertex[c] = fans.find(c);
  return vertex;
}

}  // namespace

std::vector<Vec3> angleWeightedNormals(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
  Job unwatched;
  const std::vector<CornerGeometry> geometry = cornerGeometry(positions, triangles, unwatched);
  GroupNormals vertices(positions.size());
  for (std::size_t c = 0; c < geometry.size(); ++c) vertices.add(triangles[c / 3][int(c % 3)], geometry[c]);
  std::vector<Vec3> normals;
  normals.reserve(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) normals.push_back(Vec3(vertices.normal(v)));
  return normals;
}

CornerNormals cornerNormals(const CornerNormalInput& in, Job& job) {
  CancelCheck check(job);
  CornerNormals out;
  out.normals.resize(3 * in.triangles.size());
  const std::vector<CornerGeometry> geometry = cornerGeometry(in.positions, in.triangles, job);
  const std::vector<bool> kept = keepFromFile(in, geometry, out, job);
  if (out.kept == geometry.size()) return out;
  const std::vector<std::uint32_t> group = smoothGroups(in, geometry, job);
  GroupNormals groups(std::max(in.positions.size(), geometry.size()));
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    check();
    if (!kept[c]) groups.add(group[c], geometry[c]);
  }
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    check();
    if (!kept[c]) out.normals[c] = Vec3(groups.normal(group[c]));
  }
  return out;
}

}  // namespace prt
