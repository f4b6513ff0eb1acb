#include "libprt/shade/live_background.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr int kLanes = 8;
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

}  // namespace

LiveBackground::LiveBackground(const EnvironmentMap& map, float rotation, float intensity,
                               const Camera& camera, int width, int height)
    : pixels_(map.pixels()),
      rays_(camera, width, height),
      turns_(rotation / (2 * kPiF)),
      intensity_(intensity) {}

void LiveBackground::row(int x, int y, std::span<Rgb> out) const {
  const Vec3 begin = rays_.background(float(x) + 0.5f, float(y) + 0.5f),
             step = rays_.background(float(x) + 1.5f, float(y) + 0.5f) - begin;
  const Floats counting{0, 1, 2, 3, 4, 5, 6, 7};
  for (std::size_t i = 0; i < out.size(); i += kLanes) {
    const Floats at = counting + float(i);
    const Floats dx = begin.x + at * step.x, dy = begin.y + at * step.y, dz = begin.z + at * step.z;
    const Floats u = arcTangent(dx, -dz) * (1 / (2 * kPiF)) + (0.5f + turns_);
    const Floats v = arcTangent(root(dx * dx + dz * dz), dy) * (1 / kPiF);
    for (std::size_t lane = 0; lane < std::min<std::size_t>(kLanes, out.size() - i); ++lane)
      out[i + lane] = texel(u[lane], v[lane]);
  }
}

// Bilinear; around in u, held at the poles.
Rgb LiveBackground::texel(float u, float v) const {
  const float px = (u - std::floor(u)) * float(pixels_.width) - 0.5f, py = v * float(pixels_.height) - 0.5f;
  const int x = int(std::floor(px)), y = int(std::floor(py));
  const float fx = px - float(x), fy = py - float(y);
  const int x0 = x < 0 ? pixels_.width - 1 : x, x1 = x + 1 < pixels_.width ? x + 1 : 0;
  const int y0 = std::clamp(y, 0, pixels_.height - 1), y1 = std::clamp(y + 1, 0, pixels_.height - 1);
  const auto rgb = [&](int column, int row) {
    const float* p = pixels_.pixel(column, row);
    return Rgb(p[0], p[1], p[2]);
  };
  const Rgb above = (1 - fx) * rgb(x0, y0) + fx * rgb(x1, y0),
            below = (1 - fx) * rgb(x0, y1) + fx * rgb(x1, y1);
  return intensity_ * ((1 - fy) * above + fy * below);
}

}  // namespace prt
