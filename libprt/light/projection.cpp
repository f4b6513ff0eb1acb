#include "libprt/light/projection.h"

#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh_rotation.h"
#include "libprt/basis/sh_window.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace prt {
namespace {

using DRgb = glm::dvec3;
using Coefficients = std::vector<DRgb>;  // [bands^2]

constexpr std::size_t kRowsPerTile = 8;

void requireBands(int bands) {
  if (bands < 1 || bands > kMaxShBands)
    throw ValueError(std::to_string(bands) + " bands", "light projection",
                     "use 1 to " + std::to_string(kMaxShBands) + " bands");
}

ShRgb rounded(const Coefficients& c, int bands) {
  ShRgb result(bands);
  std::transform(c.begin(), c.end(), result.c.begin(), [](const DRgb& v) { return Rgb(v); });
  return result;
}

/// Gauss-Legendre nodes per side of a texel. One node, with the exact solid angle, errs by (l h)^2 / 24 of a
/// texel's light, l the highest band, h the texel's angle; more nodes follow the wave across the texel.
int nodesPerSide(int bands, double texelAngle) {
  const double phase = (bands - 1) * texelAngle;
  return phase < 0.03 ? 1 : phase < 0.3 ? 2 : 2 + int(std::ceil(phase));
}

/// Adds up what `addRow(row, sums)` gives for every row: tiles of rows in parallel, then tile after tile.
template <class AddRow>
Coefficients sumRows(int rows, int bands, Job& job, AddRow&& addRow) {
  const std::size_t tiles = (std::size_t(rows) + kRowsPerTile - 1) / kRowsPerTile;
  std::vector<Coefficients> partial(tiles, Coefficients(std::size_t(shCount(bands)), DRgb(0)));
  job.begin("projecting the environment", rows, "rows");
  parallelFor(job, 0, std::size_t(rows), kRowsPerTile, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      job.checkCancelled();
      addRow(int(row), partial[begin / kRowsPerTile]);
      job.advance(1);
    }
  });
  for (std::size_t t = 1; t < tiles; ++t)
    for (std::size_t i = 0; i < partial[0].size(); ++i) partial[0][i] += partial[t][i];
  return partial[0];
}

/// Any mapping: quadrature over each texel.
Coefficients projectTexels(const EnvironmentMap& map, int bands, Job& job) {
  const MapGeometry& geometry = map.geometry();
  const int order = nodesPerSide(bands, geometry.texelAngle());
  return sumRows(map.height(), bands, job, [&](int y, Coefficients& sum) {
    std::vector<double> basis(sum.size()), texel(sum.size());
    for (int x = 0; x < map.width(); ++x) {
      const DRgb light(map.pixels().rgb(x, y));
      if (light == DRgb(0)) continue;
      if (order == 1) {
        shEvaluate(bands, geometry.center(x, y), texel);
        const double solidAngle = geometry.solidAngle(x, y);
        for (double& value : texel) value *= solidAngle;
      } else {
        std::fill(texel.begin(), texel.end(), 0.0);
        for (const TexelNode& node : geometry.nodes(x, y, order)) {
          shEvaluate(bands, node.direction, basis);
          for (std::size_t i = 0; i < texel.size(); ++i) texel[i] += node.weight * basis[i];
        }
      }
      for (std::size_t i = 0; i < texel.size(); ++i) sum[i] += texel[i] * light;
    }
  });
}

/// Integrals over one row of a lat-long map, for an upright pole, of the polar factors Theta_lm of the
/// functions: Y_lm = Theta_lm cos(m phi), Y_l-m = Theta_lm sin(m phi). In [shIndex(l, m)], m >= 0.
std::vector<double> polarIntegrals(int row, int rows, int bands) {
  const double step = kPi / rows, middle = (row + 0.5) * step;
  const IntervalRule rule = gaussLegendre(nodesPerSide(bands, step));
  std::vector<double> sum(std::size_t(shCount(bands)), 0.0), theta(sum.size());
  double area = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double polar = middle + 0.5 * step * rule.nodes[i];
    const double weight = rule.weights[i] * std::sin(polar);
    shEvaluate(bands, DVec3(std::sin(polar), 0, std::cos(polar)), theta);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * theta[k];
    area += weight;
  }
  // Scaled so that the row's solid angle is exact: cos a - cos b, written without cancellation.
  const double scale = 2 * std::sin(middle) * std::sin(0.5 * step) / area;
  for (double& value : sum) value *= scale;
  return sum;
}

/// Lat-long maps with the pole of the functions along +Y: the integral over a texel is a polar factor times
/// the exact integral of cos(m phi) or sin(m phi), so that a row costs width * bands instead of width *
/// bands^2.
Coefficients projectUpright(const EnvironmentMap& map, int bands, Job& job) {
  const int w = map.width();
  // Any whole multiple of the azimuth of a column's centre is a multiple of pi / w.
  std::vector<double> cosine(std::size_t(2 * w)), sine(cosine.size());
  for (std::size_t k = 0; k < cosine.size(); ++k)
    cosine[k] = std::cos(kPi * double(k) / w), sine[k] = std::sin(kPi * double(k) / w);

  return sumRows(map.height(), bands, job, [&](int y, Coefficients& sum) {
    const std::vector<double> polar = polarIntegrals(y, map.height(), bands);
    for (int m = 0; m < bands; ++m) {
      DRgb even(0), odd(0);
      for (int x = 0; x < w; ++x) {
        const std::size_t k = std::size_t((std::int64_t(m) * (2 * x + 1)) % (2 * w));
        const DRgb light(map.pixels().rgb(x, y));
        even += light * cosine[k];
        odd -= light * sine[k];  // columns run against the azimuth about +Y
      }
      // The integral over a column's width of 2 pi / w, of a wave with m periods around.
      const double wave = m == 0 ? 2 * kPi / w : 2 * std::sin(m * kPi / w) / m;
      for (int l = m; l < bands; ++l) {
        const double factor = polar[std::size_t(shIndex(l, m))] * wave;
        sum[std::size_t(shIndex(l, m))] += factor * even;
        if (m > 0) sum[std::size_t(shIndex(l, -m))] += factor * odd;
      }
    }
  });
}

/// From functions whose x, y, z axes lie along the world's Z, X, Y to those of the world.
Coefficients fromUpright(const Coefficients& upright, int bands) {
  const ShRotation rotation(bands, glm::dmat3(DVec3(0, 0, 1), DVec3(1, 0, 0), DVec3(0, 1, 0)));
  Coefficients result(upright.size());
  std::vector<double> from(upright.size()), to(upright.size());
  for (int channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = upright[i][channel];
    rotation.apply(from, to);
    for (std::size_t i = 0; i < to.size(); ++i) result[i][channel] = to[i];
  }
  return result;
}

}  // namespace

ShRgb projectEnvironment(const EnvironmentMap& map, int bands) {
  Job job;
  return projectEnvironment(map, bands, job);
}

ShRgb projectEnvironment(const EnvironmentMap& map, int bands, Job& job) {
  requireBands(bands);
  if (map.geometry().mapping() == EnvironmentMapping::LatLong)
    return rounded(fromUpright(projectUpright(map, bands, job), bands), bands);
  return rounded(projectTexels(map, bands, job), bands);
}

BandSpectrum bandSpectrum(const EnvironmentMap& map, const ShRgb& coefficients) {
  BandSpectrum spectrum;
  map.forEachTexel([&](int, int, const DVec3&, double solidAngle, const Rgb& c) {
    spectrum.energy += solidAngle * double(luminance(c)) * double(luminance(c));
  });
  double kept = 0;
  for (int l = 0; l < coefficients.bands; ++l) {
    double power = 0;
    for (int m = -l; m <= l; ++m)
      power += std::pow(double(luminance(coefficients.c[std::size_t(shIndex(l, m))])), 2);
    kept += power;
    spectrum.power.push_back(power);
    spectrum.truncation.push_back(spectrum.energy > 0 ? std::sqrt(std::max(0.0, 1 - kept / spectrum.energy))
                                                      : 0);
  }
  return spectrum;
}

ShRgb nonNegativeLight(const ShRgb& light) {
  ShRgb result = light;
  scaleBands(fejerWindow(light.bands), result);
  return result;
}

EnvironmentMap bandLimitedMap(const ShRgb& light, int width, int height) {
  requireBands(light.bands);
  const MapGeometry geometry(EnvironmentMapping::LatLong, width, height);
  const int order = nodesPerSide(light.bands, geometry.texelAngle());
  Image image(width, height, 3);
  Job job;
  parallelFor(job, 0, std::size_t(height), 1, [&](std::size_t row, std::size_t) {
    std::vector<double> basis(light.c.size());
    for (int x = 0; x < width; ++x) {
      DRgb sum(0);
      for (const TexelNode& node : geometry.nodes(x, int(row), order)) {
        shEvaluate(light.bands, node.direction, basis);
        for (std::size_t k = 0; k < basis.size(); ++k) sum += node.weight * basis[k] * DRgb(light.c[k]);
      }
      const Rgb mean(sum / geometry.solidAngle(x, int(row)));
      std::copy_n(&mean.x, 3, image.pixel(x, int(row)));
    }
  });
  return EnvironmentMap(image, EnvironmentMapping::LatLong, "band-limited light");
}

}  // namespace prt
