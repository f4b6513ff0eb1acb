#pragma once
// Vertices of a surface that repeats with period 1 along x and y: which of them are one. Internal to meso.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace prt {

/// [V] for each vertex the first one at the same point of the torus (to 1e-5 of a period). A job, when given,
/// can cancel it.
std::vector<std::uint32_t> torusPlaces(std::span<const Vec3> positions, Job* job = nullptr);

/// [V] the first vertex at the same place with the same normal.
std::vector<std::uint32_t> torusTwins(std::span<const Vec3> normals, std::span<const std::uint32_t> places);

/// Smooth normals: angle-weighted over all triangles around a place of the torus.
std::vector<Vec3> torusNormals(const TriMesh& mesh, std::span<const std::uint32_t> places);

/// New vertices for (old vertex, periods along x and y), each made once.
class TorusVertexMap {
 public:
  template <class Make>
  std::uint32_t at(std::uint32_t vertex, int x, int y, const Make& make) {
    const auto [found, fresh] = made_.try_emplace(std::tuple(vertex, x, y), 0u);
    if (fresh) found->second = make();
    return found->second;
  }

 private:
  std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> made_;
};

}  // namespace prt
