#pragma once
// A rotation of spherical harmonics taken apart into turns about z, a quarter turn about x and its reverse:
// R = Rz(a) Ry(b) Rz(c) with Ry(b) = Q Rz(b) Q^-1. Nothing is made first, so it is what to use where a
// rotation turns one vector or a few; all steps are written for numbers or vectors of numbers, so that eight
// rotations can be done at a time. rotateShOnce() in sh_rotation.h is the plain way in.

#include "libprt/basis/sh.h"
#include "libprt/core/math.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace prt {

inline constexpr int kMaxShOnceBands = 33;

/// Cosines and sines of the three angles; V is a number or a vector of numbers.
template <class V>
struct ShTurns {
  struct Turn {
    V cosine, sine;
  };
  Turn a, b, c;
};

/// Of a rotation whose columns are where the axes go; the lengths of the columns do not matter.
ShTurns<double> shTurns(const glm::dmat3& rotation);

/// D of the quarter turn about x that takes z to y. Half of its elements are zero; they are left out.
class ShQuarterTurn {
 public:
  static const ShQuarterTurn& instance();

  /// to = D from; they must not overlap.
  template <class V>
  void forward(int bands, const V* from, V* to) const {
    for (int i = 0; i < shCount(bands); ++i) {
      V sum{};
      for (std::size_t e = rows_[std::size_t(i)]; e < rows_[std::size_t(i) + 1]; ++e)
        sum += valueFor<V>(elements_[e]) * from[elements_[e].column];
      to[i] = sum;
    }
  }
  /// to = D^-1 from, D being orthogonal.
  template <class V>
  void back(int bands, const V* from, V* to) const {
    for (int i = 0; i < shCount(bands); ++i) to[i] = V{};
    for (int i = 0; i < shCount(bands); ++i)
      for (std::size_t e = rows_[std::size_t(i)]; e < rows_[std::size_t(i) + 1]; ++e)
        to[elements_[e].column] += valueFor<V>(elements_[e]) * from[i];
  }

 private:
  struct Element {
    double value;
    float rounded;
    int column;
  };
  ShQuarterTurn();
  template <class V>
  static auto valueFor(const Element& e) {
    if constexpr (std::is_same_v<V, double>)
      return e.value;
    else
      return e.rounded;
  }

  std::vector<Element> elements_;
  std::array<std::size_t, shCount(kMaxShOnceBands) + 1> rows_{};
};

/// Turns about z, in place.
template <class V>
void turnShAboutZ(int bands, const typename ShTurns<V>::Turn& turn, V* c) {
  typename ShTurns<V>::Turn multiple = turn;
  for (int m = 1; m < bands; ++m) {
    for (int l = m; l < bands; ++l) {
      V &plus = c[shIndex(l, m)], &minus = c[shIndex(l, -m)];
      const V p = plus, q = minus;
      plus = multiple.cosine * p - multiple.sine * q;
      minus = multiple.sine * p + multiple.cosine * q;
    }
    multiple = {multiple.cosine * turn.cosine - multiple.sine * turn.sine,
                multiple.sine * turn.cosine + multiple.cosine * turn.sine};
  }
}

/// c = D(R) c; `scratch` holds as many.
template <class V>
void turnSh(int bands, const ShTurns<V>& turns, V* c, V* scratch) {
  const ShQuarterTurn& quarter = ShQuarterTurn::instance();
  turnShAboutZ(bands, turns.c, c);
  quarter.back(bands, c, scratch);
  turnShAboutZ(bands, turns.b, scratch);
  quarter.forward(bands, scratch, c);
  turnShAboutZ(bands, turns.a, c);
}

}  // namespace prt
