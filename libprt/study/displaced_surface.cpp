#include "libprt/study/displaced_surface.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/normals.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>
#include <unordered_map>

namespace prt {
namespace {

float bilinear(const HeightGrid& grid, const Vec2& uv) {
  const float x = uv.x * float(grid.columns), y = uv.y * float(grid.rows);
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const float fx = x - float(i), fy = y - float(j);
  return (1 - fy) * ((1 - fx) * grid.at(i, j) + fx * grid.at(i + 1, j)) +
         fy * ((1 - fx) * grid.at(i, j + 1) + fx * grid.at(i + 1, j + 1));
}

/// Heights over a surface.
class HeightsOver {
 public:
  HeightsOver(const PatchCover& cover, const HeightGrid& grid, Job& job)
      : cover_(cover), grid_(grid), corners_(cover.cornerCoordinates()) {
    const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
    middle_ = 0.5f * (*low + *high);
    if (cover.map()) readMap(*cover.map(), job);
  }

  /// Against the plane midway in depth.
  float at(std::uint32_t triangle, const Vec2& barycentric) const {
    if (!cover_.map()) return bilinear(grid_, cover_.at(triangle, barycentric)) - middle_;
    const Vec2* uv = corners_.data() + 3 * std::size_t(triangle);
    return smoothed(interpolated(uv[0], uv[1], uv[2], barycentric));
  }

 private:
  void readMap(const IdMap& map, Job& job) {
    size_ = map.size;
    texels_.assign(std::size_t(size_) * std::size_t(size_), kEmpty);
    parallelFor(job, 0, texels_.size(), 65536, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        if (!map.empty(t)) texels_[t] = bilinear(grid_, map.at(t)) - middle_;
    });
  }

  /// A Gaussian over the texels around a place of the atlas.
  float smoothed(const Vec2& uv) const {
    constexpr float kDeviation = 0.9f;
    constexpr int kReach = 2;
    const float x = uv.x * float(size_) - 0.5f, y = (1 - uv.y) * float(size_) - 0.5f;
    const int cx = int(std::lround(x)), cy = int(std::lround(y));
    float sum = 0, weights = 0;
    for (int j = std::max(cy - kReach, 0); j <= std::min(cy + kReach, size_ - 1); ++j)
      for (int i = std::max(cx - kReach, 0); i <= std::min(cx + kReach, size_ - 1); ++i) {
        const float h = texels_[std::size_t(j) * std::size_t(size_) + std::size_t(i)];
        if (h == kEmpty) continue;
        const float dx = float(i) - x, dy = float(j) - y;
        const float w = std::exp(-0.5f * (dx * dx + dy * dy) / (kDeviation * kDeviation));
        sum += w * h, weights += w;
      }
    return weights > 0 ? sum / weights : 0;
  }

  static constexpr float kEmpty = -1e30f;
  const PatchCover& cover_;
  const HeightGrid& grid_;
  std::vector<Vec2> corners_;
  float middle_ = 0;
  int size_ = 0;
  std::vector<float> texels_;
};

/// Numbers of the vertices of cut triangles: the mesh's own, then those on edges, then those inside.
class Cutting {
 public:
  Cutting(const TriMesh& mesh, int cuts, Job& job) : mesh_(mesh), n_(cuts) {
    const MeshEdges edges(mesh.triangles, job);
    edgeOf_.resize(3 * mesh.triangleCount());
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const std::uint32_t side : edges[e].sides) edgeOf_[side] = std::uint32_t(e);
    edgeStart_ = mesh.vertexCount();
    insideStart_ = edgeStart_ + edges.size() * std::size_t(n_ - 1);
  }

  std::size_t vertexCount() const { return insideStart_ + mesh_.triangleCount() * inside(); }

  /// Vertex at i / n, j / n of the way to corners 1 and 2.
  std::size_t vertex(std::size_t f, int i, int j) const {
    const UVec3& t = mesh_.triangles[f];
    const int k = n_ - i - j;
    if (k == n_) return t.x;
    if (i == n_) return t.y;
    if (j == n_) return t.z;
    if (j == 0) return onEdge(f, 0, t.x, t.y, i);
    if (k == 0) return onEdge(f, 1, t.y, t.z, j);
    if (i == 0) return onEdge(f, 2, t.z, t.x, k);
    // Rows of rising j hold one less each.
    const int before = (j - 1) * (n_ - 2) - (j - 1) * (j - 2) / 2;
    return insideStart_ + f * inside() + std::size_t(before + i - 1);
  }

 private:
  std::size_t inside() const { return std::size_t(n_ - 1) * std::size_t(n_ - 2) / 2; }
  /// `steps` from vertex `from` on.
  std::size_t onEdge(std::size_t f, int side, std::uint32_t from, std::uint32_t to, int steps) const {
    const int at = from < to ? steps : n_ - steps;
    return edgeStart_ + std::size_t(edgeOf_[3 * f + std::size_t(side)]) * std::size_t(n_ - 1) +
           std::size_t(at - 1);
  }

  const TriMesh& mesh_;
  int n_;
  std::vector<std::uint32_t> edgeOf_;  // [3F]
  std::size_t edgeStart_ = 0, insideStart_ = 0;
};

}  // namespace

TriMesh displacedSurface(const BiscaleSurface& surface, const HeightGrid& heights,
                         const DisplacedOptions& options, Job& job) {
  const TriMesh& mesh = surface.scene->mesh;
  const int n = options.cuts;
  if (n < 1 || n > 1024) throw ValueError("cuts must be 1 to 1024", "displaced surface", {});
  const HeightsOver over(*surface.cover, heights, job);
  const Cutting cutting(mesh, n, job);
  if (cutting.vertexCount() > std::size_t(1) << 31)
    throw ValueError("has too many vertices", "displaced surface", "cut its edges into fewer parts");
  TriMesh out;
  out.positions.resize(cutting.vertexCount());
  out.triangles.resize(mesh.triangleCount() * std::size_t(n) * std::size_t(n));
  std::vector<std::uint8_t> made(out.positions.size(), 0);
  // One after the other: a vertex on an edge is the first triangle's.
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    if (f % 256 == 0) job.checkCancelled();
    const UVec3& t = mesh.triangles[f];
    std::size_t next = f * std::size_t(n) * std::size_t(n);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) {
        const auto v = std::uint32_t(cutting.vertex(f, i, j));
        if (!std::exchange(made[v], 1)) {
          const Vec2 at(float(i) / float(n), float(j) / float(n));
          const auto of = [&](const std::vector<Vec3>& a) {
            return interpolated(a[t.x], a[t.y], a[t.z], at);
          };
          out.positions[v] = of(mesh.positions) + float(options.patchWidth) * over.at(std::uint32_t(f), at) *
                                                      normalize(of(mesh.normals));
        }
        if (i + j == n) continue;
        const auto right = std::uint32_t(cutting.vertex(f, i + 1, j)),
                   above = std::uint32_t(cutting.vertex(f, i, j + 1));
        out.triangles[next++] = {v, right, above};
        if (i + j + 1 < n)
          out.triangles[next++] = {right, std::uint32_t(cutting.vertex(f, i + 1, j + 1)), above};
      }
  }
  out.normals = angleWeightedNormals(out.positions, out.triangles);
  return out;
}

}  // namespace prt
