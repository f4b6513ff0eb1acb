#pragma once
// Radiance transfer textures made from formulas, without baking.

#include "libprt/meso/rtt.h"

#include <cmath>
#include <functional>

namespace prt::test {

/// One view, one band: a picture. `grey` of (u, v) in 0..1.
inline Rtt pictureTable(int texels, const std::function<double(double u, double v)>& grey) {
  Rtt rtt(texels, 1, 1, 1);
  for (int v = 0; v < texels; ++v)
    for (int u = 0; u < texels; ++u)
      rtt.block(u, v, 0)[0] = float(grey((u + 0.5) / texels, (v + 0.5) / texels));
  return rtt;
}

/// No two places alike.
inline Rtt wavesTable(int texels) {
  return pictureTable(texels, [](double u, double v) {
    const double a = 2 * kPi * u, b = 2 * kPi * v;
    return 1 + 0.4 * std::sin(a + 0.4) * std::cos(b) + 0.3 * std::cos(2 * a - b) + 0.2 * std::sin(3 * b + a);
  });
}

/// The same from row to row and every third of the width.
inline Rtt stripesTable(int texels) {
  return pictureTable(texels, [](double u, double) { return 1 + 0.5 * std::cos(6 * kPi * u); });
}

/// Alike after a quarter turn: a checkerboard of soft bumps, two a side.
inline Rtt boardTable(int texels) {
  return pictureTable(
      texels, [](double u, double v) { return 1 + 0.5 * std::sin(4 * kPi * u) * std::sin(4 * kPi * v); });
}

}  // namespace prt::test
