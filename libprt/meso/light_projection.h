#pragma once
// From pictures under single lights to the response in a basis: equation (5) of Bi-Scale Radiance Transfer
// and what is better where lights are few. A picture I_k shows radiance under a directional light of
// irradiance 1 across its beam, so the cosine is in it. Both methods are one matrix, B = W I.

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"

#include <span>
#include <vector>

namespace prt {

/// Directions of lights over the upper hemisphere and the solid angle that each stands for.
struct LightSet {
  std::vector<Vec3> directions;     ///< unit, z > 0
  std::vector<double> solidAngles;  ///< [lights], 2 pi in all

  std::size_t size() const { return directions.size(); }
};

/// The paper's grid: `polar` x `azimuth` cells of equal angles, a light in the middle of each, with exact
/// cell areas (cos a - cos b) dphi. Light (i, j) is number i * azimuth + j.
LightSet lightGrid(int polar = 8, int azimuth = 16);

/// Any lights: each stands for the part of the hemisphere that is nearest to it. Throws ValueError when a
/// direction is not of length 1 or below the horizon, or there are none.
LightSet lightsAt(std::span<const Vec3> directions);

enum class LightFit {
  Quadrature,  ///< equation (5): B_i = sum I_k y_i(l_k) da_k
  Fit          ///< fit I / cos by the basis, smooth where lights leave gaps, then integrate that exactly
};

/// W, [bands^2, lights] row-major. Fit: c = (Y' W C Y + lambda G)^-1 Y' W I with C the cosines, W the solid
/// angles, G = l^2 (l+1)^2, then B = H c with H the cosine-weighted Gram matrix of the hemisphere (ALGORITHMS
/// 6.1). Throws ValueError for fewer than one light, bands not in 1..10.
std::vector<double> projectionMatrix(const LightSet& lights, int bands, LightFit fit, double lambda = 1e-6);

/// Integral over the upper hemisphere of cos Y_i Y_j, row-major.
std::vector<double> cosineGram(int bands);

/// Relative error that quadrature makes on unshadowed responses of a Lambert surface: |sum y_i cos da -
/// integral| / |integral|, the least that equation (5) can be wrong by.
double quadratureError(const LightSet& lights, int bands);

}  // namespace prt
