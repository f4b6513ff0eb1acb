#include "libprt/meso/rtt.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

void requireRange(const char* path, int value, int low, int high) {
  if (value < low || value > high)
    throw ValueError(std::to_string(value) + " is out of range", path,
                     "use " + std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

Rtt::Rtt(int t, int v, int b, int c) : texels(t), views(v), bands(b), channels(c) {
  requireRange("rtt.texels", t, 1, 1024);
  requireRange("rtt.views", v, 1, 32);
  requireRange("rtt.bands", b, 1, 10);
  values.assign(std::size_t(t) * std::size_t(t) * std::size_t(viewCount()) * blockSize(), 0.0f);
}

std::pair<int, int> Rtt::texelAt(const Vec2& uv) const {
  const Vec2 place = (uv - floor(uv)) * float(texels);
  return {std::min(int(place.x), texels - 1), std::min(int(place.y), texels - 1)};
}

Rgb Rtt::exitRadiance(int u, int v, int view, const ShRgb& light) const {
  const float* b = block(u, v, view);
  const std::size_t n = std::min(std::size_t(functions()), light.c.size());
  Rgb sum(0);
  for (std::size_t k = 0; k < n; ++k)
    sum += (channels == 3 ? Rgb(b[3 * k], b[3 * k + 1], b[3 * k + 2]) : Rgb(b[k])) * light.c[k];
  return sum * colour;
}

Rgb Rtt::exitRadiance(int u, int v, const Vec3& view, const ShRgb& light) const {
  Rgb sum(0);
  for (const ViewSquare::Corner& corner : ViewSquare(views).bilinear(view))
    if (corner.weight > 0) sum += corner.weight * exitRadiance(u, v, corner.index, light);
  return sum;
}

void Rtt::response(int u, int v, const Vec3& view, std::span<Rgb> out) const {
  std::fill(out.begin(), out.end(), Rgb(0));
  for (const ViewSquare::Corner& corner : ViewSquare(views).bilinear(view)) {
    if (corner.weight == 0) continue;
    const float* b = block(u, v, corner.index);
    for (std::size_t k = 0; k < std::size_t(functions()); ++k)
      out[k] +=
          corner.weight * colour * (channels == 3 ? Rgb(b[3 * k], b[3 * k + 1], b[3 * k + 2]) : Rgb(b[k]));
  }
}

Array Rtt::array() const {
  std::vector<std::int64_t> shape{texels, texels, views, views, functions()};
  const bool grey = colour.x == colour.y && colour.y == colour.z;
  if (channels == 1 && grey) {
    std::vector<float> scaled(values);
    for (float& x : scaled) x *= colour.x;
    return Array::from<float>(std::span<const float>(scaled), std::move(shape));
  }
  shape.push_back(3);
  std::vector<float> spread(values.size() / std::size_t(channels) * 3);
  for (std::size_t i = 0; i < spread.size(); ++i)
    spread[i] = colour[int(i % 3)] * values[channels == 3 ? i : i / 3];
  return Array::from<float>(std::span<const float>(spread), std::move(shape));
}

Image previewImage(const Rtt& rtt, const Vec3& view, const ShRgb& light, int zoom) {
  Image image(rtt.texels * zoom, rtt.texels * zoom, 3);
  for (int v = 0; v < rtt.texels; ++v)
    for (int u = 0; u < rtt.texels; ++u) {
      const Rgb c = max(Rgb(0), rtt.exitRadiance(u, v, view, light));
      for (int j = 0; j < zoom; ++j)
        for (int i = 0; i < zoom; ++i)
          std::copy_n(&c.x, 3, image.pixel(u * zoom + i, (rtt.texels - 1 - v) * zoom + j));
    }
  return image;
}

double relativeDifference(const Rtt& a, const Rtt& b, int view) {
  if (a.texels != b.texels || a.views != b.views || a.bands != b.bands)
    throw ValueError("cannot compare tables of different sizes", "rtt", "bake them alike");
  double difference = 0, size = 0;
  for (int t = 0; t < a.texels * a.texels; ++t)
    for (int w = 0; w < a.viewCount(); ++w) {
      if (view >= 0 && w != view) continue;
      const float *p = a.block(t % a.texels, t / a.texels, w), *q = b.block(t % a.texels, t / a.texels, w);
      for (int k = 0; k < a.functions(); ++k)
        for (int c = 0; c < 3; ++c) {
          const double x = double(a.colour[c]) * p[k * a.channels + c % a.channels];
          const double y = double(b.colour[c]) * q[k * b.channels + c % b.channels];
          difference += (x - y) * (x - y), size += y * y;
        }
    }
  return size > 0 ? std::sqrt(difference / size) : std::sqrt(difference);
}

}  // namespace prt
