#include "libprt/atlas/surface.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/fans.h"
#include "libprt/mesh/weld.h"

#include <algorithm>

namespace prt {
namespace {

/// Numbers the vertices that triangles use, in the mesh's order.
void numberVertices(const TriMesh& mesh, FanSplit fans, const std::vector<std::uint32_t>& welded,
                    Surface& surface) {
  std::vector<std::uint32_t> number(fans.source.size(), kNowhere);
  for (const UVec3& t : fans.triangles)
    for (int i = 0; i < 3; ++i) number[t[i]] = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNowhere) continue;
    number[v] = std::uint32_t(surface.positions.size());
    surface.positions.push_back(mesh.positions[fans.source[v]]);
    surface.meshVertex.push_back(fans.source[v]);
  }
  for (UVec3& t : fans.triangles)
    for (int i = 0; i < 3; ++i) t[i] = number[t[i]];
  surface.triangles = std::move(fans.triangles);
  surface.vertexOfMesh.resize(mesh.vertexCount());
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) surface.vertexOfMesh[v] = number[welded[v]];
}

void joinEdges(Surface& surface, Job& job) {
  const MeshEdges edges(surface.triangles, job);
  CancelCheck check(job);
  surface.twin.assign(3 * surface.triangles.size(), kNowhere);
  surface.edge.assign(3 * surface.triangles.size(), kNowhere);
  surface.halfOf.reserve(edges.size());
  surface.spokeStart.assign(surface.positions.size() + 1, 0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    check();
    const MeshEdge edge = edges[e];
    for (std::uint32_t half : edge.sides) surface.edge[half] = std::uint32_t(e);
    if (edge.faceCount() == 2) {
      surface.twin[edge.sides[0]] = edge.sides[1];
      surface.twin[edge.sides[1]] = edge.sides[0];
    }
    surface.halfOf.push_back(edge.sides[0]);
    ++surface.spokeStart[edge.a + 1];
    ++surface.spokeStart[edge.b + 1];
  }
  for (std::size_t v = 0; v < surface.positions.size(); ++v)
    surface.spokeStart[v + 1] += surface.spokeStart[v];
  surface.spokes.resize(2 * edges.size());
  std::vector<std::uint32_t> fill(surface.spokeStart.begin(), surface.spokeStart.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    surface.spokes[fill[edges[e].a]++] = std::uint32_t(e);
    surface.spokes[fill[edges[e].b]++] = std::uint32_t(e);
  }
}

}  // namespace

Surface::Surface(const TriMesh& mesh, Job& job) {
  // Join vertices by position, then part what is no manifold.
  const std::vector<std::uint32_t> welded = weldByPosition(std::span<const Vec3>(mesh.positions), job);
  std::vector<UVec3> joined;
  joined.reserve(mesh.triangleCount());
  for (const UVec3& t : mesh.triangles) joined.push_back({welded[t.x], welded[t.y], welded[t.z]});
  numberVertices(mesh, splitIntoFans(joined, mesh.vertexCount(), job), welded, *this);
  joinEdges(*this, job);
}

Surface::Surface(std::vector<Vec3> at, std::vector<UVec3> faces, Job& job)
    : positions(std::move(at)), triangles(std::move(faces)) {
  for (std::uint32_t v = 0; v < positions.size(); ++v) meshVertex.push_back(v);
  vertexOfMesh = meshVertex;
  joinEdges(*this, job);
}

std::uint32_t Surface::edgeBetween(std::uint32_t a, std::uint32_t b) const {
  for (std::uint32_t i = spokeStart[a]; i < spokeStart[a + 1]; ++i)
    if (across(spokes[i], a) == b) return spokes[i];
  return kNowhere;
}

double Surface::totalArea() const {
  double sum = 0;
  for (std::uint32_t f = 0; f < triangles.size(); ++f) sum += area(f);
  return sum;
}

std::vector<float> bendAngles(const Surface& surface, Job& job) {
  CancelCheck check(job);
  std::vector<float> bends(surface.edgeCount(), 0.0f);
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
    check();
    const std::uint32_t half = surface.halfOf[e], other = surface.twin[half];
    if (other == kNowhere) continue;
    const DVec3 n = surface.areaNormal(half / 3), m = surface.areaNormal(other / 3);
    const double scale = glm::length(n) * glm::length(m);
    if (!(scale > 0)) continue;
    const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
    // In a valley the far corner of the other triangle lies above this one's plane.
    const DVec3 far(surface.positions[surface.from(previousHalf(other))]);
    const double height = glm::dot(n, far - DVec3(surface.positions[surface.from(half)]));
    bends[e] = float(height > 0 ? angle : -angle);
  }
  return bends;
}

std::vector<float> seamCosts(const Surface& surface, const EdgeCostOptions& options, Job& job) {
  std::vector<float> costs = bendAngles(surface, job);
  for (std::uint32_t e = 0; e < costs.size(); ++e) {
    const double bend = std::min(1.0, std::abs(double(costs[e])) / radians(60));
    double factor = 1 - 0.5 * options.followCreases * bend;
    if (costs[e] > 0) factor -= options.concaveBonus * bend;
    costs[e] = float(surface.length(e) * std::max(factor, 0.2));
  }
  return costs;
}

}  // namespace prt
