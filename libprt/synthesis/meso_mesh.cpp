#include "libprt/synthesis/meso_mesh.h"

#include "libprt/core/memory.h"
#include "libprt/core/parallel.h"
#include "libprt/synthesis/surface_darts.h"

#include <algorithm>

namespace prt {
namespace {

constexpr float kReach = 2.2f;  // of rings, in edge lengths of the level

/// Sets what follows from triangles and weights.
void place(MesoMesh& meso, const TriMesh& mesh, Job& job) {
  meso.positions.resize(meso.triangle.size());
  meso.normals.resize(meso.triangle.size());
  parallelFor(job, 0, meso.triangle.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const UVec3& t = mesh.triangles[meso.triangle[i]];
      const Vec2& w = meso.barycentric[i];
      meso.positions[i] = interpolated(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], w);
      const Vec3 n = interpolated(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z], w);
      meso.normals[i] = dot(n, n) > 1e-12f ? normalize(n) : mesh.normals[t.x];
    }
  });
}

RingResult ringsOfLevel(const MesoMesh& meso, const SurfaceSheets& sheets, int level, Job& job) {
  const std::size_t count = meso.levelEnd[std::size_t(level)];
  return voronoiRings(sheets,
                      {std::span(meso.positions).first(count), std::span(meso.normals).first(count),
                       std::span(meso.triangle).first(count)},
                      kReach * float(meso.edgeOf(level)), job);
}

void relax(MesoMesh& meso, const TriMesh& mesh, const SurfaceSheets& sheets, Job& job) {
  const std::vector<Vec3> ways = ringsOfLevel(meso, sheets, meso.levels() - 1, job).toCentre;
  parallelFor(job, 0, ways.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // The way lies in the plane of the shading normal; the triangle's own is tilted against it a little.
      const Vec3& n = sheets.normal[meso.triangle[i]];
      const Vec3 flat = ways[i] - dot(ways[i], n) * n;
      const SurfacePoint to = walk(sheets.surface, {meso.triangle[i], meso.barycentric[i]}, DVec3(flat));
      meso.triangle[i] = to.triangle, meso.barycentric[i] = to.barycentric;
    }
  });
  place(meso, mesh, job);
}

}  // namespace

MesoMesh makeMesoMesh(const TriMesh& mesh, const SurfaceSheets& sheets, const MesoMeshOptions& options,
                      Job& job) {
  requireMemory(options.vertices * 300, "a meso mesh of " + std::to_string(options.vertices) + " vertices",
                "ask for fewer: synthesis.vertices");
  MesoMesh meso;
  {
    const SurfaceDarts darts = throwDarts(sheets, options.vertices, options.coarsest, options.seed, job);
    meso.levelEnd = darts.levelEnd;
    meso.triangle.reserve(darts.points.size());
    meso.barycentric.reserve(darts.points.size());
    for (const SurfacePoint& p : darts.points)
      meso.triangle.push_back(p.triangle), meso.barycentric.push_back(p.barycentric);
  }
  meso.edge = std::sqrt(1.155 * sheets.surface.totalArea() / double(meso.triangle.size()));
  place(meso, mesh, job);
  job.begin("meso mesh", options.relaxations, "relaxations");
  for (int i = 0; i < options.relaxations; ++i) {
    relax(meso, mesh, sheets, job);
    job.advance(1);
  }
  return meso;
}

std::size_t verticesForEdge(const Surface& surface, double edge) {
  return std::size_t(1.155 * surface.totalArea() / (edge * edge));
}

PointRings mesoRings(const MesoMesh& meso, const SurfaceSheets& sheets, int level, Job& job) {
  return ringsOfLevel(meso, sheets, level, job).rings;
}

MesoSpacing mesoSpacing(const MesoMesh& meso, const PointRings& rings) {
  double sum = 0, squares = 0, edges = 0, edgeSquares = 0;
  MesoSpacing s;
  s.nearestLeast = 1e300;
  std::size_t counted = 0;
  for (std::uint32_t p = 0; p < rings.count(); ++p) {
    double nearest = 1e300;
    for (const std::uint32_t q : rings.of(p)) {
      const double d = double(distance(meso.positions[p], meso.positions[q])) / meso.edge;
      nearest = std::min(nearest, d);
      edges += d, edgeSquares += d * d;
      s.edgeMost = std::max(s.edgeMost, d);
    }
    if (rings.of(p).empty()) continue;
    ++counted;
    sum += nearest, squares += nearest * nearest;
    s.nearestLeast = std::min(s.nearestLeast, nearest);
  }
  if (counted == 0) return s;
  const double n = double(counted), m = double(rings.list.size());
  s.nearestMean = sum / n;
  s.nearestSpread = std::sqrt(std::max(0.0, squares / n - s.nearestMean * s.nearestMean)) / s.nearestMean;
  s.edgeMean = edges / m;
  s.edgeSpread = std::sqrt(std::max(0.0, edgeSquares / m - s.edgeMean * s.edgeMean)) / s.edgeMean;
  s.valence = m / double(rings.count());
  return s;
}

}  // namespace prt
