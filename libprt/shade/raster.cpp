#include "libprt/shade/raster.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/raster_setup.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace prt {
namespace {

using raster::Bins;
using raster::kTileSamples;
using raster::Projection;
using raster::SetupTriangle;

constexpr int kLanes = 8;

/// A rectangle of samples inside a tile, ends included; `x0` on a multiple of kLanes.
struct Span2 {
  int x0, y0, x1, y1;
};

/// An edge or depth function in units that the inner loop adds up: value + x * stepX + y * stepY.
struct EdgeFunction {
  std::int32_t value, stepX, stepY;
};

/// Edge from vertex a to b: >= 0 on samples inside. The exact 64-bit value is divided by the sample
/// pitch, which loses nothing because every sample is a whole number of pitches away from the first.
EdgeFunction edgeFunction(const SetupTriangle& t, int a, int b, std::int64_t px, std::int64_t py, int bits) {
  const std::int32_t dx = t.x[b] - t.x[a], dy = t.y[b] - t.y[a];
  const bool ownsItsPoints = dy < 0 || (dy == 0 && dx > 0);  // left edge or top edge
  std::int64_t value = std::int64_t(dx) * (py - t.y[a]) - std::int64_t(dy) * (px - t.x[a]);
  value = (value - (ownsItsPoints ? 0 : 1)) >> bits;
  // Steps sum to less than 2^30 inside a tile, so beyond that the sign cannot change.
  constexpr std::int64_t kFar = std::int64_t(1) << 30;
  return {std::int32_t(std::clamp(value, -kFar, kFar)), -dy, dx};
}

struct DepthPlane {
  float value, stepX, stepY, low, high;
};

DepthPlane depthPlane(const SetupTriangle& t, std::int64_t px, std::int64_t py, double pitch) {
  const double x1 = t.x[1] - t.x[0], y1 = t.y[1] - t.y[0], x2 = t.x[2] - t.x[0], y2 = t.y[2] - t.y[0];
  const double w1 = double(t.nearness[1]) - t.nearness[0], w2 = double(t.nearness[2]) - t.nearness[0];
  const double scale = 1 / (x1 * y2 - x2 * y1);
  const double gx = (w1 * y2 - w2 * y1) * scale, gy = (w2 * x1 - w1 * x2) * scale;
  const double value = t.nearness[0] + gx * double(px - t.x[0]) + gy * double(py - t.y[0]);
  const auto [low, high] = std::minmax({t.nearness[0], t.nearness[1], t.nearness[2]});
  return {float(value), float(gx * pitch), float(gy * pitch), low, high};
}

/// Samples of the tile whose centres lie in the triangle's bounding box; empty when x0 > x1 or y0 > y1.
Span2 coveredSpan(const SetupTriangle& t, int tileX, int tileY, int extentX, int extentY, int bits) {
  const auto [lowX, highX] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [lowY, highY] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const int half = 1 << (bits - 1);
  const int round = (1 << bits) - 1;
  return {std::max(0, ((lowX - half + round) >> bits) - tileX),
          std::max(0, ((lowY - half + round) >> bits) - tileY),
          std::min(extentX - 1, ((highX - half) >> bits) - tileX),
          std::min(extentY - 1, ((highY - half) >> bits) - tileY)};
}

/// The inner loop: eight samples of a row at once.
void drawSpan(const Span2& span, const std::array<EdgeFunction, 3>& e, const DepthPlane& depth,
              std::uint32_t id, SampleTile& out) {
  for (int y = span.y0; y <= span.y1; ++y) {
    const int row = y - span.y0;
    std::int32_t a = e[0].value + row * e[0].stepY, b = e[1].value + row * e[1].stepY,
                 c = e[2].value + row * e[2].stepY;
    const float z0 = depth.value + float(row) * depth.stepY;
    std::uint32_t* ids = out.triangle.data() + std::size_t(y) * kTileSamples;
    float* depths = out.nearness.data() + std::size_t(y) * kTileSamples;
    for (int x = span.x0; x <= span.x1; x += kLanes) {
      const float z1 = z0 + float(x - span.x0) * depth.stepX;
      for (int i = 0; i < kLanes; ++i) {
        const std::int32_t outside = (a + i * e[0].stepX) | (b + i * e[1].stepX) | (c + i * e[2].stepX);
        float z = z1 + float(i) * depth.stepX;
        z = z < depth.low ? depth.low : z;
        z = z > depth.high ? depth.high : z;
        const bool nearer = (outside >= 0) & (z > depths[x + i]);
        depths[x + i] = nearer ? z : depths[x + i];
        ids[x + i] = nearer ? id : ids[x + i];
      }
      a += kLanes * e[0].stepX, b += kLanes * e[1].stepX, c += kLanes * e[2].stepX;
    }
  }
}

void drawTriangle(const SetupTriangle& t, int tileX, int tileY, int extentX, int extentY, int bits,
                  SampleTile& out) {
  Span2 span = coveredSpan(t, tileX, tileY, extentX, extentY, bits);
  if (span.x0 > span.x1 || span.y0 > span.y1) return;
  span.x0 &= ~(kLanes - 1);
  const std::int64_t half = std::int64_t(1) << (bits - 1);
  const std::int64_t px = (std::int64_t(tileX + span.x0) << bits) + half;
  const std::int64_t py = (std::int64_t(tileY + span.y0) << bits) + half;
  drawSpan(span,
           {edgeFunction(t, 0, 1, px, py, bits), edgeFunction(t, 1, 2, px, py, bits),
            edgeFunction(t, 2, 0, px, py, bits)},
           depthPlane(t, px, py, double(1 << bits)), t.triangle, out);
}

/// Where the ray from `eye` along `d` meets a triangle (Moeller and Trumbore 1997), clamped to
/// the triangle: snapping may put a sample a hair outside.
Vec2 barycentricOf(const TriMesh& mesh, std::uint32_t triangle, const DVec3& eye, const DVec3& d,
                   bool& back) {
  const UVec3& t = mesh.triangles[triangle];
  const DVec3 p0(mesh.positions[t.x]);
  const DVec3 e1 = DVec3(mesh.positions[t.y]) - p0, e2 = DVec3(mesh.positions[t.z]) - p0;
  const DVec3 p = cross(d, e2), s = eye - p0;
  const double det = dot(e1, p);
  back = det < 0;
  const double scale = 1 / det;
  const DVec3 q = cross(s, e1);
  double b1 = dot(s, p) * scale, b2 = dot(d, q) * scale;
  if (!std::isfinite(b1) || !std::isfinite(b2)) return Vec2(1.0f / 3.0f);
  b1 = std::clamp(b1, 0.0, 1.0), b2 = std::clamp(b2, 0.0, 1.0);
  const double excess = std::max(1.0, b1 + b2);
  return {float(b1 / excess), float(b2 / excess)};
}

/// One triangle of a pixel while its samples are being counted.
struct Share {
  std::uint32_t triangle;
  int samples, sumX, sumY;
};

}  // namespace

struct Rasterizer::Impl {
  const TriMesh& mesh;
  Camera camera;
  CameraRays rays;
  int width, height, grid, tilePixels, tilesX, tilesY;
  Projection projection;
  Bins bins;
  std::unique_ptr<const Rasterizer> occluder;
  bool occluderWinsTies = false;

  Impl(const TriMesh& m, const Camera& c, int w, int h, int g)
      : mesh(m),
        camera(c),
        rays(c, w, h),
        width(w),
        height(h),
        grid(g),
        tilePixels(kTileSamples / g),
        tilesX((w + tilePixels - 1) / tilePixels),
        tilesY((h + tilePixels - 1) / tilePixels) {}

  void hide(std::size_t tile, SampleTile& samples) const;
  void gatherPixel(const SampleTile& samples, int x, int y, FragmentTile& out) const;
  Fragment fragment(const Share& share, int pixelX, int pixelY) const;
};

Rasterizer::Rasterizer(const TriMesh& mesh, const Camera& camera, int width, int height, int grid, Job& job,
                       const Occluder& occluder) {
  if (grid < 1 || grid > 16)
    throw ValueError("sample grid " + std::to_string(grid) + " is out of range", "renderer",
                     "use 1 to 16 a side");
  if (width < 1 || height < 1 || std::max(width, height) > 65536 / grid)
    throw ValueError("cannot draw " + std::to_string(width) + "x" + std::to_string(height) + " pixels with " +
                         std::to_string(grid) + "x" + std::to_string(grid) + " samples each",
                     "renderer", "keep size times samples within 65536 a side");
  impl_ = std::make_unique<Impl>(mesh, camera, width, height, grid);
  impl_->projection = Projection(camera, width * grid, height * grid);
  impl_->bins = raster::binTriangles(mesh, impl_->projection, impl_->tilePixels * grid, impl_->tilesX,
                                     impl_->tilesY, job);
  if (!occluder.mesh) return;
  impl_->occluder = std::make_unique<const Rasterizer>(*occluder.mesh, camera, width, height, grid, job);
  impl_->occluderWinsTies = occluder.winsTies;
}

Rasterizer::~Rasterizer() = default;

std::size_t Rasterizer::tileCount() const {
  return std::size_t(impl_->tilesX) * impl_->tilesY;
}

void Rasterizer::drawSamples(std::size_t tile, SampleTile& out) const {
  const Impl& r = *impl_;
  out.x = int(tile % r.tilesX) * r.tilePixels;
  out.y = int(tile / r.tilesX) * r.tilePixels;
  out.width = std::min(r.tilePixels, r.width - out.x);
  out.height = std::min(r.tilePixels, r.height - out.y);
  out.stride = kTileSamples;
  const int extentX = out.width * r.grid, extentY = out.height * r.grid;
  out.triangle.assign(std::size_t(extentY) * kTileSamples, kNoTriangle);
  out.nearness.assign(std::size_t(extentY) * kTileSamples, 0.0f);
  for (const raster::Chunk& chunk : r.bins.chunks)
    for (std::uint32_t i = chunk.first[tile]; i < chunk.first[tile + 1]; ++i)
      drawTriangle(chunk.triangles[chunk.items[i]], out.x * r.grid, out.y * r.grid, extentX, extentY,
                   r.projection.bits, out);
  if (r.occluder) r.hide(tile, out);
}

/// Forgets the samples where the occluder is nearer.
void Rasterizer::Impl::hide(std::size_t tile, SampleTile& samples) const {
  thread_local SampleTile other;
  occluder->drawSamples(tile, other);
  const Bins& theirs = occluder->impl_->bins;
  for (std::size_t i = 0; i < samples.triangle.size(); ++i) {
    if (samples.triangle[i] == kNoTriangle || other.triangle[i] == kNoTriangle) continue;
    const double mine = bins.distance(samples.nearness[i]), its = theirs.distance(other.nearness[i]);
    if (its < mine || (occluderWinsTies && its == mine))
      samples.triangle[i] = kNoTriangle, samples.nearness[i] = 0;
  }
}

Fragment Rasterizer::Impl::fragment(const Share& share, int pixelX, int pixelY) const {
  const float scale = 1.0f / float(grid * share.samples);
  const float dx = (float(share.sumX) + 0.5f * float(share.samples)) * scale;
  const float dy = (float(share.sumY) + 0.5f * float(share.samples)) * scale;
  Fragment f;
  f.triangle = share.triangle;
  f.samples = std::uint16_t(share.samples);
  const float x = float(pixelX) + dx, y = float(pixelY) + dy;
  const DVec3 d(rays.through(x, y));
  f.barycentric = barycentricOf(mesh, share.triangle, DVec3(rays.origin(x, y)), d, f.back);
  return f;
}

void Rasterizer::Impl::gatherPixel(const SampleTile& samples, int x, int y, FragmentTile& out) const {
  std::array<Share, 256> shares;
  int count = 0;
  for (int sy = 0; sy < grid; ++sy) {
    const std::uint32_t* row = samples.triangle.data() + std::size_t(y * grid + sy) * kTileSamples + x * grid;
    for (int sx = 0; sx < grid; ++sx) {
      if (row[sx] == kNoTriangle) continue;
      int k = count - 1;
      while (k >= 0 && shares[k].triangle != row[sx]) --k;
      if (k < 0) shares[k = count++] = {row[sx], 0, 0, 0};
      shares[k].samples += 1, shares[k].sumX += sx, shares[k].sumY += sy;
    }
  }
  for (int k = 0; k < count; ++k) out.fragments.push_back(fragment(shares[k], out.x + x, out.y + y));
}

void Rasterizer::drawFragments(std::size_t tile, SampleTile& samples, FragmentTile& out) const {
  drawSamples(tile, samples);
  out.x = samples.x, out.y = samples.y, out.width = samples.width, out.height = samples.height;
  out.first.clear();
  out.first.reserve(std::size_t(out.width) * out.height + 1);
  out.fragments.clear();
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      out.first.push_back(std::uint32_t(out.fragments.size()));
      impl_->gatherPixel(samples, x, y, out);
    }
  out.first.push_back(std::uint32_t(out.fragments.size()));
}

FragmentImage rasterize(const TriMesh& mesh, const Camera& camera, int width, int height, int grid, Job& job,
                        const Occluder& occluder) {
  const Rasterizer rasterizer(mesh, camera, width, height, grid, job, occluder);
  FragmentImage image{width, height, grid, std::vector<FragmentTile>(rasterizer.tileCount())};
  parallelFor(job, 0, image.tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    thread_local SampleTile samples;
    for (std::size_t tile = begin; tile < end; ++tile)
      rasterizer.drawFragments(tile, samples, image.tiles[tile]);
  });
  return image;
}

}  // namespace prt
