#pragma once
// Rotation of spherical-harmonic functions. Active: the rotated function is f'(w) = f(R^-1 w), its
// coefficients c' = D(R) c, and y(R w) = D(R) y(w). D is orthogonal, one block per band, and
// D(R1 R2) = D(R1) D(R2).
// Source: Ivanic and Ruedenberg 1996, recursion over bands, with the corrections of 1998 and one more: the
// factor of V for m < 0 is sqrt(1 + delta(m,-1)); with the printed sign D is not even orthogonal.

#include "libprt/basis/sh.h"
#include "libprt/basis/sh_turns.h"
#include "libprt/core/math.h"

#include <cstddef>
#include <span>
#include <vector>

namespace prt {

/// D(R) of all bands; about a microsecond for 5. Error 3e-14 up to 33 bands, 5e-11 at 65.
class ShRotation {
 public:
  /// Throws ValueError unless the matrix is a rotation (orthonormal to 1e-3, determinant +1). What is left
  /// of rounding is removed first, so a float matrix gives D orthogonal in double.
  ShRotation(int bands, const glm::dmat3& rotation);
  ShRotation(int bands, const Mat3& rotation) : ShRotation(bands, glm::dmat3(rotation)) {}

  int bands() const { return bands_; }
  /// Block of band l, (2l+1) x (2l+1), row-major: element (m + l) * (2l+1) + k + l takes order k to order m.
  std::span<const double> block(int l) const;

  /// to = D from, for vectors of shCount(bands()) coefficients; they must not overlap. std::length_error when
  /// a span is shorter.
  void apply(std::span<const float> from, std::span<float> to) const;
  void apply(std::span<const double> from, std::span<double> to) const;
  void apply(std::span<const Rgb> from, std::span<Rgb> to) const;
  /// Throws ValueError when the light has more bands than this rotation; fewer are fine.
  ShRgb apply(const ShRgb& light) const;

 private:
  int bands_;
  std::vector<double> blocks_;
};

/// to = D(R) from, the same as ShRotation::apply() to rounding, for one or two vectors only: nothing is made
/// first (sh_turns.h). About a tenth of the
/// time of ShRotation's making at 9 bands. It is taken to be a rotation, unchecked: what rounding left skewed
/// is not mended, only the lengths are. `to` may be `from`. Throws ValueError for more than kMaxShOnceBands.
void rotateShOnce(int bands, const glm::dmat3& rotation, std::span<const double> from, std::span<double> to);

/// Rotation by `angle` (radians, counter-clockwise) about +z, in place: 2 n^2 multiplications.
void rotateShAboutZ(int bands, double angle, std::span<float> coefficients);
void rotateShAboutZ(int bands, double angle, std::span<double> coefficients);

}  // namespace prt
