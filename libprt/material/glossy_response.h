#pragma once
// The final bounce: exit radiance as a dot product of incident radiance, in spherical harmonics, with the
// response of the BRDF towards the viewer, O_k(v) = integral over the hemisphere of f(in, v) cos(in) Y_k(in)
// (Kautz, Sloan and Snyder 2002, "Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical
// Harmonics"). The horizon clips the lobe exactly; with a constant sky of 1 the result is the directional
// albedo.

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"
#include "libprt/material/material.h"

#include <span>
#include <vector>

namespace prt {

/// Most bands that a GlossyResponse takes.
inline constexpr int kMaxResponseBands = 16;

/// Response of the Phong lobe of specular colour 1 in the local frame (z = normal), for a viewer in the xz
/// half-plane x >= 0 at polar angle `viewAngle` (0 .. pi/2). In SH order; only m >= 0 is not zero.
/// Quadrature in polar coordinates about the lobe, cut where the horizon cuts it: error below 1e-7 for
/// exponents 1 .. 10 000 and up to 16 bands.
std::vector<double> phongResponse(double exponent, double viewAngle, int bands);

/// Response of a white Lambert surface, in the frame `normal` is given in: A_l/pi Y_lm(normal), exact.
void lambertResponse(int bands, const Vec3& normal, std::span<float> out);

/// phongResponse for all view angles, ready to be evaluated per pixel in any frame. Made anew when the
/// exponent changes (a few milliseconds for 5 bands).
///
/// In band l the response is even about the viewing plane, a space of l+1 dimensions that zonal harmonics
/// about directions of that plane span. The table holds the weights of such lobes at fixed angles to the
/// normal, so that turning the response means evaluating Y in a few turned directions: no rotation
/// matrices (Nowrouzezahrai, Simari and Fiume 2012, "Sparse Zonal Harmonic Factorization").
class GlossyResponse {
 public:
  /// Throws ValueError unless exponent is 1 .. 10 000 and bands 1 .. kMaxResponseBands.
  GlossyResponse(float exponent, int bands);

  float exponent() const { return exponent_; }
  int bands() const { return bands_; }

  /// Response towards `view` of a surface with unit normal `normal`, both in the frame that `out`, of
  /// shCount(bands) values, is then given in. Specular colour 1. A view below the horizon counts as on it.
  void evaluate(const Vec3& normal, const Vec3& view, std::span<float> out) const;

  /// Sine and cosine of each lobe's angle to the normal, in the viewing plane towards the viewer, [bands].
  std::span<const Vec2> lobes() const { return lobes_; }
  /// Weight of lobe j in band l at a view angle (0 .. pi/2), out[l * bands + j]: for renderers that keep
  /// tables of their own.
  void weightsAt(float viewAngle, std::span<float> out) const;

 private:
  float exponent_;
  int bands_;
  std::vector<Vec2> lobes_;   // sine and cosine of each lobe's angle to the normal
  std::vector<float> table_;  // [angles, bands, bands]: weight of lobe j in band l
};

/// Exit radiance towards `view`. `incident` holds shCount(bands) coefficients of incident radiance (shadowed,
/// cosine not in it) in the frame of `normal` and `view`; `glossy` was made for the material's exponent
/// and these bands, and may be null when the material is not glossy.
Rgb exitRadiance(const Material& material, const GlossyResponse* glossy, const Vec3& normal, const Vec3& view,
                 std::span<const Rgb> incident);

}  // namespace prt
