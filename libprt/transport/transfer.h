#pragma once
// Precomputed transfer: the stored product and how it is applied to light.
// Conventions: object frame on both sides; T maps light coefficients (columns) to transferred incident
// radiance (rows). Cosine and the receiver's own albedo are not in T; a diffuse vector e holds the
// cosine, dot(e, L) = irradiance, and belongs to its sample's shading normal.
// Sources: Sloan 2002 and 2003 section 4.1; Lehtinen's course notes for the bounces.

#include "libprt/basis/sh.h"
#include "libprt/core/array.h"
#include "libprt/core/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// What is stored per sample, cheapest first.
enum class TransferForm {
  None,        ///< nothing: no shadows, no bounces; light arrives unchanged
  Diffuse,     ///< bands^2 irradiance coefficients (x3 when bounces are coloured)
  Visibility,  ///< (2*bands-1)^2 coefficients of the visibility function: shadows only, exact T_0
  Matrix       ///< bands^2 x bands^2 (x3 when bounces are coloured)
};

/// The product of the transfer stage. Immutable once shared.
struct Transfer {
  TransferForm form = TransferForm::None;
  int bands = 5;
  int channels = 1;         ///< 3 when bounces carry colour
  std::size_t samples = 0;
  /// Diffuse: [S, n^2] or [S, n^2, 3]; Visibility: [S, (2n-1)^2]; Matrix: [S, n^2, n^2] or
  /// [S, n^2, n^2, 3], row = transferred, column = light. f32 or f16.
  Array values;
  int raysPerSample = 0;    ///< rays gathered so far
  int raysWanted = 0;       ///< final when raysPerSample == raysWanted
  int bounces = 0;

  bool final() const { return raysPerSample >= raysWanted; }
  int functions() const { return bands * bands; }
};

/// Irradiance at each sample, [S]. `normals` (shading normals, [S]) serve the forms that do not hold
/// the cosine (None, Visibility, Matrix: E = sum of A_l Y_lm(n) (T L)_lm).
std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals);
/// The same at some samples only, in the order of `samples` (`normals` is still [S]).
std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals,
                            std::span<const std::uint32_t> samples);

/// Transferred incident radiance of every sample, object frame: result[s * n^2 + i]. Not for the
/// Diffuse form (throws ValueError).
std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light);
/// The same at some samples only: result[i * n^2 + k] for samples[i]. A picture needs only what it shows.
std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light,
                                     std::span<const std::uint32_t> samples);

}  // namespace prt
