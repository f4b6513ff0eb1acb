#pragma once
// What an ErrorProbe holds. Internal to transport.

#include "libprt/transport/error_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace prt {

inline constexpr int kPilots = 4;  ///< independent bakes of the vertices; two make a half

/// Neighbours along edges: of vertex v those in [first[v], first[v + 1]).
struct Neighbours {
  std::vector<std::uint32_t> first, list;

  explicit Neighbours(const TriMesh& mesh) {
    std::vector<std::uint64_t> pairs;
    pairs.reserve(6 * mesh.triangleCount());
    for (const UVec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint64_t a = t[k], b = t[(k + 1) % 3];
        pairs.push_back(a << 32 | b);
        pairs.push_back(b << 32 | a);
      }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    first.assign(mesh.vertexCount() + 1, 0);
    for (const std::uint64_t pair : pairs) ++first[(pair >> 32) + 1], list.push_back(std::uint32_t(pair));
    std::partial_sum(first.begin(), first.end(), first.begin());
  }

  /// Weighted means over each vertex and its neighbours, several times.
  void smooth(std::vector<double>& values, const std::vector<double>& weight, int sweeps) const {
    std::vector<double> from;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      from = values;
      for (std::size_t v = 0; v < values.size(); ++v) {
        double sum = weight[v] * from[v], total = weight[v];
        for (std::uint32_t i = first[v]; i < first[v + 1]; ++i)
          sum += weight[list[i]] * from[list[i]], total += weight[list[i]];
        values[v] = total > 0 ? sum / total : 0;
      }
    }
  }
};

/// What pilots tell about the vertices.
struct ProbedVertices {
  std::shared_ptr<const Scene> scene;
  int bands = 0, channels = 1;
  std::vector<float> product;                      // [V, n^2, channels]
  std::array<std::vector<float>, kPilots> pilots;  // the same, from other rays
  std::array<std::vector<float>, 2> tail;          // [V, kErrorBands^2 - n^2] means of two pilots each
  std::vector<std::uint8_t> buried;
  std::vector<double> area;  // [V], 0 where buried
  Neighbours neighbours;
  std::vector<std::uint32_t> again;  // some vertices, ...
  std::vector<float> againVectors;   // ... as another bake with as many rays has them

  explicit ProbedVertices(std::shared_ptr<const Scene> s) : scene(std::move(s)), neighbours(scene->mesh) {}
  std::size_t count() const { return area.size(); }
  std::size_t width() const { return std::size_t(shCount(bands) * channels); }
};

/// The truth at one random point in each face, twice.
struct ProbedPoints {
  std::vector<std::uint32_t> triangle;
  std::vector<Vec2> barycentric;
  std::array<std::vector<float>, 2> truth;  // [P, n^2, channels]
  std::vector<std::uint8_t> buried;
};

}  // namespace prt
