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
  int channels = 1;  ///< 3 when bounces carry colour
  std::size_t samples = 0;
  /// f32 or f16, with n = bands. None: empty. Diffuse: [S, n^2], or [S, n^2, 3]. Visibility: [S, (2n-1)^2].
  /// Matrix: [S, channels, n^2, n^2] by columns: element ((s * channels + c) * n^2 + light) * n^2 +
  /// transferred. So that applying it reads memory once, in order; expandedMatrices() gives rows first.
  Array values;
  /// Matrix, clustered (cluster_transfer.h): `values` are weights [S, terms] f16, `cluster` [S] u32 says
  /// whose, and `basis` [clusters, terms + 1, channels, n^2, n^2] f16 holds means and terms, by columns. Else
  /// both are empty.
  Array cluster, basis;
  /// Visibility and Matrix: the diffuse vectors as well, [S, n^2] or [S, n^2, 3] f32. They are estimated with
  /// the cosine inside, where T would cut it (times the light) off after n bands.
  Array diffuse;
  /// With bounces: [V, n^2] or [V, n^2, 3] f32, irradiance vectors of all bounces but the last at the
  /// vertices of the scene, or the texels, and their backs: what the last bounce gathered from. Any other set
  /// of points gathers its bounces from it too.
  Array surface;
  int raysPerSample = 0;  ///< rays gathered so far
  int raysWanted = 0;     ///< final when raysPerSample == raysWanted
  int bounces = 0;        ///< bounces in it; fewer than asked for when the rest would not show
  /// Relative Frobenius norm of what rounding `values` to their storage type changed; 0 for f32.
  double storageError = 0;

  bool final() const { return raysPerSample >= raysWanted; }
  int functions() const { return bands * bands; }
  bool clustered() const { return !basis.bytes.empty(); }
  /// Of what applying it reads.
  std::size_t bytes() const { return values.bytes.size() + cluster.bytes.size() + basis.bytes.size(); }
};

/// Irradiance at each sample, [S]. `normals` (shading normals, [S]) serve the form that does not hold the
/// cosine (None: E = sum of A_l Y_lm(n) L_lm); others ignore them. Lights may have fewer or more bands than
/// the transfer: what one of them lacks counts as zero.
std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals);
/// The same at some samples only, in the order of `samples` (`normals` is still [S]).
std::vector<Rgb> irradiance(const Transfer& transfer, const ShRgb& light, std::span<const Vec3> normals,
                            std::span<const std::uint32_t> samples);

/// Transferred incident radiance of every sample, object frame: result[s * n^2 + i]. Not for the
/// Diffuse form (throws ValueError).
std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light);
/// The same into memory of the caller's, [S * n^2], every element of which is written: for light that
/// moves every frame, where fresh memory costs more than the product. Throws ValueError on another size.
void transferredRadiance(const Transfer& transfer, const ShRgb& light, std::span<Rgb> result);
/// The same at some samples only: result[i * n^2 + k] for samples[i]. A picture needs only what it shows.
std::vector<Rgb> transferredRadiance(const Transfer& transfer, const ShRgb& light,
                                     std::span<const std::uint32_t> samples);

/// Dense matrices as f32, [S, n^2, n^2] or [S, n^2, n^2, 3], row = transferred, column = light; the
/// Visibility form is expanded, None gives identities. Throws ValueError for the Diffuse form, ResourceError
/// when they would not fit in memory.
Array expandedMatrices(const Transfer& transfer);
/// The form Matrix: one sample's, [channels, light, transferred], as it is stored or put together.
void matrixOf(const Transfer& transfer, std::size_t sample, std::span<float> out);
/// Irradiance vectors as f32, [S, n^2] or [S, n^2, 3], for every form that holds them (not None: ValueError).
Array diffuseVectors(const Transfer& transfer);

/// The reverse of expandedMatrices() for the Matrix form: Transfer::values from [S, n^2, n^2] floats, or
/// [S, n^2, n^2, 3] with 3 channels, stored as f32 or f16.
Array packedMatrices(std::span<const float> matrices, std::size_t samples, int channels, int bands,
                     DType storage);

}  // namespace prt
