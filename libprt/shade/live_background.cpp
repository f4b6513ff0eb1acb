#include "libprt/shade/live_background.h"

#include "libprt/core/warp.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr int kLanes = 8;
constexpr float kSmallestRim = 1e-4f;  // sine; a light of 180 degrees has none
using Floats [[gnu::vector_size(4 * kLanes)]] = float;
using Ints [[gnu::vector_size(4 * kLanes)]] = int;

Floats magnitude(Floats v) {
  return v < 0 ? -v : v;
}

/// Error below 1e-6. Polynomial through the Chebyshev nodes of atan(sqrt s) / sqrt s, 0 <= s <= 1.
Floats arcTangent(Floats y, Floats x) {
  const Floats ax = magnitude(x), ay = magnitude(y);
  const Ints steep = ay > ax;
  const Floats high = steep ? ay : ax, low = steep ? ax : ay;
  const Floats t = low / (high > 0 ? high : Floats{} + 1.0f), s = t * t;
  constexpr float c[] = {9.999998820e-01f, -3.333181266e-01f, 1.996696183e-01f, -1.400329018e-01f,
                         9.868865458e-02f, -5.882975314e-02f, 2.378051860e-02f, -4.559791986e-03f};
  Floats p = Floats{} + c[7];
  for (int i = 6; i >= 0; --i) p = p * s + c[i];
  Floats angle = p * t;
  angle = steep ? 0.5f * kPiF - angle : angle;
  angle = x < 0 ? kPiF - angle : angle;
  return y < 0 ? -angle : angle;
}

Floats root(Floats v) {
  Floats r;
  for (int i = 0; i < kLanes; ++i) r[i] = std::sqrt(v[i]);
  return r;
}

// The part of a pixel that the light's disc covers, by the distance of its centre to the rim; `pixel` is its
// angle. Distances as 1 - cosine, whose slope at the rim is the rim's sine.
Floats coverage(const CircleLight& light, const Floats (&d)[3], Floats inverse, Floats pixel) {
  const Floats x = d[0] * inverse - light.direction.x, y = d[1] * inverse - light.direction.y,
               z = d[2] * inverse - light.direction.z;
  const float sine = std::max(std::sin(light.halfAngle), kSmallestRim);
  const Floats part = (coneHeight(light.halfAngle) - 0.5f * (x * x + y * y + z * z)) / (sine * pixel) + 0.5f;
  const Floats most = part < 1 ? part : Floats{} + 1.0f;
  return most > 0 ? most : Floats{};
}

}  // namespace

LiveBackground::LiveBackground(const LiveSky& sky, const Camera& camera, int width, int height)
    : sky_(sky), rays_(camera, width, height), turns_(sky.rotation / (2 * kPiF)) {}

void LiveBackground::row(int x, int y, std::span<Rgb> out) const {
  const Vec3 begin = rays_.background(float(x) + 0.5f, float(y) + 0.5f),
             step = rays_.background(float(x) + 1.5f, float(y) + 0.5f) - begin;
  const Floats counting{0, 1, 2, 3, 4, 5, 6, 7};
  for (std::size_t i = 0; i < out.size(); i += kLanes) {
    const Floats at = counting + float(i);
    const Floats d[3] = {begin.x + at * step.x, begin.y + at * step.y, begin.z + at * step.z};
    const std::size_t lanes = std::min<std::size_t>(kLanes, out.size() - i);
    if (sky_.map) {
      const Floats u = arcTangent(d[0], -d[2]) * (1 / (2 * kPiF)) + (0.5f + turns_);
      const Floats v = arcTangent(root(d[0] * d[0] + d[2] * d[2]), d[1]) * (1 / kPiF);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        out[i + lane] = sky_.constant + texel(u[lane], v[lane]);
    } else {
      std::fill_n(out.begin() + std::ptrdiff_t(i), lanes, sky_.constant);
    }
    if (sky_.circles.empty()) continue;
    const Floats inverse = 1.0f / root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (const CircleLight& light : sky_.circles) {
      const Floats covered = coverage(light, d, inverse, length(step) * inverse);
      for (std::size_t lane = 0; lane < lanes; ++lane) out[i + lane] += covered[lane] * light.radiance;
    }
  }
}

// Bilinear; around in u, held at the poles.
Rgb LiveBackground::texel(float u, float v) const {
  const Image& pixels = sky_.map->pixels();
  const float px = (u - std::floor(u)) * float(pixels.width) - 0.5f, py = v * float(pixels.height) - 0.5f;
  const int x = int(std::floor(px)), y = int(std::floor(py));
  const float fx = px - float(x), fy = py - float(y);
  const int x0 = x < 0 ? pixels.width - 1 : x, x1 = x + 1 < pixels.width ? x + 1 : 0;
  const int y0 = std::clamp(y, 0, pixels.height - 1), y1 = std::clamp(y + 1, 0, pixels.height - 1);
  const auto rgb = [&](int column, int row) {
    const float* p = pixels.pixel(column, row);
    return Rgb(p[0], p[1], p[2]);
  };
  const Rgb above = (1 - fx) * rgb(x0, y0) + fx * rgb(x1, y0),
            below = (1 - fx) * rgb(x0, y1) + fx * rgb(x1, y1);
  return sky_.intensity * ((1 - fy) * above + fy * below);
}

}  // namespace prt
