#include "libprt/meso/light_projection.h"

#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh_hemisphere.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

/// Largest error of the hemisphere's Gram matrix summed over the lights, relative to its norm.
double gramError(const LightSet& lights) {
  const std::vector<double> exact = hemisphereGram(5);
  std::vector<double> y(25), gram(625, 0);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    shEvaluate(5, normalize(DVec3(lights.directions[k])), y);
    for (std::size_t i = 0; i < 25; ++i)
      for (std::size_t j = 0; j < 25; ++j) gram[i * 25 + j] += lights.solidAngles[k] * y[i] * y[j];
  }
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < 625; ++i)
    difference += (gram[i] - exact[i]) * (gram[i] - exact[i]), size += exact[i] * exact[i];
  return std::sqrt(difference / size);
}

/// Relative error of B for a response that is known everywhere.
template <class Response>
double errorFor(const LightSet& lights, LightFit fit, const Response& response) {
  const std::vector<double> matrix = projectionMatrix(lights, 5, fit);
  std::vector<double> exact(25, 0), y(25);
  const int rows = 400, columns = 1600;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double z = (i + 0.5) / rows, r = std::sqrt(1 - z * z), phi = 2 * kPi * (j + 0.5) / columns;
      const DVec3 d(r * std::cos(phi), r * std::sin(phi), z);
      shEvaluate(5, d, y);
      for (std::size_t k = 0; k < 25; ++k) exact[k] += response(d) * y[k] * 2 * kPi / (rows * columns);
    }
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < 25; ++k) {
    double sum = 0;
    for (std::size_t l = 0; l < lights.size(); ++l)
      sum += matrix[k * lights.size() + l] * response(DVec3(lights.directions[l]));
    difference += (sum - exact[k]) * (sum - exact[k]), size += exact[k] * exact[k];
  }
  return std::sqrt(difference / size);
}

double lambert(const DVec3& d) {
  return d.z / kPi;
}
/// A slope whose upper half of the sky is cut off along a hard edge.
double hardShadow(const DVec3& d) {
  return d.x + 0.4 * d.z > 0 ? d.z / kPi : 0;
}

TEST(LightProjection, TheGridHasExactCells) {
  const LightSet lights = lightGrid();
  ASSERT_EQ(lights.size(), 128u);
  double sum = 0;
  for (const double a : lights.solidAngles) sum += a;
  EXPECT_NEAR(sum, 2 * kPi, 1e-12);
  EXPECT_NEAR(gramError(lights), 0.0091, 2e-3);  // ALGORITHMS 6.1: exact cell area 0.91 %
}

TEST(LightProjection, FitIsFarBetterThanQuadratureOnWhatIsSmooth) {
  const LightSet lights = lightGrid();
  EXPECT_NEAR(errorFor(lights, LightFit::Quadrature, lambert), quadratureError(lights, 5), 2e-4);
  EXPECT_LT(errorFor(lights, LightFit::Quadrature, lambert), 0.015);
  EXPECT_LT(errorFor(lights, LightFit::Fit, lambert), 5e-4);
  EXPECT_LT(errorFor(lights, LightFit::Quadrature, hardShadow), 0.05);
  EXPECT_LT(errorFor(lights, LightFit::Fit, hardShadow), 0.05);
}

/// The rings of Bonn's sets: 81 directions down to 75 degrees.
LightSet bonnRings() {
  std::vector<Vec3> directions;
  const int counts[6] = {1, 6, 12, 18, 20, 24};
  for (int ring = 0; ring < 6; ++ring)
    for (int i = 0; i < counts[ring]; ++i) {
      const double theta = radians(15.0 * ring), phi = 2 * kPi * i / counts[ring];
      directions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta));
    }
  return lightsAt(directions);
}

TEST(LightProjection, FitBridgesTheHorizonOfMeasuredRings) {
  const LightSet lights = bonnRings();
  ASSERT_EQ(lights.size(), 81u);
  double sum = 0;
  for (const double a : lights.solidAngles) sum += a;
  EXPECT_NEAR(sum, 2 * kPi, 1e-9);
  EXPECT_LT(errorFor(lights, LightFit::Fit, lambert), 2e-3);  // ALGORITHMS 6.1: 0.13 %
  EXPECT_GT(errorFor(lights, LightFit::Quadrature, lambert), 0.02);
  EXPECT_LT(errorFor(lights, LightFit::Fit, hardShadow), 0.05);
}

TEST(LightProjection, RefusesWhatIsNoLight) {
  EXPECT_THROW(lightsAt({}), ValueError);
  const Vec3 below[] = {Vec3(0, 0, -1)}, longer[] = {Vec3(0, 0, 2)};
  EXPECT_THROW(lightsAt(below), ValueError);
  EXPECT_THROW(lightsAt(longer), ValueError);
  EXPECT_THROW(projectionMatrix({}, 5, LightFit::Fit), ValueError);
  EXPECT_THROW(projectionMatrix(lightGrid(), 11, LightFit::Fit), ValueError);
}

}  // namespace
}  // namespace prt
