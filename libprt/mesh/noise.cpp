#include "libprt/mesh/noise.h"

namespace prt {
namespace {

std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Dot product of an offset with the lattice point's gradient, one of the twelve edge directions of a cube.
float corner(int x, int y, int z, std::uint32_t seed, const Vec3& offset) {
  static constexpr float g[12][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                     {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                     {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};
  const std::uint32_t h =
      hashed(std::uint32_t(x) + hashed(std::uint32_t(y) + hashed(std::uint32_t(z) + hashed(seed)))) % 12;
  return g[h][0] * offset.x + g[h][1] * offset.y + g[h][2] * offset.z;
}

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

float gradientNoise(const Vec3& p, std::uint32_t seed) {
  const Vec3 base = floor(p), f = p - base;
  const int x = int(base.x), y = int(base.y), z = int(base.z);
  const Vec3 w(fade(f.x), fade(f.y), fade(f.z));
  float value[8];
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = (i >> 1) & 1, dz = i >> 2;
    value[i] = corner(x + dx, y + dy, z + dz, seed, f - Vec3(dx, dy, dz));
  }
  const auto lerp = [](float a, float b, float t) { return a + t * (b - a); };
  const float near = lerp(lerp(value[0], value[1], w.x), lerp(value[2], value[3], w.x), w.y);
  const float far = lerp(lerp(value[4], value[5], w.x), lerp(value[6], value[7], w.x), w.y);
  return lerp(near, far, w.z);
}

float fractalNoise(const Vec3& p, int octaves, std::uint32_t seed) {
  float sum = 0, height = 1, frequency = 1;
  for (int i = 0; i < octaves; ++i, height *= 0.5f, frequency *= 2)
    sum += height * gradientNoise(frequency * p, seed + std::uint32_t(i));
  return sum;
}

float ridgedNoise(const Vec3& p, int octaves, std::uint32_t seed) {
  float sum = 0, height = 1, frequency = 1;
  for (int i = 0; i < octaves; ++i, height *= 0.5f, frequency *= 2) {
    const float ridge = 1 - std::abs(gradientNoise(frequency * p, seed + std::uint32_t(i)));
    sum += height * ridge * ridge;
  }
  return sum;
}

}  // namespace prt
