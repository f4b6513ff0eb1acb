#pragma once
// Light as spherical-harmonic coefficients: what the shader takes in place of an environment map.

#include "exported.h"

#include <functional>
#include <vector>

/// Y(0,0) .. Y(bands-1, bands-1) in a unit direction, bands^2 values. Real, orthonormal, index l(l+1)+m, no
/// Condon-Shortley sign: Y(1,-1..1) is sqrt(3/4pi) times (y, z, x).
std::vector<float> shBasis(int bands, const Vec3& direction);

/// Coefficients [bands^2] of radiance that arrives from each direction (+Y up, -Z ahead): the integral of
/// radiance times Y over the sphere, here by the midpoint rule on a lat-long grid.
std::vector<Vec3> projectLight(int bands, const std::function<Vec3(const Vec3& from)>& radiance);
