#include "libprt/light/light_sampler.h"

#include "libprt/core/warp.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace prt {
namespace {

/// Turns running sums into shares of the last one; all zero when there is nothing.
void normalize(std::span<double> cumulative) {
  const double total = cumulative.back();
  if (total > 0)
    for (double& value : cumulative) value /= total;
}

/// The bin of a cumulative distribution that u falls into; u becomes the position inside it, 0..1.
std::size_t chooseBin(std::span<const double> cumulative, double& u) {
  // The first value above u ends the bin. Bins of zero width are never chosen; should rounding lift u
  // to 1, the last bin that has any width is.
  auto end = std::upper_bound(cumulative.begin(), cumulative.end(), u);
  if (end == cumulative.end())
    end = std::lower_bound(cumulative.begin(), cumulative.end(), cumulative.back());
  const std::size_t bin = std::size_t(end - cumulative.begin()) - 1;
  u = std::clamp((u - cumulative[bin]) / (cumulative[bin + 1] - cumulative[bin]), 0.0, 1.0);
  return bin;
}

}  // namespace

LightSampler::LightSampler(LightRig rig) : rig_(std::move(rig)) {
  validate(rig_);
  toWorld_ = environmentRotation(rig_.rotation);
  toMap_ = transpose(toWorld_);
  if (rig_.environment && rig_.intensity > 0) addEnvironment();
  constantPower_ = 4 * kPi * luminance(rig_.constant);
  total_ = environmentPower_ + constantPower_;
  for (const CircleLight& light : rig_.circles) {
    circlePower_.push_back(solidAngle(light) * luminance(light.radiance));
    total_ += circlePower_.back();
  }
}

void LightSampler::addEnvironment() {
  const EnvironmentMap& map = *rig_.environment;
  const std::size_t w = std::size_t(map.width()), h = std::size_t(map.height());
  rowCdf_.assign(h + 1, 0);
  columnCdf_.assign(h * (w + 1), 0);
  for (std::size_t y = 0; y < h; ++y) {
    const std::span<double> row(columnCdf_.data() + y * (w + 1), w + 1);
    for (std::size_t x = 0; x < w; ++x)
      row[x + 1] =
          row[x] + map.geometry().solidAngle(int(x), int(y)) * luminance(map.pixels().rgb(int(x), int(y)));
    rowCdf_[y + 1] = rowCdf_[y] + row[w];
    normalize(row);
  }
  environmentPower_ = rig_.intensity * rowCdf_[h];
  normalize(rowCdf_);
}

/// A texel by its power, then a point of it.
Vec3 LightSampler::sampleEnvironment(double u, double v) const {
  const MapGeometry& geometry = rig_.environment->geometry();
  const std::size_t w = std::size_t(geometry.width());
  const std::size_t y = chooseBin(rowCdf_, u);
  const std::size_t x = chooseBin(std::span(columnCdf_).subspan(y * (w + 1), w + 1), v);
  const glm::dvec2 p = geometry.pointInTexel(int(x), int(y), v, u);
  return toWorld_ * Vec3(geometry.toDirection(p.x, p.y));
}

double LightSampler::environmentPdf(const Vec3& d) const {
  const MapGeometry& geometry = rig_.environment->geometry();
  const Vec2 p = geometry.toImage(toMap_ * d);
  const double density = geometry.density(p.x, p.y);
  if (density <= 0) return 0;
  const std::size_t x = std::size_t(p.x), y = std::size_t(p.y), w = std::size_t(geometry.width());
  const double* row = columnCdf_.data() + y * (w + 1);
  return (rowCdf_[y + 1] - rowCdf_[y]) * (row[x + 1] - row[x]) * geometry.pointDensity(p.x, p.y) / density;
}

LightSample LightSampler::sample(const Vec2& u) const {
  if (!shines()) return {};
  LightSample result;
  double power = u.x * total_;  // what is left of it after the parts that are passed over
  if (power < environmentPower_) {
    result.direction = sampleEnvironment(power / environmentPower_, u.y);
  } else if ((power -= environmentPower_) < constantPower_) {
    result.direction = sampleUniformSphere({float(power / constantPower_), u.y});
  } else {
    power -= constantPower_;
    std::size_t i = 0;
    while (i + 1 < circlePower_.size() && power >= circlePower_[i]) power -= circlePower_[i++];
    if (i == circlePower_.size()) return {};
    const Frame frame = frameFromNormal(rig_.circles[i].direction);
    const Vec2 inside(std::min(1.0f, float(power / circlePower_[i])), u.y);
    result.direction =
        normalize(frame.toWorld(sampleUniformCone(inside, coneHeight(rig_.circles[i].halfAngle))));
  }
  result.radiance = radiance(result.direction);
  result.pdf = pdf(result.direction);
  return result;
}

float LightSampler::pdf(const Vec3& d) const {
  if (!shines()) return 0;
  double density = constantPower_ / (4 * kPi);
  if (environmentPower_ > 0) density += environmentPower_ * environmentPdf(d);
  for (std::size_t i = 0; i < circlePower_.size(); ++i)
    if (circlePower_[i] > 0 && contains(rig_.circles[i], d))
      density += circlePower_[i] / solidAngle(rig_.circles[i]);
  return float(density / total_);
}

}  // namespace prt
