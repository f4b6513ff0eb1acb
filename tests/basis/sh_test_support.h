#pragma once
// What the tests of spherical harmonics share.

#include "libprt/basis/sh.h"

#include <random>
#include <vector>

namespace prt::test {

inline DVec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalize(DVec3(normal(random), normal(random), normal(random)));
}

inline glm::dmat3 rotationAbout(const DVec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const glm::dmat3 skew(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return glm::dmat3(c) + (1 - c) * glm::outerProduct(axis, axis) + s * skew;
}

inline glm::dmat3 randomRotation(std::mt19937& random) {
  return rotationAbout(randomDirection(random), std::uniform_real_distribution<double>(0, 2 * kPi)(random));
}

inline std::vector<double> evaluateSh(int bands, const DVec3& d) {
  std::vector<double> y(shCount(bands));
  shEvaluate(bands, d, std::span(y));
  return y;
}

inline std::vector<double> randomVector(int count, std::mt19937& random) {
  std::vector<double> v(count);
  for (double& x : v) x = std::uniform_real_distribution<double>(-1, 1)(random);
  return v;
}

}  // namespace prt::test
