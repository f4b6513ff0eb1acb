#pragma once
// Legendre polynomials, for zonal functions and quadrature.

#include <vector>

namespace prt {

/// P_l(t) and P_l'(t) for l = 0 .. count-1, |t| <= 1.
struct LegendreTable {
  std::vector<double> value;
  std::vector<double> slope;

  LegendreTable(int count, double t) : value(count), slope(count) {
    for (int l = 0; l < count; ++l) {
      value[l] = l == 0 ? 1 : l == 1 ? t : ((2 * l - 1) * t * value[l - 1] - (l - 1) * value[l - 2]) / l;
      slope[l] = l == 0 ? 0 : l == 1 ? 1 : slope[l - 2] + (2 * l - 1) * value[l - 1];
    }
  }
};

}  // namespace prt
