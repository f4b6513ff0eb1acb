#include "libprt/shade/raster_setup.h"

#include "libprt/core/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace prt::raster {
namespace {

constexpr std::size_t kChunk = 4096;

/// A convex polygon while planes cut it: a triangle gains one corner a plane at most.
struct Polygon {
  std::array<Homogeneous, 8> p;
  int count = 0;
  void add(const Homogeneous& v) { p[std::size_t(count++)] = v; }
};

/// A half-space of homogeneous points: a x + b y + c w + d >= 0.
struct Plane {
  double a, b, c, d;
  double operator()(const Homogeneous& p) const { return a * p.x + b * p.y + c * p.w + d; }
};

/// The cut is always computed from the inside end to the outside one, so that both triangles at an
/// edge get the same bits.
Polygon clip(const Polygon& in, const Plane& plane) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const Homogeneous &p = in.p[std::size_t(i)], &q = in.p[std::size_t((i + 1) % in.count)];
    const double dp = plane(p), dq = plane(q);
    if (dp >= 0) out.add(p);
    if ((dp >= 0) == (dq >= 0)) continue;
    const Homogeneous &inside = dp >= 0 ? p : q, &outside = dp >= 0 ? q : p;
    const double di = std::max(dp, dq), t = di / (di - std::min(dp, dq));
    out.add({inside.x + t * (outside.x - inside.x), inside.y + t * (outside.y - inside.y),
             inside.w + t * (outside.w - inside.w),
             inside.distance + t * (outside.distance - inside.distance)});
  }
  return out;
}

/// What the fixed-point numbers can hold: the image and as much again on every side.
struct Limits {
  std::array<Plane, 5> planes;
  double farthest = 0;   // distance; for parallel rays
  double perLength = 0;  // nearness lost per distance there; 0: nearness is 1/w

  Limits(const Projection& projection, double nearest) {
    const double x = projection.samplesX, y = projection.samplesY;
    planes = {Plane{0, 0, 1, -nearest}, {1, 0, x, 0}, {-1, 0, 2 * x, 0}, {0, 1, y, 0}, {0, -1, 2 * y, 0}};
  }
  bool inside(const Homogeneous& p) const {
    for (const Plane& plane : planes)
      if (plane(p) < 0) return false;
    return true;
  }
  /// Screen-linear, see SetupTriangle. Parallel rays: from 1, farthest, to 2.
  float nearness(const Homogeneous& p) const {
    return perLength > 0 ? float(1 + (farthest - p.distance) * perLength) : float(1 / p.w);
  }
};

/// Snaps a triangle; adds it to the chunk unless it has no area left.
void addTriangle(const Homogeneous& a, const Homogeneous& b, const Homogeneous& c, std::uint32_t id,
                 const Limits& limits, double unit, Chunk& chunk) {
  SetupTriangle t;
  const Homogeneous* corner[3] = {&a, &b, &c};
  for (std::size_t i = 0; i < 3; ++i) {
    const double inverse = 1 / corner[i]->w;
    t.x[i] = std::int32_t(std::lrint(corner[i]->x * inverse * unit));
    t.y[i] = std::int32_t(std::lrint(corner[i]->y * inverse * unit));
    t.nearness[i] = limits.nearness(*corner[i]);
  }
  const std::int64_t area =
      std::int64_t(t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - std::int64_t(t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
  if (area == 0) return;
  if (area < 0) std::swap(t.x[1], t.x[2]), std::swap(t.y[1], t.y[2]), std::swap(t.nearness[1], t.nearness[2]);
  t.triangle = id;
  chunk.triangles.push_back(t);
}

void clipAndAdd(const std::array<Homogeneous, 3>& p, std::uint32_t id, const Limits& limits, double unit,
                Chunk& chunk) {
  Polygon polygon;
  for (const Homogeneous& v : p) polygon.add(v);
  for (const Plane& plane : limits.planes) polygon = clip(polygon, plane);
  for (std::size_t i = 2; i < std::size_t(polygon.count); ++i)
    addTriangle(polygon.p[0], polygon.p[i - 1], polygon.p[i], id, limits, unit, chunk);
}

/// Tiles that a triangle's covered samples lie in; empty when low > high.
struct TileRange {
  int x0, y0, x1, y1;
};

TileRange tilesOf(const SetupTriangle& t, int bits, int tileSamples, int tilesX, int tilesY) {
  const auto [lowX, highX] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [lowY, highY] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const int half = 1 << (bits - 1), round = (1 << bits) - 1;
  const int x0 = std::max(0, (lowX - half + round) >> bits),
            x1 = std::min(tileSamples * tilesX - 1, (highX - half) >> bits);
  const int y0 = std::max(0, (lowY - half + round) >> bits),
            y1 = std::min(tileSamples * tilesY - 1, (highY - half) >> bits);
  if (x0 > x1 || y0 > y1) return {0, 0, -1, -1};
  return {x0 / tileSamples, y0 / tileSamples, x1 / tileSamples, y1 / tileSamples};
}

/// Counting sort of the chunk's triangles by tile.
void sortIntoTiles(Chunk& chunk, int bits, int tileSamples, int tilesX, int tilesY) {
  const auto eachTile = [&](const SetupTriangle& t, const auto& visit) {
    const TileRange r = tilesOf(t, bits, tileSamples, tilesX, tilesY);
    for (int y = r.y0; y <= r.y1; ++y)
      for (int x = r.x0; x <= r.x1; ++x) visit(std::size_t(y) * std::size_t(tilesX) + std::size_t(x));
  };
  chunk.first.assign(std::size_t(tilesX) * std::size_t(tilesY) + 1, 0);
  for (const SetupTriangle& t : chunk.triangles)
    eachTile(t, [&](std::size_t tile) { ++chunk.first[tile + 1]; });
  for (std::size_t i = 1; i < chunk.first.size(); ++i) chunk.first[i] += chunk.first[i - 1];
  chunk.items.resize(chunk.first.back());
  std::vector<std::uint32_t> next(chunk.first.begin(), chunk.first.end() - 1);
  for (std::size_t i = 0; i < chunk.triangles.size(); ++i)
    eachTile(chunk.triangles[i], [&](std::size_t tile) { chunk.items[next[tile]++] = std::uint32_t(i); });
}

}  // namespace

Projection::Projection(const Camera& camera, int width, int height) : samplesX(width), samplesY(height) {
  const Frame f = camera.axes();
  parallel = camera.orthographic;
  eye = DVec3(camera.eye);
  rowW = -DVec3(f.normal);
  // Samples per length: at the target, or at distance 1.
  const double focal = parallel ? height / double(camera.viewHeight())
                                : 0.5 * height / std::tan(0.5 * double(camera.verticalFov));
  rowX = focal * DVec3(f.tangent);
  rowY = -focal * DVec3(f.bitangent);
  if (!parallel) rowX += 0.5 * width * rowW, rowY += 0.5 * height * rowW;
  // Coordinates span three image sizes; edges must stay below 2^22 units for 32-bit stepping in a tile.
  const unsigned span = 3u * unsigned(std::max(width, height)) + 2u;
  bits = std::clamp(22 - int(std::bit_width(span)), 1, 8);
}

Homogeneous Projection::operator()(const Vec3& p) const {
  const DVec3 d = DVec3(p) - eye;
  const double distance = dot(rowW, d);
  if (parallel) return {dot(rowX, d) + 0.5 * samplesX, dot(rowY, d) + 0.5 * samplesY, 1, distance};
  return {dot(rowX, d), dot(rowY, d), distance, distance};
}

Bins binTriangles(const TriMesh& mesh, const Projection& projection, int tileSamples, int tilesX, int tilesY,
                  Job& job) {
  std::vector<Homogeneous> projected(mesh.vertexCount());
  parallelFor(job, 0, projected.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) projected[i] = projection(mesh.positions[i]);
  });
  double farthest = -std::numeric_limits<double>::infinity(), nearest = -farthest;
  for (const Homogeneous& p : projected)
    farthest = std::max(farthest, p.distance), nearest = std::min(nearest, p.distance);
  if (projected.empty() || (!projection.parallel && !(farthest > 0)))
    return {};  // everything is behind the camera

  Limits limits(projection, projection.parallel ? 0.5 : 1e-9 * farthest);
  if (projection.parallel)
    limits.farthest = farthest, limits.perLength = 1 / std::max(farthest - nearest, 1e-30);
  const double unit = double(1 << projection.bits);
  Bins bins{{}, limits.farthest, limits.perLength};
  bins.chunks.resize((mesh.triangleCount() + kChunk - 1) / kChunk);
  parallelFor(job, 0, mesh.triangleCount(), kChunk, [&](std::size_t begin, std::size_t end) {
    Chunk& chunk = bins.chunks[begin / kChunk];
    chunk.triangles.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const UVec3& t = mesh.triangles[i];
      const std::array<Homogeneous, 3> p{projected[t.x], projected[t.y], projected[t.z]};
      if (limits.inside(p[0]) && limits.inside(p[1]) && limits.inside(p[2]))
        addTriangle(p[0], p[1], p[2], std::uint32_t(i), limits, unit, chunk);
      else
        clipAndAdd(p, std::uint32_t(i), limits, unit, chunk);
    }
    sortIntoTiles(chunk, projection.bits, tileSamples, tilesX, tilesY);
  });
  return bins;
}

}  // namespace prt::raster
