#include "libprt/shade/reference.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <string>
#include <utility>

namespace prt {
namespace {

constexpr int kPass = 16;
constexpr int kTile = 8;  // pixels a side: small enough to react to cancel quickly

}  // namespace

ReferenceImage::ReferenceImage(const PathTracer& tracer, const Camera& camera, int width, int height,
                               const PathOptions& options)
    : tracer_(tracer),
      camera_(camera),
      rays_(camera, std::max(width, 1), std::max(height, 1)),
      options_(options),
      width_(width),
      height_(height) {
  if (width < 1 || height < 1 || width > 65536 || height > 65536)
    throw ValueError("cannot draw " + std::to_string(width) + "x" + std::to_string(height) + " pixels",
                     "path tracer", "use 1 to 65536 a side");
  // Parallel rays see what is behind the eye too: they begin before the scene does.
  if (const Box3 box = tracer.scene().mesh.bounds(); camera.orthographic && !box.empty())
    behind_ = std::max(0.0f, dot(box.center() - camera.eye, camera.axes().normal) + 0.51f * box.diagonal());
  sums_.resize(std::size_t(width) * std::size_t(height));
}

void ReferenceImage::add(int samplesPerPixel, Job& job) {
  job.begin("path tracing", double(samplesPerPixel) * double(sums_.size()), "paths");
  for (int left = samplesPerPixel; left > 0; left -= kPass) addPass(std::min(left, kPass), job);
}

void ReferenceImage::addPass(int count, Job& job) {
  std::vector<Sum> sums = sums_;  // a cancelled pass leaves no trace
  const int tilesX = (width_ + kTile - 1) / kTile, tilesY = (height_ + kTile - 1) / kTile;
  parallelFor(job, 0, std::size_t(tilesX) * std::size_t(tilesY), 1, [&](std::size_t tile, std::size_t) {
    const int x0 = int(tile % std::size_t(tilesX)) * kTile, y0 = int(tile / std::size_t(tilesX)) * kTile;
    const int x1 = std::min(x0 + kTile, width_), y1 = std::min(y0 + kTile, height_);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        tracePixel(x, y, count, sums[std::size_t(y) * std::size_t(width_) + std::size_t(x)]);
    job.advance(double(x1 - x0) * (y1 - y0) * count);
  });
  sums_ = std::move(sums);
  samples_ += count;
}

void ReferenceImage::tracePixel(int x, int y, int count, Sum& sum) const {
  const std::uint64_t seed = hashBits(options_.seed, std::uint64_t(y) * 65536 + std::uint64_t(x), 1);
  for (int k = 0; k < count; ++k) {
    SobolStream stream(seed, std::uint32_t(samples_ + k));
    const Vec2 inside = stream.next2();
    const float px = float(x) + inside.x, py = float(y) + inside.y;
    const Vec3 along = rays_.direction(px, py);
    PathSample path = tracer_.trace({rays_.origin(px, py) - behind_ * along, 0, along}, options_, stream);
    if (!path.hit && camera_.orthographic)
      path.radiance = tracer_.lights().radiance(normalize(rays_.background(px, py)));
    const DVec3 value(path.radiance);
    sum.allSquares += value * value;
    if (path.hit)
      sum.surface += value, sum.surfaceSquares += value * value, sum.covered += 1;
    else
      sum.sky += value;
  }
}

Image ReferenceImage::radiance(bool background) const {
  Image image(width_, height_, 4);
  const double scale = samples_ > 0 ? 1.0 / samples_ : 0;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Sum& sum = sums_[i];
    const DVec3 value = scale * (background ? sum.surface + sum.sky : sum.surface);
    for (int c = 0; c < 3; ++c) image.data[4 * i + std::size_t(c)] = float(value[c]);
    image.data[4 * i + 3] = background ? 1.0f : float(scale * sum.covered);
  }
  return image;
}

Image ReferenceImage::standardError(bool background) const {
  Image image(width_, height_, 3);
  if (samples_ < 2) return image;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Sum& sum = sums_[i];
    const DVec3 mean = (background ? sum.surface + sum.sky : sum.surface) / double(samples_);
    const DVec3 squares = (background ? sum.allSquares : sum.surfaceSquares) / double(samples_);
    const DVec3 error = sqrt(max(squares - mean * mean, DVec3(0)) / double(samples_ - 1));
    for (int c = 0; c < 3; ++c) image.data[3 * i + std::size_t(c)] = float(error[c]);
  }
  return image;
}

}  // namespace prt
