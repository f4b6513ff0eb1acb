#include "libprt/basis/quadrature.h"

#include "libprt/basis/legendre.h"
#include "libprt/core/error.h"

#include <cmath>
#include <string>

namespace prt {
namespace {

void requireCount(int count, int least, int most, const char* where) {
  if (count >= least && count <= most) return;
  throw ValueError("cannot make a rule of size " + std::to_string(count), where,
                   "use " + std::to_string(least) + " to " + std::to_string(most));
}

SphereRule productRule(const std::vector<double>& z, const std::vector<double>& zWeights, int azimuths) {
  SphereRule rule;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double radius = std::sqrt((1 - z[i]) * (1 + z[i]));
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / azimuths;
      rule.directions.emplace_back(radius * std::cos(phi), radius * std::sin(phi), z[i]);
      rule.weights.push_back(zWeights[i] * 2 * kPi / azimuths);
    }
  }
  return rule;
}

constexpr int kMostDegree = 1000;

}  // namespace

IntervalRule gaussLegendre(int count) {
  requireCount(count, 1, 10'000, "Gauss-Legendre quadrature");
  IntervalRule rule{std::vector<double>(count), std::vector<double>(count)};
  for (int i = 0; i < (count + 1) / 2; ++i) {
    double x = -std::cos(kPi * (i + 0.75) / (count + 0.5));  // Tricomi's estimate; Newton ends in a few steps
    if (2 * i + 1 == count) x = 0;
    for (int step = 0; step < 10; ++step) {
      const LegendreTable p(count + 1, x);
      const double change = p.value[count] / p.slope[count];
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    const double slope = LegendreTable(count + 1, x).slope[count];
    rule.nodes[i] = x;
    rule.nodes[count - 1 - i] = -x;
    rule.weights[i] = rule.weights[count - 1 - i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

SphereRule sphereRule(int degree) {
  requireCount(degree, 0, kMostDegree, "sphere quadrature");
  const IntervalRule z = gaussLegendre(degree / 2 + 1);
  return productRule(z.nodes, z.weights, degree + 1);
}

SphereRule hemisphereRule(int degree) {
  requireCount(degree, 0, kMostDegree, "hemisphere quadrature");
  IntervalRule z = gaussLegendre(degree / 2 + 1);
  for (double& node : z.nodes) node = 0.5 * (1 + node);
  for (double& weight : z.weights) weight *= 0.5;
  return productRule(z.nodes, z.weights, degree + 1);
}

std::vector<double> fejerRowWeights(int rows) {
  requireCount(rows, 1, 1 << 16, "lat-long row weights");
  std::vector<double> weights(rows);
  for (int j = 0; j < rows; ++j) {
    const double theta = (j + 0.5) * kPi / rows;
    // cos(2 k theta) by the Chebyshev recurrence would drift over thousands of terms; cos() does not.
    double sum = 0;
    for (int k = rows / 2; k >= 1; --k) sum += std::cos(2 * k * theta) / (4.0 * k * k - 1);
    weights[j] = 2.0 / rows * (1 - 2 * sum);
  }
  return weights;
}

std::vector<double> cellRowWeights(int rows) {
  requireCount(rows, 1, 1 << 16, "lat-long row weights");
  std::vector<double> weights(rows);
  // cos a - cos b = 2 sin((a+b)/2) sin((b-a)/2): no cancellation at the poles.
  for (int j = 0; j < rows; ++j)
    weights[j] = 2 * std::sin((j + 0.5) * kPi / rows) * std::sin(0.5 * kPi / rows);
  return weights;
}

double planeRectangleSolidAngle(double u0, double v0, double u1, double v1) {
  const auto corner = [](double u, double v) { return std::atan2(u * v, std::sqrt(u * u + v * v + 1)); };
  return corner(u1, v1) - corner(u0, v1) - corner(u1, v0) + corner(u0, v0);
}

std::vector<double> cubeFaceSolidAngles(int size) {
  requireCount(size, 1, 1 << 14, "cube face solid angles");
  std::vector<double> angles;
  angles.reserve(std::size_t(size) * size);
  const auto edge = [&](int i) { return 2.0 * i / size - 1; };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      angles.push_back(planeRectangleSolidAngle(edge(x), edge(y), edge(x + 1), edge(y + 1)));
  return angles;
}

}  // namespace prt
