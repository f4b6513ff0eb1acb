#include "libprt/basis/sh_rotation.h"

#include "libprt/basis/sh_turns.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace prt {
namespace {

constexpr std::size_t blockOffset(int l) {
  return std::size_t(l) * (4 * l * l - 1) / 3;
}  // 1 + 9 + 25 + ...

/// Scalars u, v, w of the recursion are rows[m] * column[k]; they depend on nothing else.
struct Factors {
  struct Row {
    double u, v, w;
  };
  std::array<Row, shCount(kMaxShBands)> row;
  std::array<double, shCount(kMaxShBands)> column;

  Factors() {
    for (int l = 0; l < kMaxShBands; ++l)
      for (int m = -l; m <= l; ++m) {
        const double a = std::abs(m), zero = m == 0 ? 1 : 0;
        row[shIndex(l, m)] = {std::sqrt((l + a) * (l - a)),
                              0.5 * std::sqrt((1 + zero) * (l + a - 1) * (l + a)) * (1 - 2 * zero),
                              -0.5 * std::sqrt(std::max(0.0, (l - a - 1) * (l - a))) * (1 - zero)};
        const double d = std::abs(m) < l ? (l + a) * (l - a) : 2.0 * l * (2 * l - 1);
        column[shIndex(l, m)] = l > 0 ? 1 / std::sqrt(d) : 0;
      }
  }
};

const Factors& factors() {
  static const Factors instance;
  return instance;
}

/// One step of the recursion: band l from band l-1 and band 1. Names follow the paper.
class BandStep {
 public:
  BandStep(int l, const double* one, const double* before, double* out)
      : l_(l), one_(one), before_(before), out_(out) {}

  void run() const {
    for (int m = -l_; m <= l_; ++m) {
      const Factors::Row& f = factors().row[shIndex(l_, m)];
      for (int k = -l_; k <= l_; ++k) {
        // A term whose factor is zero may index outside of the band before: skip it.
        double sum = 0;
        if (f.u != 0) sum += f.u * p(0, m, k);
        if (f.v != 0) sum += f.v * v(m, k);
        if (f.w != 0) sum += f.w * w(m, k);
        out_[(m + l_) * (2 * l_ + 1) + k + l_] = sum * factors().column[shIndex(l_, k)];
      }
    }
  }

 private:
  double r(int i, int j) const { return one_[(i + 1) * 3 + j + 1]; }
  double before(int m, int k) const { return before_[(m + l_ - 1) * (2 * l_ - 1) + k + l_ - 1]; }

  double p(int i, int a, int k) const {
    if (k == l_) return r(i, 1) * before(a, l_ - 1) - r(i, -1) * before(a, 1 - l_);
    if (k == -l_) return r(i, 1) * before(a, 1 - l_) + r(i, -1) * before(a, l_ - 1);
    return r(i, 0) * before(a, k);
  }
  double v(int m, int k) const {
    constexpr double kRoot2 = 1.4142135623730951;
    if (m == 0) return p(1, 1, k) + p(-1, -1, k);
    if (m == 1) return kRoot2 * p(1, 0, k);
    if (m == -1) return kRoot2 * p(-1, 0, k);
    return m > 0 ? p(1, m - 1, k) - p(-1, 1 - m, k) : p(1, m + 1, k) + p(-1, -m - 1, k);
  }
  double w(int m, int k) const {
    return m > 0 ? p(1, m + 1, k) + p(-1, -m - 1, k) : p(1, m - 1, k) - p(-1, 1 - m, k);
  }

  int l_;
  const double *one_, *before_;
  double* out_;
};

void checkBands(int bands, int most) {
  if (bands < 1 || bands > most)
    throw ValueError("cannot use " + std::to_string(bands) + " bands", "rotation of spherical harmonics",
                     "use 1 to " + std::to_string(most));
}

glm::dmat3 checkedRotation(const glm::dmat3& m) {
  const glm::dmat3 gram = glm::transpose(m) * m;
  bool orthonormal = true;  // written so that NaN is refused
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) orthonormal = orthonormal && std::abs(gram[i][j] - (i == j)) < 1e-3;
  if (!orthonormal || glm::determinant(m) < 0)
    throw ValueError("the matrix is not a rotation", "rotation of spherical harmonics",
                     "give orthonormal, right-handed axes");
  const DVec3 x = glm::normalize(m[0]), y = glm::normalize(m[1] - glm::dot(m[1], x) * x);
  return {x, y, glm::cross(x, y)};
}

template <class T, class Sum>
void applyBlocks(int bands, const double* blocks, std::span<const T> from, std::span<T> to) {
  const std::size_t count = shCount(bands);
  if (from.size() < count || to.size() < count)
    throw std::length_error("rotation: a coefficient span is too short");
  for (int l = 0; l < bands; ++l) {
    const double* row = blocks + blockOffset(l);
    for (int m = -l; m <= l; ++m, row += 2 * l + 1) {
      Sum sum(0);
      for (int k = -l; k <= l; ++k) sum += Sum(from[shIndex(l, k)]) * row[k + l];
      to[shIndex(l, m)] = T(sum);
    }
  }
}

template <class T>
void rotateAboutZ(int bands, double angle, std::span<T> c) {
  if (c.size() < std::size_t(shCount(bands)))
    throw std::length_error("rotation: a coefficient span is too short");
  for (int m = 1; m < bands; ++m) {
    const double cosine = std::cos(m * angle), sine = std::sin(m * angle);
    for (int l = m; l < bands; ++l) {
      T &plus = c[shIndex(l, m)], &minus = c[shIndex(l, -m)];
      const double p = plus, q = minus;
      plus = T(cosine * p - sine * q);
      minus = T(sine * p + cosine * q);
    }
  }
}

}  // namespace

ShRotation::ShRotation(int bands, const glm::dmat3& rotation) : bands_(bands) {
  checkBands(bands, kMaxShBands);
  const glm::dmat3 r = checkedRotation(rotation);
  blocks_.resize(blockOffset(bands));
  blocks_[0] = 1;
  if (bands == 1) return;
  constexpr std::array<int, 3> kAxis{1, 2, 0};  // orders -1, 0, 1 are y, z, x
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) blocks_[1 + i * 3 + j] = r[kAxis[j]][kAxis[i]];
  for (int l = 2; l < bands; ++l)
    BandStep(l, blocks_.data() + 1, blocks_.data() + blockOffset(l - 1), blocks_.data() + blockOffset(l))
        .run();
}

std::span<const double> ShRotation::block(int l) const {
  return std::span(blocks_).subspan(blockOffset(l), std::size_t(2 * l + 1) * (2 * l + 1));
}

void ShRotation::apply(std::span<const float> from, std::span<float> to) const {
  applyBlocks<float, double>(bands_, blocks_.data(), from, to);
}

void ShRotation::apply(std::span<const double> from, std::span<double> to) const {
  applyBlocks<double, double>(bands_, blocks_.data(), from, to);
}

void ShRotation::apply(std::span<const Rgb> from, std::span<Rgb> to) const {
  applyBlocks<Rgb, DVec3>(bands_, blocks_.data(), from, to);
}

ShRgb ShRotation::apply(const ShRgb& light) const {
  if (light.bands > bands_)
    throw ValueError(
        "the light has " + std::to_string(light.bands) + " bands, the rotation " + std::to_string(bands_),
        "rotation of spherical harmonics", "make the rotation for as many bands");
  ShRgb rotated(light.bands);
  applyBlocks<Rgb, DVec3>(light.bands, blocks_.data(), light.c, rotated.c);
  return rotated;
}

void rotateShOnce(int bands, const glm::dmat3& r, std::span<const double> from, std::span<double> to) {
  checkBands(bands, kMaxShOnceBands);
  const auto count = std::size_t(shCount(bands));
  if (from.size() < count || to.size() < count)
    throw std::length_error("rotation: a coefficient span is too short");
  std::array<double, shCount(kMaxShOnceBands)> turned, scratch;
  std::copy_n(from.begin(), count, turned.begin());
  turnSh(bands, shTurns(r), turned.data(), scratch.data());
  std::copy_n(turned.begin(), count, to.begin());
}

void rotateShAboutZ(int bands, double angle, std::span<float> c) {
  rotateAboutZ(bands, angle, c);
}
void rotateShAboutZ(int bands, double angle, std::span<double> c) {
  rotateAboutZ(bands, angle, c);
}

}  // namespace prt
