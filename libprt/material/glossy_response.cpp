#include "libprt/material/glossy_response.h"

#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace prt {
namespace {

constexpr int kAngles = 66;
constexpr int kMaxFunctions = kMaxResponseBands * kMaxResponseBands;

/// Table position of a view angle. Steps shrink towards the horizon, where narrow lobes are cut within
/// an angle of about 1/sqrt(exponent): angle = pi/2 (1 - (1-t)^2). Position 0 lies beyond the pole (t < 0),
/// so that interpolation has points on both sides there.
double tableAngle(int position) {
  const double t = double(position - 1) / (kAngles - 2);
  return 0.5 * kPi * (1 - (1 - t) * (1 - t));
}
float tablePosition(float angle) {
  return 1 + float(kAngles - 2) * (1 - std::sqrt(std::max(0.0f, 1 - angle / (0.5f * kPiF))));
}

/// phongResponse for any angle: beyond the pole the picture is turned by 180 degrees.
std::vector<double> responseAt(double exponent, double viewAngle, int bands) {
  std::vector<double> response = phongResponse(exponent, std::abs(viewAngle), bands);
  for (int l = 0; viewAngle < 0 && l < bands; ++l)
    for (int m = 1; m <= l; m += 2) response[std::size_t(shIndex(l, m))] *= -1;
  return response;
}

/// Angle of lobe j to the normal, in the viewing plane, towards the viewer.
double lobeAngle(int lobe, int lobes) {
  return kPi * lobe / lobes;
}

/// For band l: the matrix that turns coefficients m = 0..l into lobe weights, of least norm.
Eigen::MatrixXd lobeWeights(int l, int lobes) {
  Eigen::MatrixXd basis(l + 1, lobes);
  std::vector<double> y(std::size_t(shCount(l + 1)));
  for (int j = 0; j < lobes; ++j) {
    const double angle = lobeAngle(j, lobes);
    shEvaluate(l + 1, DVec3(std::sin(angle), 0, std::cos(angle)), y);
    for (int m = 0; m <= l; ++m) basis(m, j) = y[std::size_t(shIndex(l, m))];
  }
  return basis.completeOrthogonalDecomposition().pseudoInverse();
}

/// Adds weight * integral over a ring of the lobe, at angle `off` from its axis, of cos(in) Y(in): the arc
/// above the horizon, half of it, twice. `rule` = Gauss-Legendre for arcs.
void addRing(const IntervalRule& rule, double off, double viewAngle, int bands, double weight,
             std::span<double> sum) {
  const double along = std::cos(off), across = std::sin(off), c = std::cos(viewAngle),
               s = std::sin(viewAngle);
  const double reach =
      across * s > 0 ? -along * c / (across * s) : -1;  // cos(in) > 0 where cos(turn) > reach
  const bool whole = reach <= -1;
  const double arc = whole ? kPi : std::acos(std::min(reach, 1.0));
  // A whole ring integrates trigonometric polynomials exactly with equal steps.
  const int count = whole ? bands + 1 : int(rule.nodes.size());
  std::array<double, kMaxFunctions> y;
  for (int i = 0; i < count; ++i) {
    const double turn = whole ? kPi * (i + 0.5) / count : 0.5 * arc * (1 + rule.nodes[std::size_t(i)]);
    const double step = whole ? kPi / count : 0.5 * arc * rule.weights[std::size_t(i)];
    // mirror direction (-s, 0, c); across it, in the viewing plane (c, 0, s); and y
    const DVec3 in(-s * along + c * across * std::cos(turn), across * std::sin(turn),
                   c * along + s * across * std::cos(turn));
    shEvaluate(bands, in, y);
    const double w = 2 * step * weight * in.z;
    for (int k = 0; k < shCount(bands); ++k) sum[std::size_t(k)] += w * y[std::size_t(k)];
  }
}

/// Interpolating weights of four points at 0, 1, 2, 3 (Lagrange).
std::array<float, 4> cubicWeights(float t) {
  const float a = t, b = t - 1, c = t - 2, d = t - 3;
  return {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
}

}  // namespace

std::vector<double> phongResponse(double exponent, double viewAngle, int bands) {
  const IntervalRule rule = gaussLegendre(24), ring = gaussLegendre(bands + 7);
  std::vector<double> sum(std::size_t(shCount(bands)), 0.0);
  // Off the axis the lobe falls like cos^s: nothing to see beyond `end`. Rings are whole up to `cut`.
  const double end = std::acos(std::pow(1e-12, 1 / exponent)),
               cut = std::clamp(0.5 * kPi - viewAngle, 0.0, end);
  for (const auto& [from, to] : {std::pair(0.0, cut), std::pair(cut, end)}) {
    if (to - from < 1e-12) continue;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double off = from + 0.5 * (to - from) * (1 + rule.nodes[i]);
      const double lobe = (exponent + 2) / (2 * kPi) * std::pow(std::cos(off), exponent);
      addRing(ring, off, viewAngle, bands, 0.5 * (to - from) * rule.weights[i] * std::sin(off) * lobe, sum);
    }
  }
  // By symmetry exactly zero; what the half rings left there is not the integral.
  for (int l = 0; l < bands; ++l)
    for (int m = 1; m <= l; ++m) sum[std::size_t(shIndex(l, -m))] = 0;
  return sum;
}

GlossyResponse::GlossyResponse(float exponent, int bands) : exponent_(exponent), bands_(bands) {
  if (!(exponent >= 1 && exponent <= 10000))
    throw ValueError("exponent " + std::to_string(exponent), "material", "use 1 to 10000");
  if (bands < 1 || bands > kMaxResponseBands)
    throw ValueError(std::to_string(bands) + " bands", "glossy response",
                     "use 1 to " + std::to_string(kMaxResponseBands) + " bands");
  for (int j = 0; j < bands; ++j)
    lobes_.push_back(Vec2(std::sin(lobeAngle(j, bands)), std::cos(lobeAngle(j, bands))));
  std::vector<Eigen::MatrixXd> weights;
  for (int l = 0; l < bands; ++l) weights.push_back(lobeWeights(l, bands));

  table_.resize(std::size_t(kAngles) * std::size_t(shCount(bands)));
  Job job;
  parallelFor(job, 0, kAngles, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t a = begin; a < end; ++a) {
      const std::vector<double> response = responseAt(exponent, tableAngle(int(a)), bands);
      for (int l = 0; l < bands; ++l) {
        const Eigen::Map<const Eigen::VectorXd> even(response.data() + shIndex(l, 0), l + 1);
        const Eigen::VectorXd row = weights[std::size_t(l)] * even;
        std::copy_n(row.data(), bands,
                    table_.data() + a * std::size_t(shCount(bands)) + std::size_t(l * bands));
      }
    }
  });
}

void GlossyResponse::weightsAt(float viewAngle, std::span<float> out) const {
  const float position = tablePosition(viewAngle);
  const int first = std::clamp(int(position) - 1, 0, kAngles - 4);
  const std::array<float, 4> mix = cubicWeights(position - float(first));
  const int functions = shCount(bands_);
  const float* row = table_.data() + std::size_t(first) * std::size_t(functions);
  for (int i = 0; i < functions; ++i)
    out[std::size_t(i)] = mix[0] * row[i] + mix[1] * row[i + functions] + mix[2] * row[i + 2 * functions] +
                          mix[3] * row[i + 3 * functions];
}

void GlossyResponse::evaluate(const Vec3& normal, const Vec3& view, std::span<float> out) const {
  // Frame of the viewing plane; straight from above any will do, as the response is round there.
  const float cosine = std::clamp(dot(normal, view), 0.0f, 1.0f);
  const Vec3 flat = view - dot(normal, view) * normal;
  const float sine = length(flat);
  const Vec3 tangent = sine > 1e-6f ? flat / sine : frameFromNormal(normal).tangent;

  std::array<float, kMaxFunctions> weights;
  weightsAt(std::atan2(sine, cosine), weights);

  // Sum of turned zonal lobes.
  std::fill_n(out.begin(), shCount(bands_), 0.0f);
  std::array<float, kMaxFunctions> y;
  for (int j = 0; j < bands_; ++j) {
    const Vec2& lobe = lobes_[std::size_t(j)];
    shEvaluate(bands_, lobe.x * tangent + lobe.y * normal, y);
    for (int l = 0; l < bands_; ++l) {
      const float w = weights[std::size_t(l * bands_ + j)];
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[std::size_t(i)] += w * y[std::size_t(i)];
    }
  }
}

void lambertResponse(int bands, const Vec3& normal, std::span<float> out) {
  static const std::vector<float> factors = [] {
    const std::vector<double> cosine = clampedCosineFactors(kMaxShBands);
    std::vector<float> overPi;
    for (const double factor : cosine) overPi.push_back(float(factor / kPi));
    return overPi;
  }();
  shEvaluate(bands, normal, out);
  for (int l = 0; l < bands; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[std::size_t(i)] *= factors[std::size_t(l)];
}

Rgb exitRadiance(const Material& material, const GlossyResponse* glossy, const Vec3& normal, const Vec3& view,
                 std::span<const Rgb> incident) {
  const int bands = int(std::lround(std::sqrt(double(incident.size()))));
  std::array<float, kMaxFunctions> response;
  const auto reflected = [&] {
    Rgb sum(0);
    for (std::size_t k = 0; k < incident.size(); ++k) sum += response[k] * incident[k];
    return sum;
  };
  lambertResponse(bands, normal, response);
  Rgb exit = material.albedo * reflected();
  if (material.glossy()) {
    glossy->evaluate(normal, view, response);
    exit += material.specular * reflected();
  }
  return exit;
}

}  // namespace prt
