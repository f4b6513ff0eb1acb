#include "libprt/meso/light_projection.h"

#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

void check(const LightSet& lights, int bands) {
  if (lights.size() == 0 || lights.size() != lights.solidAngles.size())
    throw ValueError("there are no lights to project", "btf", "give one or more");
  if (bands < 1 || bands > 10)
    throw ValueError("cannot project to " + std::to_string(bands) + " bands", "rtt.bands", "use 1 to 10");
}

Eigen::MatrixXd functionsAt(const LightSet& lights, int bands) {
  Eigen::MatrixXd y(Eigen::Index(lights.size()), shCount(bands));
  std::vector<double> row(std::size_t(shCount(bands)));
  for (std::size_t k = 0; k < lights.size(); ++k) {
    shEvaluate(bands, normalize(DVec3(lights.directions[k])), row);
    for (int i = 0; i < shCount(bands); ++i) y(Eigen::Index(k), i) = row[std::size_t(i)];
  }
  return y;
}

}  // namespace

LightSet lightGrid(int polar, int azimuth) {
  LightSet set;
  const double step = kPi / 2 / polar, turn = 2 * kPi / azimuth;
  for (int i = 0; i < polar; ++i)
    for (int j = 0; j < azimuth; ++j) {
      const double theta = (i + 0.5) * step, phi = (j + 0.5) * turn;
      set.directions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
      set.solidAngles.push_back((std::cos(i * step) - std::cos((i + 1) * step)) * turn);
    }
  return set;
}

LightSet lightsAt(std::span<const Vec3> directions) {
  if (directions.empty()) throw ValueError("there are no lights to project", "btf", "give one or more");
  LightSet set{{directions.begin(), directions.end()}, std::vector<double>(directions.size(), 0.0)};
  for (const Vec3& d : directions)
    if (!isFinite(d) || std::abs(length(d) - 1) > 1e-3f || d.z < -1e-4f)
      throw ValueError("a light's direction is not of length 1 or below the horizon", "btf",
                       "give directions of the upper hemisphere");
  constexpr int kRows = 128, kColumns = 512;  // equal areas
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const float z = (float(i) + 0.5f) / kRows, r = std::sqrt(1 - z * z),
                  phi = 2 * kPiF * (float(j) + 0.5f) / kColumns;
      const Vec3 d(r * std::cos(phi), r * std::sin(phi), z);
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < directions.size(); ++k)
        if (dot(d, directions[k]) > dot(d, directions[nearest])) nearest = k;
      set.solidAngles[nearest] += 2 * kPi / (kRows * kColumns);
    }
  return set;
}

std::vector<double> cosineGram(int bands) {
  const SphereRule rule = hemisphereRule(2 * bands);
  const std::size_t n = std::size_t(shCount(bands));
  std::vector<double> gram(n * n, 0), y(n);
  for (std::size_t q = 0; q < rule.directions.size(); ++q) {
    shEvaluate(bands, rule.directions[q], y);
    const double weight = rule.weights[q] * rule.directions[q].z;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) gram[i * n + j] += weight * y[i] * y[j];
  }
  return gram;
}

std::vector<double> projectionMatrix(const LightSet& lights, int bands, LightFit fit, double lambda) {
  check(lights, bands);
  const Eigen::Index n = shCount(bands), count = Eigen::Index(lights.size());
  const Eigen::MatrixXd y = functionsAt(lights, bands);
  const Eigen::VectorXd areas = Eigen::Map<const Eigen::VectorXd>(lights.solidAngles.data(), count);
  Eigen::MatrixXd weights = y.transpose() * areas.asDiagonal();  // equation (5)
  if (fit == LightFit::Fit) {
    Eigen::VectorXd cosines(count);
    for (Eigen::Index k = 0; k < count; ++k)
      cosines[k] = double(std::max(0.0f, lights.directions[std::size_t(k)].z));
    Eigen::MatrixXd normal = weights * cosines.asDiagonal() * y;
    for (int l = 0; l < bands; ++l)
      for (int m = -l; m <= l; ++m)
        normal(shIndex(l, m), shIndex(l, m)) += lambda * double(l * l * (l + 1) * (l + 1)) + 1e-12;
    const std::vector<double> gram = cosineGram(bands);
    const Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> cosine(gram.data(), n, n);
    weights = cosine * normal.ldlt().solve(weights);
  }
  std::vector<double> out(std::size_t(n * count));
  Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(out.data(), n, count) = weights;
  return out;
}

double quadratureError(const LightSet& lights, int bands) {
  const std::vector<double> weights = projectionMatrix(lights, bands, LightFit::Quadrature);
  const std::vector<double> gram = cosineGram(bands);  // its first column is the cosine, times Y_00
  double difference = 0, size = 0;
  for (int i = 0; i < shCount(bands); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < lights.size(); ++k)
      sum += weights[std::size_t(i) * lights.size() + k] * double(lights.directions[k].z);
    const double exact = gram[std::size_t(i * shCount(bands))] * std::sqrt(4 * kPi);
    difference += (sum - exact) * (sum - exact), size += exact * exact;
  }
  return std::sqrt(difference / size);
}

}  // namespace prt
