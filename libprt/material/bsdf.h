#pragma once
// Evaluates and samples the BRDF of a Material: Lambert, normalised modified Phong, and their sum.
//
// Directions are unit, in the local frame (z = shading normal), and point away from the surface: `in` to
// where light comes from, `out` to the viewer. f is without the cosine, reciprocal, and 0 when either
// direction is below the surface; a two-sided material mirrors both instead when `out` is below.
// Phong: Lewis 1994, "Making Shaders More Physically Plausible"; Lafortune and Willems 1994.

#include "libprt/core/math.h"
#include "libprt/material/material.h"

namespace prt {

/// f(in, out), per steradian.
Rgb evalBrdf(const Material& material, const Vec3& in, const Vec3& out);

/// Share of light reflected into all directions when it comes from `out` (equally: what a viewer at `out`
/// sees under a constant sky of 1). Integral of f cos; exact to about 1e-6.
Rgb directionalAlbedo(const Material& material, const Vec3& out);

struct BrdfSample {
  Vec3 in{0, 0, 1};
  Rgb weight{0};  ///< f * cos(in) / pdf; 0 when the direction fell below the surface
  float pdf = 0;  ///< per solid angle; 0 = nothing is reflected from here
};

/// A direction drawn about in proportion to f cos: one lobe is chosen with `uLobe`, a direction with `u`,
/// the density is that of the mixture. All numbers in [0, 1).
BrdfSample sampleBrdf(const Material& material, const Vec3& out, const Vec2& u, float uLobe);

/// Density of sampleBrdf, over the whole sphere: a Phong lobe reaches below the surface, where f is 0.
/// It integrates to 1, or is 0 everywhere when `out` sees nothing reflected.
float pdfBrdf(const Material& material, const Vec3& in, const Vec3& out);

}  // namespace prt
