#include "libprt/transport/bounces.h"

#include "libprt/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

bool grey(const Rgb& c) { return c.x == c.y && c.y == c.z; }

/// Object of each surface sample: that of its vertex.
std::vector<std::uint32_t> objectsOf(const Scene& scene, const SampleSet& surface) {
  std::vector<std::uint32_t> object(surface.size());
  std::copy(scene.vertexObject.begin(), scene.vertexObject.end(), object.begin());
  for (std::size_t v = 0; v < surface.back.size(); ++v)
    if (surface.back[v] != kNone) object[surface.back[v]] = scene.vertexObject[v];
  return object;
}

double norm(const SampleRows& rows) {
  double sum = 0;
  for (const float x : rows.values) sum += double(x) * x;
  return std::sqrt(sum);
}

/// Direct irradiance vectors as rows, the same in every channel.
SampleRows directRows(const DirectTransfer& direct, int channels) {
  const auto functions = std::size_t(direct.diffuse.shape[1]);
  SampleRows rows(direct.samples(), functions * std::size_t(channels));
  const std::span<const float> e = direct.diffuse.as<float>();
  for (std::size_t s = 0; s < direct.samples(); ++s)
    for (std::size_t k = 0; k < functions; ++k)
      for (std::size_t c = 0; c < std::size_t(channels); ++c) rows.row(s)[k * std::size_t(channels) + c] = e[s * functions + k];
  return rows;
}

/// to += scale * from, where `from` may have one channel for the three of `to`.
void addScaled(const SampleRows& from, const Rgb& scale, int channels, SampleRows& to) {
  const auto c = std::size_t(channels);
  const bool spread = from.width != to.width;
  for (std::size_t s = 0; s < to.count(); ++s) {
    float* out = to.row(s);
    const float* in = from.row(s);
    for (std::size_t i = 0; i < to.width; ++i) out[i] += scale[int(i % c)] * in[spread ? i / c : i];
  }
}

}  // namespace

BounceColours::BounceColours(std::span<const Material> materials) {
  const bool allGrey = std::ranges::all_of(materials, [](const Material& m) { return grey(m.albedo); });
  const bool allEqual = std::ranges::all_of(materials, [&](const Material& m) { return m.albedo == materials.front().albedo; });
  channels = allGrey ? 1 : 3;
  factored = allEqual;
  common = materials.front().albedo;
  chainChannels = allGrey || allEqual ? 1 : 3;
}

SampleRows leavingRadiance(const Scene& scene, const SampleSet& surface, const SampleRows& irradiance, int channels) {
  SampleRows leaving = irradiance;
  const std::vector<std::uint32_t> object = objectsOf(scene, surface);
  const auto c = std::size_t(channels);
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const Rgb factor = scene.materials[object[s]].albedo / kPiF;
    float* row = leaving.row(s);
    for (std::size_t i = 0; i < leaving.width; ++i) row[i] *= factor[int(i % c)];
  }
  return leaving;
}

BounceResult bounceBetweenVertices(const Scene& scene, const SampleSet& surface, const DirectTransfer& direct,
                                   BounceGather& gather, const BuriedFill& fill, int bounces, float stopThreshold, Job& job) {
  const BounceColours colours(scene.materials);
  BounceResult result;
  result.channels = colours.channels;
  result.total = directRows(direct, colours.channels);
  result.beforeLast = result.total;
  SampleRows last = directRows(direct, colours.chainChannels);  // e_k, or e_k / albedo^k
  Rgb power(1);
  job.begin("bounces", gather.rayCount() * bounces, "rays");
  while (result.bounces < bounces) {
    SampleRows leaving;
    if (colours.factored) {
      leaving = last;
      for (float& x : leaving.values) x /= kPiF;
      power *= colours.common;
    } else {
      leaving = leavingRadiance(scene, surface, last, colours.chainChannels);
    }
    last = gather.irradiance(leaving, job);
    fill.apply(last.values, last.stride);
    result.beforeLast = result.total;
    addScaled(last, colours.factored ? power : Rgb(1), colours.channels, result.total);
    ++result.bounces;
    SampleRows added = result.total;
    for (std::size_t i = 0; i < added.values.size(); ++i) added.values[i] -= result.beforeLast.values[i];
    if (norm(added) < stopThreshold * norm(result.total)) break;
  }
  job.progress(gather.rayCount() * bounces, gather.rayCount() * bounces);
  return result;
}

}  // namespace prt
