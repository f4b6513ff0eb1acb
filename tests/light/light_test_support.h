#pragma once
// What the tests of lights share.

#include "libprt/light/environment.h"

#include <functional>
#include <random>
#include <vector>

namespace prt::test {

/// A geometry of each mapping, about `cell` pixels per 90 degrees, in the order of the enumeration.
inline std::vector<MapGeometry> oneOfEach(int cell) {
  using M = EnvironmentMapping;
  return {{M::LatLong, 4 * cell, 2 * cell},         {M::VerticalCross, 3 * cell, 4 * cell},
          {M::HorizontalCross, 4 * cell, 3 * cell}, {M::AngularMap, 4 * cell, 4 * cell},
          {M::HorizontalStrip, 6 * cell, cell},     {M::VerticalStrip, cell, 6 * cell}};
}

inline void setPixel(Image& image, int x, int y, const Rgb& c) {
  for (int i = 0; i < 3; ++i) image.pixel(x, y)[i] = c[i];
}

/// The function's values at texel centres; `outside` where nothing is covered.
inline EnvironmentMap mapOf(const MapGeometry& g, const std::function<Rgb(const DVec3&)>& f,
                            Rgb outside = Rgb(0)) {
  Image image(g.width(), g.height(), 3);
  for (int y = 0; y < g.height(); ++y)
    for (int x = 0; x < g.width(); ++x) setPixel(image, x, y, g.covers(x, y) ? f(g.center(x, y)) : outside);
  return EnvironmentMap(image, g.mapping());
}

/// Random pixels, some of them `peak` times brighter.
inline EnvironmentMap randomMap(const MapGeometry& g, unsigned seed, float peak = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> level(0.1f, 1.0f);
  return mapOf(g, [&](const DVec3&) {
    const float red = level(random), green = level(random), blue = level(random),
                bright = level(random) < 0.15f ? peak : 1;
    return bright * Rgb(red, green, blue);
  });
}

inline DVec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  const double x = gauss(random), y = gauss(random), z = gauss(random);
  return normalize(DVec3(x, y, z));
}

/// Integral of the map's radiance over the sphere.
inline DVec3 energy(const EnvironmentMap& map) {
  DVec3 sum(0);
  map.forEachTexel(
      [&](int, int, const DVec3&, double solidAngle, const Rgb& c) { sum += solidAngle * DVec3(c); });
  return sum;
}

}  // namespace prt::test
